// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"

using Catch::Matchers::WithinAbs;

TEMPLATE_TEST_CASE("half_space measures positive depth inside, for a normal of any length (A2, A3)",
                   "[geometry]", d1, d2, d3) {
  using vector = typename TestType::vector;
  vector n = TestType::zero(), p = TestType::zero();
  if constexpr (TestType::dof == 1) {
    n = -4.0;
    p = 0.5;
  } else {
    n(TestType::dof - 1) = 4.0;
    p(0) = 0.5;
  }
  ph::half_space<TestType> plane{p, n, 100.0};
  REQUIRE(plane.prepare());
  const vector outward = plane.at(p).outward();
  CHECK_THAT(TestType::norm(outward), WithinAbs(1.0, 1e-15));
  const vector below = p - outward * 0.25, above = p + outward * 0.25;
  CHECK_THAT(plane.at(below).depth, WithinAbs(0.25, 1e-15));
  CHECK_THAT(plane.at(above).depth, WithinAbs(-0.25, 1e-15));
  CHECK(plane.at(above).covered());  // a plane has no edge
  const auto moved = plane.toward(plane, p, outward, 0.125);
  CHECK_THAT(moved.at(p).depth, WithinAbs(0.125, 1e-15));
}

TEMPLATE_TEST_CASE("degenerate and useless planes are refused (A17)", "[geometry]", d3, f3) {
  using scalar = typename TestType::scalar;
  const scalar nan = std::numeric_limits<scalar>::quiet_NaN();
  const scalar inf = std::numeric_limits<scalar>::infinity();
  const auto plane = [](ph::half_space<TestType> h) { return h.prepare(); };
  CHECK(plane({{0, 0, 0}, {0, 0, 1}, 1}));
  CHECK_FALSE(plane({{0, 0, 0}, {0, 0, 0}, 1}));
  CHECK_FALSE(plane({{0, 0, nan}, {0, 0, 1}, 1}));
  CHECK_FALSE(plane({{0, 0, 0}, {0, inf, 1}, 1}));
  CHECK_FALSE(plane({{0, 0, 0}, {0, 0, 1}, 0}));
  CHECK_FALSE(plane({{0, 0, 0}, {0, 0, 1}, -1}));
  CHECK_FALSE(plane({{0, 0, 0}, {0, 0, 1}, nan}));
  CHECK_FALSE(plane({{0, 0, 0}, {0, 0, 1}, inf}));
  const scalar huge = ph::kernels::largest<scalar>();  // finite, and its length is not
  CHECK_FALSE(plane({{0, 0, 0}, {0, huge, 0}, 1}));
}

TEST_CASE("a half_space is a constant expression where there is no Eigen in it", "[geometry]") {
  constexpr auto prepared = [] {
    ph::half_space<d1> plane{0.5, -4.0, 100.0};
    return plane.prepare() ? plane : ph::half_space<d1>{};
  }();
  static_assert(prepared.normal == -1.0 && prepared.stiffness == 100.0);
  static_assert(prepared.at(0.75).depth == 0.25);
  SUCCEED();
}
