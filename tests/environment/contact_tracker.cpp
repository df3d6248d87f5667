// SPDX-License-Identifier: BSD-3-Clause
#include "environment/shapes.hpp"
#include <passive_haptics/environment/contact_tracker.hpp>

#include <numbers>
#include <stdexcept>

TEST_CASE("contact_tracker holds its triangle under dither and leaves it beyond the margin",
          "[environment][surface]") {
  // A roof: triangle 0 faces −x, triangle 1 faces +x, the ridge runs along y.
  const std::vector<env::surface_triangle> roof{{{0, 2, 1}}, {{0, 1, 3}}};
  const std::vector<Vector3d> nodes{{0, -5, 0}, {0, 5, 0}, {-5, 0, -5}, {5, 0, -5}};
  constexpr double margin = 1e-3;
  env::contact_tracker tracker(margin);
  CHECK(tracker.find(roof, nodes, {0.5, 0, -1})->triangle == 1);
  int flips = 0;
  for (int tick = 0; tick < 100; ++tick) {  // 0.1 mm either side of the ridge, 1 m deep
    const Vector3d x{tick % 2 == 0 ? 1e-4 : -1e-4, 0, -1};
    flips += env::closest_point(roof, nodes, x)->triangle == 0 ? 1 : 0;
    CHECK(tracker.find(roof, nodes, x)->triangle == 1);
  }
  CHECK(flips == 50);  // without hysteresis: every other tick
  // At x = −a the other side is closer by √2 a.
  CHECK(tracker.find(roof, nodes, {-0.99 * margin / std::numbers::sqrt2, 0, -1})->triangle == 1);
  CHECK(tracker.find(roof, nodes, {-1.01 * margin / std::numbers::sqrt2, 0, -1})->triangle == 0);
  CHECK(tracker.find(roof, nodes, {0, 0, -1})->triangle == 0);
  tracker.reset();
  CHECK(tracker.find(roof, nodes, {1e-6, 0, -1})->triangle == 1);
  CHECK_FALSE(tracker.find(roof, nodes, {not_a_number, 0, 0}));
  CHECK(tracker.triangle() == 1);
  for (const double bad : {-1e-3, not_a_number}) {
    CHECK_THROWS_AS(env::contact_tracker(bad), std::invalid_argument);
  }
}

TEST_CASE("contact_tracker tells inside from outside whatever it holds", "[environment][surface]") {
  const auto mesh = env::ball(1.0);
  const auto surface = env::boundary(mesh);
  env::contact_tracker tracker(0.2);
  std::mt19937 random(3);
  Vector3d x{0, 0, 1.1};
  int held = 0;
  for (int tick = 0; tick < 5000; ++tick) {
    x = (x + 0.1 * anywhere(random, 1.0)).cwiseMax(-1.2).cwiseMin(1.2);
    const auto found = tracker.find(surface, mesh.nodes, x);
    const auto closest = env::closest_point(surface, mesh.nodes, x);
    REQUIRE(found);
    REQUIRE((found->depth > 0.0) == (closest->depth > 0.0));
    REQUIRE(found->distance <= closest->distance + 0.2);
    held += found->triangle != closest->triangle ? 1 : 0;
  }
  CHECK(held > 100);
}
