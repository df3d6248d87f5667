// SPDX-License-Identifier: BSD-3-Clause
// One finger between several meshes, each with its own pose and news; several fingers on one mesh; news out of order.
#include "mesh/shapes.hpp"

using namespace meshes;
using Catch::Matchers::Contains;

TEST_CASE("a finger in the corner of two meshes is held by both, and by one when that is let go",
          "[mesh]") {
  const body b = plate();
  ph::mesh::surface floor(b.triangles, b.nodes), wall(b.triangles, b.nodes);
  ph::mesh::pose upright;  // its upper side faces +x, at x = 0
  upright.w = std::sqrt(0.5);
  upright.axis = {0.0, std::sqrt(0.5), 0.0};
  REQUIRE(wall.update(upright));
  ph::mesh::proxy ball({.radius = 5e-4});
  REQUIRE(ball.touch(floor));
  REQUIRE(ball.also_touch(wall));
  CHECK_FALSE(ball.also_touch(wall));
  for (int k = 0; k < 30; ++k) ball.step({0.02 - 1e-3 * k, 0.003, 0.02 - 1e-3 * k}, T);
  CHECK(length(ball.place() - triple{5e-4, 0.003, 5e-4}) < 1e-9);
  ball.let_go(wall);  // alone, a plate from outside is at the same place
  for (int k = 0; k < 60; ++k) ball.step({-0.009, 0.003, -0.009}, T);  // r/2 a tick, or more
  CHECK(length(ball.place() - triple{-0.009, 0.003, 5e-4}) < 1e-9);
}

TEST_CASE("a mesh that is touched as well comes where it is, and takes no side away", "[mesh]") {
  const body b = plate(), c = sphere(2, 0.02), mote = sphere(1, 0.001);
  std::vector<triple> beside = mote.nodes;
  for (triple& p : beside) p = p + triple{0.0, 0.0012, 5e-4};
  ph::mesh::surface floor(b.triangles, b.nodes), far(c.triangles, c.nodes),
      near(mote.triangles, beside);
  REQUIRE(far.update(ph::mesh::pose{.position = {0.5, 0.0, 0.0}}));
  ph::mesh::proxy ball({.radius = 5e-4});
  ball.touch(floor);
  for (int k = 0; k < 60; ++k) ball.step({0.0, 0.0, 0.02 - 5e-4 * k}, T);
  REQUIRE(length(ball.place() - triple{0.0, 0.0, 5e-4}) < 1e-9);
  for (const auto* other :
       {&far, &near}) {  // one that was never here, and one within r of the ball
    REQUIRE(ball.also_touch(*other));
    for (int k = 0; k < 100; ++k) {
      ball.step({0.0, 0.0, -0.01}, T);
      REQUIRE(ball.placed());
      REQUIRE(ball.place().z >= 2.5e-4);
      REQUIRE(length(ball.place() - triple{0.0, 0.0, 5e-4}) < 5e-4);
    }
  }
  CHECK(ball.where(1).position.x == 0.5);
  ph::mesh::proxy above(
      {.radius = 5e-4});  // in the air, where the far sphere would be without its pose
  above.touch(floor);
  above.step({0.0, 0.0, 0.01}, T);
  REQUIRE(above.also_touch(far));
  for (int k = 0; k < 100; ++k) above.step({0.0, 0.0, 0.01}, T);
  CHECK(above.place() == triple{0.0, 0.0, 0.01});
  above.let_go();
  ball.let_go();
}

TEST_CASE("no mesh of two lets the ball through while both move, turn and bend", "[mesh]") {
  const body plates = plate(), balls = sphere(2, 0.03);
  int by[2] = {0, 0};
  for (const unsigned seed : {1U, 2U, 3U}) {
    ph::mesh::surface one(plates.triangles, plates.nodes), other(balls.triangles, balls.nodes);
    ph::mesh::proxy ball({.radius = 5e-4});
    REQUIRE(ball.touch(one));
    REQUIRE(ball.also_touch(other));
    std::mt19937 random(seed);
    std::uniform_real_distribution<> any(-0.05, 0.05);
    triple x{0.0, 0.0, 0.12}, goal;
    double round[2] = {-1e9, -1e9}, least = 1.0;
    int through = 0;
    for (int k = 0; k < 3000; ++k) {
      if (k % 33 == 0) {
        const double half = 0.4 * std::sin(0.004 * k);
        REQUIRE(one.update(ph::mesh::pose{
            {0, 0, 0.02 * std::sin(0.006 * k)}, std::cos(half), {std::sin(half), 0, 0}}));
        REQUIRE(other.update(ph::mesh::pose{{0.04 * std::sin(0.005 * k), 0, 0.05}}));
        auto nodes = balls.nodes;
        for (triple& p : nodes) p = p * (1.0 + 0.2 * std::sin(0.009 * k));
        REQUIRE(other.update(nodes));
      }
      if (k % 200 == 0) goal = {any(random), any(random), any(random)};
      const triple way = goal - x;
      x = length(way) > T ? x + way * (T / length(way)) : goal;
      ball.step(x, T);
      if (!ball.placed()) continue;
      for (int j = 0; j < ball.pressed().count; ++j) {
        ++by[ball.plane(ball.pressed().of[std::size_t(j)]).mesh];
      }
      if (k % 4 != 0) continue;
      least = std::min(least, ball.clearance());
      for (int m = 0; m < 2; ++m) {
        std::vector<corners> all;
        const auto count = (m == 0 ? one : other).triangles().size();
        for (int i = 0; i < int(count); ++i) all.push_back(ball.triangle(i, m));
        const auto& where = ball.where(m);
        const double now = winding(all, where.in(ball.place() - where.position));
        through += round[m] > -1e8 && std::abs(now - round[m]) > 0.5 ? 1 : 0;
        round[m] = now;
      }
    }
    INFO("seed " << seed);
    CHECK(through == 0);
    CHECK(least >= 1.25e-4);
  }
  CHECK(by[0] > 100);
  CHECK(by[1] > 100);
}

TEST_CASE("several fingers on one mesh take its news each in its own time", "[mesh]") {
  const body b = plate();
  ph::mesh::surface s(b.triangles, b.nodes);
  std::vector<ph::mesh::proxy> fingers(9, ph::mesh::proxy({.radius = 5e-4}));
  for (auto& f : fingers) REQUIRE(f.touch(s));
  auto nodes = b.nodes;
  const auto run = [&](int ticks, double device) {
    for (int k = 0; k < ticks; ++k) {
      if (k % 33 == 0) {
        for (triple& p : nodes) p.z += 1e-3;
        REQUIRE(s.update(nodes));
      }
      for (std::size_t i = 0; i < fingers.size(); ++i) {
        if (i == 8 && device < 0.1) continue;  // one that no longer ticks holds nobody up
        fingers[i].step({0.005 * double(i) - 0.02, 0.002, device}, T);
      }
    }
  };
  run(10, 0.2);
  run(1000, -0.01);
  for (std::size_t i = 0; i < 8; ++i) CHECK(std::abs(fingers[i].place().z - nodes[0].z) < 2.1e-3);
  CHECK(fingers[8].place().z == 0.2);
  std::vector<ph::mesh::proxy> more(64);
  int seated = 0;
  for (auto& f : more) seated += f.touch(s) ? 1 : 0;
  CHECK(seated == 55);  // of 64 places 9 were taken
  more[0].let_go();
  CHECK(more[60].touch(s));
}

TEST_CASE("news from the past or the future are refused, and the last good ones stay", "[mesh]") {
  const body b = plate();
  ph::mesh::surface s(b.triangles, b.nodes);
  const auto now = ph::mesh::surface::clock::now();
  CHECK(s.update(b.nodes, now));
  CHECK_FALSE(s.update(b.nodes, now - std::chrono::milliseconds(5)));
  CHECK_THAT(s.fault(), Contains("from the past"));
  CHECK_FALSE(s.update(ph::mesh::pose{}, now + std::chrono::hours(1)));
  CHECK_THAT(s.fault(), Contains("from the future"));
  CHECK_FALSE(s.update(b.nodes, ph::mesh::surface::clock::time_point::min()));
  CHECK_THAT(s.fault(),
             Contains("older by 9"));  // 292 years, which no difference of clocks can hold
  CHECK(s.update(b.nodes, now));
}
