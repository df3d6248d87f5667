// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/curved.hpp"

#include <random>

using Catch::Matchers::WithinAbs;
using Eigen::Vector3d;

namespace {

template <class S = d3>
ph::quadric<S> bulge(double along = 20, double across = 20) {
  using scalar = typename S::scalar;
  return {.point = {0, 0, 0},
          .normal = {0, 0, 2},
          .tangent = {scalar(1), scalar(0), scalar(0.5)},
          .curvature = scalar(along),
          .cross_curvature = scalar(across),
          .stiffness = 500,
          .thickness = scalar(0.01)};
}
template <class S = d3>
ph::quadric<S> prepared(ph::quadric<S> q) {
  REQUIRE(q.prepare());
  return q;
}

}  // namespace

TEST_CASE("a quadric is the plane where it is not curved, and the ball to second order where it is",
          "[geometry][curved]") {
  const auto flat = prepared(bulge(0, 0));
  CHECK(flat.at({0.01, 0.02, -0.003}).depth == 0.003);
  CHECK(flat.at({0.01, 0.02, -0.003}).push() == d3::vector(0, 0, 1));

  const auto round = prepared(bulge());
  const ph::sphere<d3> ball{{0, 0, -0.05}, 0.05, 500};
  double last = 0.0;
  for (const double away : {0.001, 0.002, 0.004}) {
    const d3::vector x(0.8 * away, 0.6 * away, -0.001);
    const double miss = std::abs(round.at(x).depth - ball.at(x).depth);
    CHECK(miss < 300 * away * away * away);  // of third order
    CHECK(miss > 3 * last);
    last = miss;
  }
}

TEST_CASE("a quadric bends by its first curvature along its tangent, by the second across",
          "[geometry][curved]") {
  const auto cylinder = prepared(bulge(20, 0));
  const d3::vector t = cylinder.tangent;
  CHECK_THAT((t - d3::vector(1, 0, 0)).norm(), WithinAbs(0.0, 1e-15));
  CHECK(cylinder.at({0, 0.02, -0.001}).outward() == d3::vector(0, 0, 1));
  CHECK(cylinder.at({0.001, 0, 0}).outward().x() > 0.0199);  // as on a bulge
  const auto hollow = prepared(bulge(-20, 0));
  CHECK(hollow.at({0.001, 0, 0}).outward().x() < -0.0199);
  CHECK(hollow.at({0.001, 0, 0}).depth > 0.0);  // the edge of a bowl is above its middle
}

TEMPLATE_TEST_CASE("a quadric ends at its thickness and at its reach", "[geometry][curved]", d3,
                   f3) {
  using S = TestType;
  using scalar = typename S::scalar;
  auto q = bulge<S>(0, 0);
  q.reach = scalar(0.02);
  REQUIRE(q.prepare());
  const auto covers = [&](double x, double y, double z) {
    return q.at(curved::of<S>({x, y, z})).covered();
  };
  CHECK(covers(0.0, 0.0, -0.0099));
  CHECK_FALSE(covers(0.0, 0.0, -0.0101));
  CHECK(covers(0.0141, 0.0141, 0.5));
  CHECK(covers(0.02, 0.0, -0.001));  // the reach itself is inside
  CHECK(covers(0.0, -0.02, -0.001));
  CHECK_FALSE(covers(0.0142, 0.0142, -0.001));
  const scalar nan = std::numeric_limits<scalar>::quiet_NaN();
  CHECK_FALSE(q.at({nan, scalar(0), scalar(0)}).covered());
}

TEST_CASE("the push of a quadric is not longer than 1 + |curvature| thickness/2",
          "[geometry][curved]") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> in(-1, 1);
  double longest = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const auto q = prepared(bulge(90 * in(random), 90 * in(random)));
    const d3::vector x(0.05 * in(random), 0.05 * in(random), 0.05 * in(random));
    const auto seen = q.at(x);
    if (!seen.covered() || seen.depth < 0) continue;
    const double most = std::max(std::abs(q.curvature), std::abs(q.cross_curvature));
    const double length = seen.push().norm();
    if (!(length <= 1 + most * seen.depth / 2)) FAIL("case " << i << ": " << length);
    longest = std::max(longest, length);
  }
  CHECK(longest > 1.05);  // so that the bound is tried
}

TEST_CASE("the force on a quadric is not steeper than K (1 + 3 kd + 1.25 (kd)^2)",
          "[geometry][curved]") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> in(-1, 1);
  double steepest = 0.0, closest = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const auto q = prepared(bulge(90 * in(random), 90 * in(random)));
    const Vector3d x(0.02 * in(random), 0.02 * in(random), -0.005 + 0.005 * in(random));
    const Vector3d step = 1e-7 * Vector3d(in(random), in(random), in(random)).normalized();
    const auto here = q.at(x);
    if (!q.at(x - step).covered() || !q.at(x + step).covered() || here.depth < 1e-6) continue;
    const double slope =
        (curved::force<d3>(q, x + step) - curved::force<d3>(q, x - step)).norm() / 2e-7;
    const double kd = std::max(std::abs(q.curvature), std::abs(q.cross_curvature)) * here.depth;
    const double most = q.stiffness * (1 + 3 * kd + 1.25 * kd * kd);
    if (!(slope <= most * 1.00001)) FAIL("case " << i << ": " << slope << " of " << most);
    steepest = std::max(steepest, slope / q.stiffness);
    closest = std::max(closest, slope / most);
  }
  CHECK(steepest > 1.3);  // so that a bound of K would not do
  CHECK(closest > 0.9);
}

TEMPLATE_TEST_CASE("a quadric that cannot be used, or folds, is refused", "[geometry][curved]", d3,
                   f3) {
  using S = TestType;
  using scalar = typename S::scalar;
  const scalar nan = std::numeric_limits<scalar>::quiet_NaN();
  const scalar inf = std::numeric_limits<scalar>::infinity();
  const auto refused = [](const auto& change, double across = 10) {
    auto q = bulge<S>(20, across);
    change(q);
    return !q.prepare();
  };
  CHECK_FALSE(refused([](auto& /*q*/) {}));
  CHECK(refused([](auto& q) { q.normal = {0, 0, 0}; }));
  CHECK(refused([](auto& q) { q.tangent = {0, 0, 0}; }));
  CHECK(refused([](auto& q) { q.tangent = q.normal; }));
  CHECK_FALSE(refused([](auto& q) { q.tangent = {0, 0, 0}; }, 20));  // then no axis matters
  CHECK(refused([](auto& q) { q.curvature = 100; }));                // 100/m · 10 mm
  CHECK(refused([](auto& q) { q.cross_curvature = -100; }));
  CHECK_FALSE(refused([](auto& q) { q.cross_curvature = -99; }));
  for (const scalar bad : {nan, inf, -inf}) {
    CHECK(refused([&](auto& q) { q.point = {bad, scalar(0), scalar(0)}; }));
    CHECK(refused([&](auto& q) { q.normal = {scalar(0), bad, scalar(1)}; }));
    CHECK(refused([&](auto& q) { q.tangent = {scalar(1), bad, scalar(0)}; }));
    CHECK(refused([&](auto& q) { q.curvature = bad; }));
    CHECK(refused([&](auto& q) { q.cross_curvature = bad; }));
    CHECK(refused([&](auto& q) { q.curvature = q.cross_curvature = bad; }));
  }
  for (const scalar bad : {nan, inf, scalar(0), scalar(-1)}) {
    CHECK(refused([&](auto& q) { q.stiffness = bad; }));
    CHECK(refused([&](auto& q) { q.thickness = bad; }));
    CHECK(refused([&](auto& q) { q.reach = bad; }) == !(bad > 0));
  }
  // A normal so short or long that its square is no number still has a direction.
  const scalar tiny = ph::kernels::smallest<scalar>() * 4,
               huge = ph::kernels::largest<scalar>() / 4;
  CHECK_FALSE(refused([&](auto& q) { q.normal = {scalar(0), scalar(0), tiny}; }));
  CHECK_FALSE(refused([&](auto& q) { q.normal = {scalar(0), scalar(0), huge}; }));
}

TEST_CASE("a quadric that follows another lies where it is told to, as curved and along its axis",
          "[geometry][curved]") {
  const auto target = prepared(bulge<d3>(20, -30));
  auto own = prepared(bulge<d3>(1, 1));
  for (const Vector3d& n : {Vector3d(0, 0, 1), Vector3d(0.6, 0, 0.8), Vector3d(0.8, 0.6, 0)}) {
    const Vector3d x(0.01, -0.02, 0.003);
    const auto moved = own.toward(target, x, n, 0.004);
    const auto seen = moved.at(x);
    CHECK_THAT(seen.depth, WithinAbs(0.004, 1e-15));
    CHECK_THAT((seen.outward() - n).norm(), WithinAbs(0.0, 1e-12));
    CHECK(moved.curvature == 20);
    CHECK(moved.cross_curvature == -30);
    CHECK(moved.stiffness == target.stiffness);
    const Vector3d t = moved.tangent, across = Vector3d(target.tangent) - n * n.x();
    CHECK_THAT(t.norm(), WithinAbs(1.0, 1e-12));
    CHECK_THAT(t.dot(n), WithinAbs(0.0, 1e-12));
    CHECK_THAT(t.dot(across.normalized()), WithinAbs(1.0, 1e-12));
  }
  const auto steep = own.toward(target, {0, 0, 0}, {1, 0, 0}, 0.0);  // along its own axis
  CHECK_THAT(Vector3d(steep.tangent).dot(Vector3d::UnitX()), WithinAbs(0.0, 1e-12));
  CHECK_THAT(Vector3d(steep.tangent).norm(), WithinAbs(1.0, 1e-12));
}

TEST_CASE("a quadric ends just at its thickness, and is looked for within ten of them or its reach",
          "[geometry][curved]") {
  auto q = prepared(bulge(0, 0));
  CHECK(q.at({0, 0, -0.01}).covered());
  CHECK(q.around().radius == 0.1);
  q.reach = 0.02;
  CHECK(q.around().radius == 0.02);
}

TEST_CASE("a tangent of any length is across the normal from a thousandth of it on",
          "[geometry][curved]") {
  const auto usable = [](double across, double along) {
    auto q = bulge(20, 10);
    q.tangent = {across, 0, along};
    return q.prepare();
  };
  CHECK(usable(1e-6, 0.0));
  CHECK(usable(0.05, 1.0));
  CHECK(usable(1.1e-3, 1.0));
  CHECK_FALSE(usable(0.9e-3, 1.0));
  auto hollow = bulge(-100, 10);  // −100/m · 10 mm
  CHECK_FALSE(hollow.prepare());
  hollow.curvature = -99;
  CHECK(hollow.prepare());
}
