// SPDX-License-Identifier: BSD-3-Clause
// Distances sampled and by a function.
#include "support/catch.hpp"
#include "support/curved.hpp"
#include "support/obedience.hpp"

#include <random>

using Catch::Matchers::WithinAbs;
using Eigen::Vector3d;

namespace {

/// A wavy floor, by a function of the height.
struct waves {
  double amplitude = 1e-3, wavelength = 0.02;
  ph::distance_and_gradient<d2> operator()(const d2::vector& x) const noexcept {
    const double k = 2.0 * std::acos(-1.0) / wavelength;
    return {x.y() - amplitude * std::sin(k * x.x()),
            d2::vector(-amplitude * k * std::cos(k * x.x()), 1.0)};
  }
  bool prepare() const noexcept { return amplitude >= 0.0 && wavelength > 0.0; }
};
/// As honest as its gradient.
struct half_a_gradient : waves {
  ph::distance_and_gradient<d2> operator()(const d2::vector& x) const noexcept {
    auto seen = waves::operator()(x);
    seen.gradient.x() *= 0.5;
    return seen;
  }
};
struct may_throw {
  ph::distance_and_gradient<d2> operator()(const d2::vector& x) const { return waves{}(x); }
};
static_assert(ph::surface_for<ph::distance_field<d2, waves>, d2>);
static_assert(!ph::surface_for<ph::distance_field<d2, may_throw>, d2>);

}  // namespace

TEST_CASE("a distance field of one's own obeys the laws if its gradient is one",
          "[geometry][curved][law]") {
  obey<role::surface, d2>(ph::distance_field<d2, waves>{.stiffness = 500, .radius = 0.02});
  const ph::distance_field<d2, half_a_gradient> liar{.stiffness = 500, .radius = 0.02};
  CHECK(std::string(broken_by<role::surface, d2>(liar)) == "pushes_along_its_gradient");
}

TEST_CASE("a distance field ends at its ball and its thickness, and refuses what its field refuses",
          "[geometry][curved]") {
  ph::distance_field<d2, waves> f{.stiffness = 500, .radius = 0.02, .thickness = 0.005};
  REQUIRE(f.prepare());
  CHECK(f.at({0.0199, 0}).covered());
  CHECK_FALSE(f.at({0.0201, 0}).covered());
  CHECK(f.at({0, -0.0049}).covered());
  CHECK_FALSE(f.at({0, -0.0051}).covered());
  const auto usable = [](auto field) { return field.prepare(); };
  auto bad = f;
  bad.field.wavelength = 0.0;
  CHECK_FALSE(usable(bad));
  for (const double wrong : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    bad = f;
    bad.stiffness = wrong;
    CHECK_FALSE(usable(bad));
    bad = f;
    bad.radius = wrong;
    CHECK_FALSE(usable(bad));
    bad = f;
    bad.thickness = wrong;
    CHECK_FALSE(usable(bad));
    bad = f;
    bad.centre = {wrong, 0.0};
    CHECK(usable(bad) == std::isfinite(wrong));
  }
  bad = f;
  bad.field.amplitude = HUGE_VAL;
  bad.centre = {0.005, 0.0};
  CHECK_FALSE(usable(bad));
}

TEMPLATE_TEST_CASE("a brick returns every quadratic distance as it is", "[geometry][curved]", d3,
                   f3) {
  using S = TestType;
  using scalar = typename S::scalar;
  const auto phi = [](const typename S::vector& x) {
    return scalar(x(2) + scalar(3) * x(0) * x(0) - scalar(2) * x(1) * x(1) + x(0) * x(2));
  };
  auto brick = ph::distance_brick<S>::sampled(phi, curved::of<S>({-0.02, -0.01, -0.015}),
                                              scalar(0.01), scalar(500));
  REQUIRE(brick.prepare());
  const double rounding = 200 * static_cast<double>(std::numeric_limits<scalar>::epsilon());
  std::mt19937 random(4);
  std::uniform_real_distribution<double> in(-0.01, 0.01);
  for (int i = 0; i < 1000; ++i) {
    const Vector3d off(in(random), in(random), in(random));
    const Vector3d x = off + Vector3d(-0.005, 0.005, 0.0);
    const auto seen = brick.at(curved::of<S>(x));
    CHECK(static_cast<double>(std::abs(seen.depth + phi(curved::of<S>(x)))) < 0.03 * rounding);
    const Vector3d gradient(6 * x.x() + x.z(), -4 * x.y(), 1 + x.x());
    CHECK((seen.push().template cast<double>() - gradient).norm() < 10 * rounding);
  }
}

TEST_CASE("a brick of samples as they are would smooth a ball by h^2/(4 r)", "[geometry][curved]") {
  auto sharp = curved::brick<d3>();
  REQUIRE(sharp.prepare());
  auto blunt = sharp;
  for (std::size_t i = 0; i < blunt.coefficients.size(); ++i) {
    const d3::vector x =
        d3::vector(blunt.origin) +
        blunt.spacing * d3::vector(double(i / 16), double(i / 4 % 4), double(i % 4));
    blunt.coefficients[i] = x.norm() - curved::radius;
  }
  const d3::vector pole(0, 0, curved::radius);
  CHECK_THAT(blunt.at(pole).depth, WithinAbs(-0.125e-3, 2e-6));
  CHECK_THAT(sharp.at(pole).depth, WithinAbs(0.0, 2e-6));
}

TEMPLATE_TEST_CASE("a brick covers its middle cube, and answers with numbers outside", "[geometry]",
                   d3, f3) {
  using S = TestType;
  using scalar = typename S::scalar;
  auto brick = curved::brick<S>({0, 0, 0.05});  // from −5 to 5 mm about the pole
  REQUIRE(brick.prepare());
  const auto at = [&](double x, double y, double z) {
    return brick.at(curved::of<S>({x, y, 0.05 + z}));
  };
  CHECK(at(0.0049, -0.0049, 0.0049).covered());
  CHECK_FALSE(at(0.0051, 0, 0).covered());
  CHECK_FALSE(at(0, -0.0051, 0).covered());
  CHECK_FALSE(at(0, 0, 0.0051).covered());
  CHECK_THAT(static_cast<double>(S::norm(at(0.3, 0.2, -5).outward())), WithinAbs(1.0, 1e-6));
  CHECK_FALSE(at(std::nan(""), 0, 0).covered());
  brick.thickness = scalar(0.002);
  CHECK(at(0, 0, -0.0019).covered());
  CHECK_FALSE(at(0, 0, -0.0021).covered());

  const auto usable = [](ph::distance_brick<S> b) { return b.prepare(); };
  const auto good = curved::brick<S>();
  CHECK(usable(good));
  for (const scalar bad : {std::numeric_limits<scalar>::quiet_NaN(),
                           std::numeric_limits<scalar>::infinity(), scalar(0), scalar(-1)}) {
    auto b = good;
    b.coefficients[37] = bad;
    CHECK(usable(b) == std::isfinite(bad));
    b = good;
    b.origin = {bad, scalar(0), scalar(0)};
    CHECK(usable(b) == std::isfinite(bad));
    b = good;
    b.spacing = bad;
    CHECK_FALSE(usable(b));
    b = good;
    b.stiffness = bad;
    CHECK_FALSE(usable(b));
    b = good;
    b.thickness = bad;
    CHECK_FALSE(usable(b));
  }
  auto nothing = good;  // a field without a gradient still has a unit normal
  nothing.coefficients.fill(scalar(0));
  CHECK(S::norm(nothing.at(curved::of<S>({0, 0, 0.05})).outward()) == 1);
}
