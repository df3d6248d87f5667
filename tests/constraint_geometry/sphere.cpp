// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/obedience.hpp"

using Catch::Matchers::WithinAbs;

namespace {

template <class S>
ph::sphere<S> ball(typename S::coordinates centre, ph::felt_from side = ph::felt_from::outside) {
  return {centre, typename S::scalar(0.05), typename S::scalar(500), side};
}

}  // namespace

TEMPLATE_TEST_CASE("a sphere is an interval, a circle, a ball, solid and hollow", "[geometry]", d1,
                   f1, d2, f2, d3, f3) {
  using S = TestType;
  typename S::coordinates centre{};
  S::component(centre, 0) = typename S::scalar(0.02);
  obey<role::constraint, S>(ball<S>(centre), ball<S>(centre, ph::felt_from::inside));
}

TEST_CASE("a solid ball is felt from outside, a cavity from inside", "[geometry]") {
  const d3::vector in(0, 0.03, 0), out(0, 0.06, 0);
  const auto solid = ball<d3>({0, 0, 0});
  CHECK_THAT(solid.at(in).depth, WithinAbs(0.02, 1e-15));
  CHECK_THAT(solid.at(out).depth, WithinAbs(-0.01, 1e-15));
  CHECK(solid.at(in).outward() == d3::vector(0, 1, 0));
  const auto cavity = ball<d3>({0, 0, 0}, ph::felt_from::inside);
  CHECK_THAT(cavity.at(in).depth, WithinAbs(-0.02, 1e-15));
  CHECK_THAT(cavity.at(out).depth, WithinAbs(0.01, 1e-15));
  CHECK(cavity.at(out).outward() == d3::vector(0, -1, 0));
}

TEMPLATE_TEST_CASE("a sphere has a unit normal at its centre and next to it", "[geometry]", d3,
                   f3) {
  using S = TestType;
  using scalar = typename S::scalar;
  const auto solid = ball<S>({0, 0, 0});
  for (const scalar away : {scalar(0), std::numeric_limits<scalar>::denorm_min(),
                            std::sqrt(ph::kernels::smallest<scalar>()), scalar(1e-12)}) {
    const auto seen = solid.at({away, away, scalar(0)});
    CHECK_THAT(static_cast<double>(S::norm(seen.outward())), WithinAbs(1.0, 1e-6));
    CHECK_THAT(static_cast<double>(seen.depth), WithinAbs(0.05, 1e-8));
  }
}

TEMPLATE_TEST_CASE("a sphere that cannot be used is refused", "[geometry]", d3, f3) {
  using S = TestType;
  using scalar = typename S::scalar;
  const auto usable = [](ph::sphere<S> s) { return s.prepare(); };
  const auto good = ball<S>({0, 0, 0});
  CHECK(usable(good));
  for (const scalar bad : {std::numeric_limits<scalar>::quiet_NaN(),
                           std::numeric_limits<scalar>::infinity(), scalar(0), scalar(-1)}) {
    auto s = good;
    s.radius = bad;
    CHECK_FALSE(usable(s));
    s = good;
    s.stiffness = bad;
    CHECK_FALSE(usable(s));
    s = good;
    s.centre = {scalar(0), bad, scalar(0)};
    CHECK(usable(s) == std::isfinite(bad));
    s = good;
    s.felt = static_cast<ph::felt_from>(7);
    CHECK_FALSE(usable(s));
  }
}

TEMPLATE_TEST_CASE("a ball that is pressed deeper than its radius keeps its normal", "[geometry]",
                   d1, d2, d3, f3) {
  using S = TestType;
  using scalar = typename S::scalar;
  typename S::vector n = S::zero();
  S::component(n, 0) = scalar(-1);
  const auto solid = ball<S>({});
  for (const double deep : {-0.02, 0.02, 0.0499, 0.05, 0.07, 1.0}) {
    const auto own = solid.toward(solid, S::zero(), n, scalar(deep)).at(S::zero());
    CAPTURE(deep);
    CHECK_THAT(double(S::dot(own.outward(), n)), WithinAbs(1.0, 1e-3));
    CHECK_THAT(double(own.depth), WithinAbs(std::min(deep, 0.04995), 1e-7));
  }
  const auto cavity = ball<S>({}, ph::felt_from::inside);
  CHECK_THAT(double(cavity.toward(cavity, S::zero(), n, scalar(0.07)).at(S::zero()).depth),
             WithinAbs(0.07, 1e-7));
}

TEST_CASE("a sphere is looked for within twice its radius", "[geometry]") {
  const auto found = ball<d3>({0.01, 0, 0}).around();
  CHECK(found.radius == 0.1);
  CHECK(d3::vector(found.centre) == d3::vector(0.01, 0, 0));
}

TEST_CASE("a vector is given the length one, and has a direction if its square is a number",
          "[geometry]") {
  d3::coordinates v{-3, -4, 0};
  REQUIRE(ph::detail::make_unit<d3>(v));
  CHECK((d3::vector(v) - d3::vector(-0.6, -0.8, 0)).norm() < 1e-15);
  v = {-2, 0, 0};
  REQUIRE(ph::detail::make_unit<d3>(v));
  CHECK(d3::vector(v) == d3::vector(-1, 0, 0));
  const auto direction = [](double length) {
    return ph::detail::polar_form<d3>({length, 0, 0}, {0, 1, 0}).direction;
  };
  CHECK(direction(std::ldexp(1.0, -484)) == d3::vector(1, 0, 0));
  CHECK(direction(std::ldexp(1.0, -485)) == d3::vector(0, 1, 0));  // of 2^-970, the least over ε
  CHECK(direction(1e-150) == d3::vector(0, 1, 0));
  CHECK(ph::detail::polar_form<d3>({0.5, 0, 0}, {0, 1, 0}).length == 0.5);
}
