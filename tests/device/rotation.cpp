// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include <passive_haptics/base/samples.hpp>
#include <passive_haptics/device/rotation.hpp>

#include <array>

using Catch::Matchers::WithinAbs;
namespace ph = passive_haptics;

namespace {

using vec3 = ph::rotation::vector<double>;
using quat = ph::quaternion<double>;
using d3 = ph::space<double, 3>;

[[nodiscard]] vec3 random_turn(ph::laws::samples& random, double most) {
  const double size = ph::kernels::magnitude(random.number<double>());
  return random.direction<d3>() * (most * size);
}
[[nodiscard]] quat random_orientation(ph::laws::samples& random) {
  return ph::rotation::exp<double>(random_turn(random, 3.1));
}
/// R as a matrix, by Rodrigues' formula: another way than quaternions.
[[nodiscard]] Eigen::Matrix3d matrix(const vec3& turn) {
  const double angle = turn.norm();
  const vec3 u = turn / angle;
  Eigen::Matrix3d cross;
  cross << 0, -u(2), u(1), u(2), 0, -u(0), -u(1), u(0), 0;
  return Eigen::Matrix3d::Identity() + std::sin(angle) * cross +
         (1 - std::cos(angle)) * cross * cross;
}

}  // namespace

TEST_CASE("exp and log of a rotation are each other's inverse, at any size", "[rotation]") {
  ph::laws::samples random(1);
  for (const double most : {1e-12, 1e-6, 1e-3, 0.02, 0.3, 1.0, 3.14}) {
    for (int i = 0; i < 200; ++i) {
      const vec3 turn = random_turn(random, most);
      const vec3 back = ph::rotation::log(ph::rotation::exp<double>(turn));
      CHECK((back - turn).norm() <= 4e-16 * (1 + 3 * most) * most);
    }
  }
}

TEST_CASE("rotate turns as Rodrigues' formula does, and products as one after the other",
          "[rotation]") {
  ph::laws::samples random(2);
  for (int i = 0; i < 200; ++i) {
    const vec3 a = random_turn(random, 3.0), b = random_turn(random, 3.0);
    const vec3 v = random.vector<d3>();
    const quat qa = ph::rotation::exp<double>(a), qb = ph::rotation::exp<double>(b);
    CHECK((ph::rotation::rotate(qa, v) - matrix(a) * v).norm() < 1e-14);
    const vec3 both = ph::rotation::rotate(ph::rotation::product(qa, qb), v);
    CHECK((both - matrix(a) * (matrix(b) * v)).norm() < 1e-14);
    CHECK(
        (ph::rotation::rotate(ph::rotation::conjugate(qa), v) - matrix(a).transpose() * v).norm() <
        1e-14);
  }
}

TEST_CASE(
    "turned is the turn in the world frame, as exact for the least of turns as for large ones",
    "[rotation]") {
  ph::laws::samples random(3);
  for (const double most : {1e-9, 1e-4, 0.01, 0.5, 3.0}) {
    double worst = 0;
    for (int i = 0; i < 500; ++i) {
      const quat from = random_orientation(random);
      const vec3 turn = random_turn(random, most);
      quat to =
          ph::rotation::normalised(ph::rotation::product(ph::rotation::exp<double>(turn), from));
      if (i % 2 != 0) to = {-to.w, -to.x, -to.y, -to.z};
      worst = (std::max)(worst, (ph::rotation::turned(from, to) - turn).norm());
    }
    CHECK(worst < 1e-15 + 1e-15 * most);
  }
  const quat q = random_orientation(random);
  CHECK(ph::rotation::turned(q, q).norm() == 0.0);
  CHECK(ph::rotation::turned(q, quat{-q.w, -q.x, -q.y, -q.z}).norm() == 0.0);
}

TEST_CASE("a quaternion whose norm is off by a thousandth is none of a rotation", "[rotation]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  CHECK(ph::rotation::is_unit(quat{0.9995, 0, 0, 0}));
  CHECK(ph::rotation::is_unit(quat{0, 0, -1.0005, 0}));
  CHECK_FALSE(ph::rotation::is_unit(quat{0.998, 0, 0, 0}));
  CHECK_FALSE(ph::rotation::is_unit(quat{0, 1.002, 0, 0}));
  CHECK_FALSE(ph::rotation::is_unit(quat{0, 0, 0, 0}));
  CHECK_FALSE(ph::rotation::is_unit(quat{1, 0, nan, 0}));
  CHECK_FALSE(ph::rotation::is_unit(quat{inf, 0, 0, 0}));
}

TEST_CASE("a quaternion of any norm but zero is that of a rotation when it is normalised",
          "[rotation]") {
  for (const double norm : {1e-100, 5e-3, 0.5, 0.98, 0.99996, 1.00004, 3.0, 1e100}) {
    CAPTURE(norm);
    const quat q = ph::rotation::normalised(quat{0.1 * norm, -0.7 * norm, 0.5 * norm, -0.5 * norm});
    CHECK_THAT(q.w, WithinAbs(0.1, 4e-16));
    CHECK_THAT(q.x, WithinAbs(-0.7, 4e-16));
    CHECK_THAT(q.y, WithinAbs(0.5, 4e-16));
    CHECK_THAT(q.z, WithinAbs(-0.5, 4e-16));
  }
}

TEST_CASE("a quaternion and its opposite have one rotation vector, of half a turn at most",
          "[rotation]") {
  ph::laws::samples random(4);
  for (int i = 0; i < 100; ++i) {
    const quat q = random_orientation(random);
    const vec3 turn = ph::rotation::log(quat{-q.w, -q.x, -q.y, -q.z});
    CHECK(turn == ph::rotation::log(q));
    CHECK(turn.norm() <= 3.1416);
  }
}

TEST_CASE("exp and log are as exact in a wider number as it is", "[rotation]") {
  using wide = ph::rotation::vector<long double>;
  for (const long double angle : {1e-6L, 1e-3L, 0.019L, 0.021L, 1.0L}) {
    const wide turn(0.6L * angle, 0.0L, 0.8L * angle);
    const wide back = ph::rotation::log(ph::rotation::exp<long double>(turn));
    CHECK((back - turn).norm() <= 16 * std::numeric_limits<long double>::epsilon() * angle);
  }
}

TEST_CASE("half a turn is one about the axis that is said, not about its opposite", "[rotation]") {
  const double pi = std::acos(-1.0);
  CHECK_THAT(ph::rotation::log(quat{0, 0, 1, 0}).y(), WithinAbs(pi, 1e-15));
  CHECK_THAT(ph::rotation::log(quat{0, 0, -1, 0}).y(), WithinAbs(-pi, 1e-15));
  CHECK_THAT(ph::rotation::turned(quat{1, 0, 0, 0}, quat{0, 0, 1, 0}).y(), WithinAbs(pi, 1e-15));
}
