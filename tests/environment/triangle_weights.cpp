// SPDX-License-Identifier: BSD-3-Clause
#include "environment/shapes.hpp"
#include <passive_haptics/environment/triangle_weights.hpp>

TEST_CASE("closest_weights finds the closest point of a triangle", "[environment][surface]") {
  std::mt19937 random(1);
  for (int run = 0; run < 2000; ++run) {
    env::triangle t{anywhere(random, 1), anywhere(random, 1), anywhere(random, 1)};
    if (run % 4 == 0) t[2] = t[0] + 0.3 * (t[1] - t[0]) + 1e-7 * anywhere(random, 1);  // a needle
    if (run % 16 == 1) t[2] = t[1];
    if (run % 64 == 2) t[2] = t[1] = t[0];
    const Vector3d p = anywhere(random, 2);
    const Vector3d w = env::closest_weights(t, p);
    REQUIRE_THAT(w.sum(), WithinAbs(1.0, 1e-12));
    REQUIRE(w.minCoeff() >= 0.0);
    const double found = (env::point_at(t, w) - p).norm();
    constexpr int steps = 40;
    double sampled = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; i + j <= steps; ++j) {
        const Vector3d s = Vector3d(i, j, steps - i - j) / steps;
        sampled = std::min(sampled, (env::point_at(t, s) - p).norm());
      }
    }
    REQUIRE(found <= sampled + 1e-12);
    REQUIRE(sampled - found < 4.0 / steps);
  }
}

TEST_CASE("closest_weights are exact at corners and edges", "[environment][surface]") {
  const env::triangle t{Vector3d{0, 0, 0}, Vector3d{1, 0, 0}, Vector3d{0, 1, 0}};
  CHECK(env::closest_weights(t, {-1, -1, 3}) == Vector3d(1, 0, 0));
  CHECK(env::closest_weights(t, {3, -1, 0}) == Vector3d(0, 1, 0));
  CHECK(env::closest_weights(t, {0.25, -2, 1}) == Vector3d(0.75, 0.25, 0));
  CHECK(env::closest_weights(t, {0.25, 0.25, -7}) == Vector3d(0.5, 0.25, 0.25));
}

TEST_CASE("force_shares: barycentric conserves force and moment, by_distance the force only",
          "[environment][surface]") {
  const env::triangle t{Vector3d{0, 0, 0}, Vector3d{1, 0, 0}, Vector3d{0.5, std::sqrt(0.75), 0}};
  using enum env::force_split;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double mean = 0.0;
  double worst = 0.0;
  constexpr int runs = 100000;
  for (int run = 0; run < runs; ++run) {
    double a = unit(random);
    double b = unit(random);
    if (a + b > 1.0) {
      a = 1.0 - a;
      b = 1.0 - b;
    }
    const Vector3d weights(a, b, 1.0 - a - b);
    const Vector3d point = env::point_at(t, weights);
    const Vector3d right = env::force_shares(barycentric, t, weights);
    const Vector3d thesis = env::force_shares(by_distance, t, weights);
    REQUIRE_THAT(right.sum(), WithinAbs(1.0, 1e-14));
    REQUIRE_THAT(thesis.sum(), WithinAbs(1.0, 1e-14));
    REQUIRE((env::point_at(t, right) - point).norm() < 1e-14);
    const double shift = (env::point_at(t, thesis) - point).norm();
    mean += shift / runs;
    worst = std::max(worst, shift);
  }
  CHECK_THAT(mean, WithinAbs(0.10, 0.01));   // of an edge (A25)
  CHECK_THAT(worst, WithinAbs(0.19, 0.01));  // of an edge (A25)
  // 22 % to the far node for a contact in the middle of an edge; all to a node for a contact there.
  CHECK_THAT(env::force_shares(by_distance, t, {0.5, 0.5, 0})[2], WithinAbs(0.224, 1e-3));
  CHECK(env::force_shares(by_distance, t, {0, 1, 0}) == Vector3d(0, 1, 0));
  CHECK(env::force_shares(by_distance, t, {1e-14, 1, 0}) == Vector3d(0, 1, 0));
}
