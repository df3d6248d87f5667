// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/curved.hpp"
#include "support/obedience.hpp"

#include <algorithm>
#include <array>
#include <random>

using Catch::Matchers::WithinAbs;
using Eigen::Vector3d;

namespace {

template <class Core>
ph::shell<Core> shell_of(const Core& core, double radius = 0.004, double K = 500) {
  using scalar = typename Core::space_type::scalar;
  ph::shell<Core> s{core, scalar(radius), scalar(K)};
  REQUIRE(s.prepare());
  return s;
}
const ph::box_core<d3> box{
    .centre = {0.01, 0, 0}, .half = {0.02, 0.01, 0.01}, .first = {1, 1, 0}, .second = {0, 3, 0}};

/// The largest slope of the force across ticks of 1 µm while x goes round the box's corners, `depth`
/// deep in the shell.
double steepest(const auto& shell, double depth) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> in(-1, 1);
  double steepest = 0.0;
  for (int i = 0; i < 20000; ++i) {
    Vector3d x(0.04 * in(random), 0.04 * in(random), 0.04 * in(random));
    const auto seen = shell.at(x);
    if (seen.depth > shell.radius - 1e-5) continue;  // in the core
    x += seen.outward() * (seen.depth - depth);      // to where it is `depth` deep
    const Vector3d step = 1e-6 * Vector3d(in(random), in(random), in(random)).normalized();
    const Vector3d turn = curved::force<d3>(shell, x + step) - curved::force<d3>(shell, x);
    steepest = std::max(steepest, turn.norm() / step.norm());
  }
  return steepest;
}

}  // namespace

TEST_CASE("a shell measures depth from its rounded surface, in the core too",
          "[geometry][curved]") {
  const auto capsule = shell_of(ph::segment_core<d3>{{0, 0, 0}, {0.02, 0, 0}});
  CHECK_THAT(capsule.at({0.01, 0.003, 0}).depth, WithinAbs(0.001, 1e-15));
  CHECK_THAT(capsule.at({0.023, 0, 0}).depth, WithinAbs(0.001, 1e-15));
  CHECK(capsule.at({0.023, 0, 0}).outward() == d3::vector(1, 0, 0));
  CHECK_THAT(capsule.at({0.01, 0, 0}).depth, WithinAbs(0.004, 1e-15));  // on the core
  CHECK_THAT(capsule.at({0.01, 0, 0}).outward().x(), WithinAbs(0.0, 1e-15));

  const auto plate = shell_of(ph::triangle_core<d3>{{0, 0, 0}, {0.02, 0, 0}, {0, 0.02, 0}});
  CHECK_THAT(plate.at({0.005, 0.005, -0.003}).depth, WithinAbs(0.001, 1e-15));
  CHECK(plate.at({0.005, 0.005, -0.003}).outward() == d3::vector(0, 0, -1));
  CHECK(plate.at({0.005, 0.005, 0.003}).outward() == d3::vector(0, 0, 1));
  CHECK(plate.at({0.005, 0.005, 0}).outward() == d3::vector(0, 0, 1));

  const auto cuboid = shell_of(ph::box_core<d3>{.centre = {0, 0, 0}, .half = {0.02, 0.01, 0.005}});
  CHECK_THAT(cuboid.at({0, 0, 0.004}).depth, WithinAbs(0.005, 1e-15));  // 1 mm deep in the core
  CHECK(cuboid.at({0, 0, 0.004}).outward() == d3::vector(0, 0, 1));
  CHECK(cuboid.at({0, -0.0095, 0.004}).outward() == d3::vector(0, -1, 0));
  CHECK_THAT(cuboid.at({0.02 + 0.002, 0.01 + 0.002, 0.005 + 0.001}).depth,
             WithinAbs(0.001, 1e-15));  // off a corner, 3 mm
}

TEST_CASE("a segment is in the ball about its middle", "[geometry][curved]") {
  const auto ball = ph::segment_core<d3>{{0.01, 0, 0}, {0.03, 0, 0}}.around();
  CHECK((d3::vector(ball.centre) - d3::vector(0.02, 0, 0)).norm() < 1e-15);
  CHECK_THAT(ball.radius, WithinAbs(0.01, 1e-15));
}

TEST_CASE("the depth of a shell does not jump where its core begins", "[geometry][curved]") {
  const auto cuboid = shell_of(box);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> in(-1, 1);
  int crossed = 0;
  for (int i = 0; i < 20000; ++i) {
    const d3::vector x(0.03 * in(random), 0.03 * in(random), 0.03 * in(random));
    const auto core = cuboid.core.closest(x);
    if (!(d3::norm(core.point - x) > 0)) continue;
    const d3::vector on = core.point, step = (on - x).normalized() * 1e-7;
    const auto before = cuboid.at(on - step), behind = cuboid.at(on + step);
    if (std::abs(before.depth - behind.depth) > 2.1e-7) FAIL("case " << i);
    crossed += cuboid.core.closest(on - step).inside != cuboid.core.closest(on + step).inside;
  }
  CHECK(crossed > 15000);
}

TEST_CASE("a shell's slope is K d/(r - d) at most, and K for d up to half its radius",
          "[geometry][curved]") {
  const auto cuboid = shell_of(box);
  CHECK(steepest(cuboid, 0.001) <= 500 * 1.001);
  CHECK(steepest(cuboid, 0.002) <= 500 * 1.001);
  const double deep = steepest(cuboid, 0.003);  // the control: K · 3/(4 − 3)
  CHECK(deep > 500 * 2.5);
  CHECK(deep <= 500 * 3.003);
}

TEST_CASE("a shell does in the plane and on the line as well", "[geometry][curved]") {
  obey<role::surface, d2>(ph::shell<ph::segment_core<d2>>{{{0, 0}, {0.02, 0.01}}, 0.01, 500},
                          ph::shell<ph::point_core<d2>>{{{0.01, 0}}, 0.01, 500});
  obey<role::surface, f2>(ph::shell<ph::segment_core<f2>>{{{0, 0}, {0.02F, 0.01F}}, 0.01F, 500});
  obey<role::surface, d1>(ph::shell<ph::point_core<d1>>{{0.01}, 0.01, 500});
}

TEMPLATE_TEST_CASE("a shell that cannot be used is refused", "[geometry][curved]", d3, f3) {
  using S = TestType;
  using scalar = typename S::scalar;
  const auto usable = [](auto core, scalar radius = scalar(0.01), scalar K = scalar(500)) {
    return ph::shell<decltype(core)>{core, radius, K}.prepare();
  };
  const scalar nan = std::numeric_limits<scalar>::quiet_NaN();
  const scalar inf = std::numeric_limits<scalar>::infinity();
  const ph::segment_core<S> segment{{0, 0, 0}, {1, 0, 0}};
  const ph::triangle_core<S> triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const ph::box_core<S> cube{.centre = {0, 0, 0}, .half = {1, 1, 0}};  // flat, a plate
  CHECK(usable(ph::point_core<S>{}));
  CHECK(usable(segment));
  CHECK(usable(triangle));
  CHECK(usable(cube));
  CHECK_FALSE(usable(ph::segment_core<S>{{1, 0, 0}, {1, 0, 0}}));
  CHECK_FALSE(usable(ph::triangle_core<S>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}));
  for (const scalar bad : {nan, inf, scalar(0), scalar(-1)}) {
    CHECK_FALSE(usable(segment, bad));
    CHECK_FALSE(usable(segment, scalar(0.01), bad));
    auto half = cube;
    half.half = {1, bad, 1};
    CHECK(usable(half) == (bad == 0));
    half.half = {1, 1, bad};
    CHECK(usable(half) == (bad == 0));
  }
  for (const scalar bad : {nan, inf}) {
    CHECK_FALSE(usable(ph::point_core<S>{{bad, scalar(0), scalar(0)}}));
    CHECK_FALSE(usable(ph::segment_core<S>{{bad, scalar(0), scalar(0)}, {0, 0, 0}}));
    CHECK_FALSE(usable(ph::triangle_core<S>{{0, 0, 0}, {1, 0, 0}, {bad, scalar(0), scalar(0)}}));
    auto b = cube;
    b.centre = {scalar(0), scalar(0), bad};
    CHECK_FALSE(usable(b));
    b = cube;
    b.first = {bad, scalar(0), scalar(0)};
    CHECK_FALSE(usable(b));
  }
  auto b = cube;
  b.first = {0, 0, 0};
  CHECK_FALSE(usable(b));
  b.first = {0, 5, 0};  // parallel to the second
  CHECK_FALSE(usable(b));
}

TEST_CASE("the ball around a core is the one that its corners reach from its middle",
          "[geometry][curved]") {
  std::array<Vector3d, 3> corner{Vector3d(0.01, 0.002, 0), Vector3d(0.03, 0, 0.001),
                                 Vector3d(-0.02, 0.04, 0.005)};
  const Vector3d middle = (corner[0] + corner[1] + corner[2]) / 3.0;
  double farthest = 0.0;
  for (const auto& x : corner) farthest = std::max(farthest, (x - middle).norm());
  for (int turn = 0; turn < 3; ++turn) {
    std::rotate(corner.begin(), corner.begin() + 1, corner.end());
    const auto ball = ph::triangle_core<d3>{corner[0], corner[1], corner[2]}.around();
    CHECK_THAT((Vector3d(ball.centre) - middle).norm(), WithinAbs(0.0, 1e-15));
    CHECK_THAT(ball.radius, WithinAbs(farthest, 1e-15));
  }
  const auto of_box = box.around();
  CHECK_THAT(of_box.radius, WithinAbs(std::sqrt(6.0) * 0.01, 1e-15));
  CHECK(Vector3d(of_box.centre) == Vector3d(0.01, 0, 0));
  const auto of_point = shell_of(ph::point_core<d3>{{0.01, 0, 0}}).around();
  CHECK(of_point.radius == 0.008);
  const auto of_line = ph::segment_core<d3>{{0.01, 0, 0.04}, {0.03, 0, 0.04}}.around();
  CHECK_THAT((Vector3d(of_line.centre) - Vector3d(0.02, 0, 0.04)).norm(), WithinAbs(0.0, 1e-15));
}

TEST_CASE("a box with an edge below zero is none, with one of zero it is a plate",
          "[geometry][curved]") {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    auto core = box;
    core.half.values[axis] = 0.0;
    CHECK(core.prepare());
    core.half.values[axis] = -1e-9;
    CHECK_FALSE(core.prepare());
  }
}

TEST_CASE("of a box the first of its nearest faces counts, on its positive side",
          "[geometry][curved]") {
  const auto at = [](const d3::coordinates& half, const d3::vector& x) {
    ph::box_core<d3> core{.centre = {0, 0, 0}, .half = half};
    REQUIRE(core.prepare());
    return core.closest(x);
  };
  CHECK(at({1, 1, 1}, {0, 0, 0}).normal == d3::vector(1, 0, 0));
  CHECK(at({1, 1, 0.5}, {0, 0, 0}).normal == d3::vector(0, 0, 1));
  CHECK(at({1, 1, 0.5}, {0, 0, 0}).point == d3::vector(0, 0, 0.5));
  CHECK(at({1, 1, 0.5}, {0, 0, -0.25}).point == d3::vector(0, 0, -0.5));
  CHECK(at({1, 1, 0.5}, {0, 0, 0.5}).inside);  // on it
  CHECK_FALSE(at({1, 1, 0.5}, {0, 0, 0.75}).inside);
  CHECK(shell_of(box).at({0.01, 0, 0}).covered());
}

TEST_CASE("a box has axes that are a thousandth apart, and a segment a length with a square",
          "[geometry][curved]") {
  const auto usable = [](double apart) {
    return ph::box_core<d3>{
        .centre = {0, 0, 0}, .half = {1, 1, 1}, .first = {1, 0, 0}, .second = {1, apart, 0}}
        .prepare();
  };
  CHECK(usable(0.05));
  CHECK(usable(1.1e-3));
  CHECK_FALSE(usable(0.9e-3));
  const auto as_long = [](double length) {
    return ph::segment_core<d3>{{0, 0, 0}, {length, 0, 0}}.prepare();
  };
  CHECK(as_long(std::ldexp(1.0, -510)));
  CHECK_FALSE(as_long(std::ldexp(1.0, -511)));  // its square is the least normal number
}

TEST_CASE("on its core a capsule has a unit normal across it, however long it is",
          "[geometry][curved]") {
  for (const double length : {1e-3, 1.0, 7.0}) {
    const d3::vector end = length * d3::vector(1, 2, 3);
    const auto capsule = shell_of(ph::segment_core<d3>{{0, 0, 0}, end});
    const d3::vector n = capsule.core.closest(end / 2).normal;
    CHECK_THAT(n.norm(), WithinAbs(1.0, 1e-15));
    CHECK_THAT(n.dot(end), WithinAbs(0.0, 1e-14));
  }
}
