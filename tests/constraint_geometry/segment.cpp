// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"

using Catch::Matchers::WithinAbs;

TEST_CASE("segment has its normal on the right and ends at its nodes", "[geometry]") {
  ph::segment<d2> s{.a = {0, 0}, .b = {0.02, 0}, .stiffness = 100};
  REQUIRE(s.prepare());
  CHECK(s.at({0, 0}).outward() == d2::vector(0, -1));
  CHECK_THAT(s.at({0.01, 0.001}).depth, WithinAbs(0.001, 1e-18));
  CHECK(s.at({0.01, 0.001}).covered());
  CHECK_FALSE(s.at({-0.001, 0.001}).covered());
  CHECK_FALSE(s.at({0.021, 0.001}).covered());
  CHECK(s.at({0, 0.001}).covered());  // its ends are its own: two segments leave no gap
  CHECK(s.at({0.02, 0.001}).covered());
  ph::segment<d2> point{.a = {1, 1}, .b = {1, 1}, .stiffness = 100};
  CHECK_FALSE(point.prepare());
}

TEMPLATE_TEST_CASE("degenerate and useless segments are refused (A17)", "[geometry]", d2, f2) {
  using scalar = typename TestType::scalar;
  const ph::segment<TestType> good{.a = {0, 0}, .b = {1, 0}, .stiffness = 1};
  const auto usable = [](ph::segment<TestType> s) { return s.prepare(); };
  CHECK(usable(good));
  for (const scalar bad :
       {std::numeric_limits<scalar>::quiet_NaN(), std::numeric_limits<scalar>::infinity()}) {
    auto s = good;
    s.b = {bad, 0};
    CHECK_FALSE(usable(s));
    s = good;
    s.stiffness = bad;
    CHECK_FALSE(usable(s));
  }
  auto endless = good;
  endless.b = {ph::kernels::largest<scalar>(), 0};  // finite, and its length is not
  CHECK_FALSE(usable(endless));
  for (const scalar nothing : {scalar(0), scalar(-5)}) {
    auto s = good;
    s.stiffness = nothing;
    CHECK_FALSE(usable(s));
    s = good;
    s.thickness = nothing;
    CHECK_FALSE(usable(s));
  }
}

TEST_CASE("segment ends at its thickness (A18)", "[geometry]") {
  ph::segment<d2> s{.a = {0, 0}, .b = {0.02, 0}, .stiffness = 100, .thickness = 0.01};
  REQUIRE(s.prepare());
  CHECK(s.at({0.01, 0.009}).covered());
  CHECK_FALSE(s.at({0.01, 0.011}).covered());
  CHECK(s.at({0.01, 0.01}).covered());
}

TEST_CASE("a segment's nodes follow the lines of Fig. 2.5, too", "[geometry]") {
  ph::segment<d2> own{.a = {0.02, 0}, .b = {0, 0}, .stiffness = 100};
  ph::segment<d2> target{.a = {0.021, 0.004}, .b = {0.001, 0.004}, .stiffness = 200};
  REQUIRE(own.prepare());
  REQUIRE(target.prepare());
  const d2::vector x(0.01, -0.001);
  const auto moved = own.toward(target, x, {0, 1}, 0.003);  // the line y = 0.002, half way
  CHECK((d2::vector(moved.a) - d2::vector(0.0205, 0.002)).norm() < 1e-15);
  CHECK((d2::vector(moved.b) - d2::vector(0.0005, 0.002)).norm() < 1e-15);
  CHECK_THAT(moved.at(x).depth, WithinAbs(0.003, 1e-15));
  CHECK(moved.stiffness == 200);
}

TEST_CASE("a segment of any direction, anywhere, has its normal and its ends", "[geometry]") {
  ph::segment<d2> s{.a = {0, 0}, .b = {3, 4}, .stiffness = 100};
  REQUIRE(s.prepare());
  CHECK((s.at({0, 0}).outward() - d2::vector(0.8, -0.6)).norm() < 1e-15);
  s.a = {1, 1};
  s.b = {1, 2};
  REQUIRE(s.prepare());
  CHECK(s.at({2, 1.5}).covered());
  CHECK_FALSE(s.at({2, 0.5}).covered());
  CHECK_FALSE(s.at({2, 2.5}).covered());
}
