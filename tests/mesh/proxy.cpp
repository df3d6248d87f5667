// SPDX-License-Identifier: BSD-3-Clause
// The ball lets no triangle through, whatever the mesh does; what has no memory does.
#include "mesh/shapes.hpp"

using namespace meshes;

namespace {

/// A device that is drawn to and fro across a mesh, by 1 m/s.
class wanderer {
 public:
  explicit wanderer(unsigned seed) : random_(seed) {}
  triple next(double dt) {
    if (!(left_ > 0.0)) {
      goal_ = {any(), any(), any()};
      if (std::exchange(near_, !near_)) goal_ = triple{0, 0, 0.02} + goal_ * 0.1;
      left_ = 0.25;
    }
    left_ -= dt;
    const triple way = goal_ - at_;
    const double far = length(way);
    at_ = far > dt ? at_ + way * (dt / far) : goal_;
    return at_;
  }

 private:
  double any() { return std::uniform_real_distribution<>(-0.06, 0.06)(random_); }
  std::mt19937 random_;
  bool near_ = false;
  double left_ = 0.0;
  triple at_{0.12, 0.0, 0.0}, goal_;
};

struct seen {
  int through = 0, felt = 0;
  double clearance = 1.0;
};
/// An open mesh is looked at in ticks so short that the ball's way round a rim is straight enough for a witness.
seen wandered(const moving& m, unsigned seed, int every, double radius, double friction) {
  const double dt = m.closed ? T : T / 10;
  ph::mesh::surface s(m.rest.triangles, m.nodes(0.0));
  ph::mesh::proxy ball({.radius = radius, .friction = friction});
  ball.touch(s);
  wanderer device(seed);
  witness looks;
  seen all;
  double round = -1e9;
  const int ticks = int(3.0 / dt), news = int(every * T / dt);
  for (int k = 0; k < ticks; ++k) {
    if (k % news == 0) REQUIRE(s.update(m.nodes(k * dt)));
    ball.step(device.next(dt), dt);
    if (!ball.placed()) continue;
    all.felt += ball.pressed().count > 0 ? 1 : 0;
    if (!m.closed) {
      all.through += looks.look(shown(s, ball), ball.place());
    } else if (k % 4 == 0) {
      const double now = winding(shown(s, ball), ball.place());
      all.through += round > -1e8 && std::abs(now - round) > 0.5 ? 1 : 0;
      round = now;
    }
    if (k % 4 == 0) all.clearance = std::min(all.clearance, ball.clearance());
  }
  return all;
}

}  // namespace

TEST_CASE("no mesh lets the ball through, at rest, moved, deformed, by news of 30 Hz to 1 kHz",
          "[mesh][long]") {
  for (const moving& m : all_worst()) {
    for (const int every : {33, 7, 1}) {
      for (const unsigned seed : {1U, 2U}) {
        const double radius = seed == 1 ? 5e-4 : 1e-4;
        const double friction = seed == 1 ? 0.0 : 0.7;
        const seen all = wandered(m, seed, every, radius, friction);
        INFO(m.name << ", news every " << every << " ticks, radius " << radius << ", mu "
                    << friction);
        CHECK(all.through == 0);
        CHECK(all.felt > 0);
        CHECK(all.clearance >= 0.25 * radius);
      }
    }
  }
}

TEST_CASE("what has no memory goes through the same meshes", "[mesh]") {
  // The closest triangle of each tick, pushed out of by the side that it faces: deeper than half a plate that is
  // the other face.
  const body b = plate();
  std::vector<corners> all;
  for (const auto& [i, j, k] : b.triangles) {
    all.push_back({b.nodes[std::size_t(i)], b.nodes[std::size_t(j)], b.nodes[std::size_t(k)]});
  }
  const auto pushed_out = [&](const triple& x) {
    triple best;
    double least = 1.0;
    for (const corners& c : all) {
      const triple across = cross(c[1] - c[0], c[2] - c[0]), n = across * (1.0 / length(across));
      const triple p = point_at(c, closest_weights(c, x));
      if (length(p - x) >= least) continue;
      least = length(p - x);
      best = dot(x - p, n) > 0.0 ? x : p + n * 5e-4;
    }
    return best;
  };
  witness looks;
  int through = 0;
  for (int k = 0; k < 100; ++k)
    through += looks.look(all, pushed_out({0.003, 0.001, 0.01 - 2e-4 * k}));
  CHECK(through > 0);
}

TEST_CASE("a ball on a plate stays over the device and slides off at the rim", "[mesh]") {
  const body b = plate();
  ph::mesh::surface s(b.triangles, b.nodes);
  ph::mesh::proxy ball({.radius = 5e-4});
  ball.touch(s);
  ball.step({0.01, 0.0, 0.01}, T);
  REQUIRE(ball.placed());
  CHECK(ball.place() == triple{0.01, 0.0, 0.01});
  for (int k = 0; k < 40; ++k) ball.step({0.01 + 1e-3 * k, 0.002, -0.01}, T);
  CHECK(length(ball.place() - triple{0.049, 0.002, 5e-4}) < 1e-9);  // over it, in the tick
  for (int k = 0; k < 100; ++k) ball.step({0.06, 0.002, -0.01}, T);
  CHECK(length(ball.place() - triple{0.06, 0.002, -0.01}) < 1e-9);
}

TEST_CASE("motion over fine facets is not held back: a ball keeps up at 1 m/s", "[mesh]") {
  const body b = sphere(5, 0.05);  // 20480 facets of 2 mm
  ph::mesh::surface s(b.triangles, b.nodes);
  ph::mesh::proxy ball({.radius = 5e-4});
  ball.touch(s);
  double behind = 0.0;
  for (int k = 0; k < 500; ++k) {
    const double angle = k < 100 ? 0.0 : 0.02 * (k - 100);
    const double depth = k < 100 ? 0.055 - 7e-5 * k : 0.048;
    const triple x{depth * std::cos(angle), depth * std::sin(angle), 0.0};
    ball.step(x, T);
    const triple p = ball.place();
    if (k > 100) behind = std::max(behind, length(cross(p, x)) / length(x));
  }
  CHECK(behind < 2e-4);  // a facet turns by 0.04, and 2.5 mm of depth make 0.1 mm of it
}

TEST_CASE("a device that begins inside, or too near, is held by nothing until it is clear",
          "[mesh]") {
  const body b = sphere(2, 0.04);
  ph::mesh::surface s(b.triangles, b.nodes);
  ph::mesh::proxy ball({.radius = 5e-4});
  ball.step({0, 0, 0}, T);  // no surface yet
  CHECK_FALSE(ball.placed());
  ball.touch(s);
  ball.step(b.nodes[0], T);
  CHECK_FALSE(ball.placed());
  ball.step({0, 0, 0}, T);  // inside is as good a side as any
  REQUIRE(ball.placed());
  for (int k = 0; k < 100; ++k) ball.step({0, 0, 0.001 * k}, T);
  CHECK(length(ball.place()) < 0.04);
  CHECK(ball.pressed().count > 0);
  const double before = ball.place().z;
  ball.step({std::nan(""), 0, 0}, T);
  ball.step({0, 0, 0.1}, 0.0);
  CHECK(ball.place().z == before);
  ball.reset();
  CHECK_FALSE(ball.placed());
  ball.let_go();
  CHECK_FALSE(ball.touching());
  ball.touch(s);
  ball.step({0, 0, 0.1}, T);
  CHECK(ball.placed());
}

TEST_CASE("a mesh that would crush the ball waits, and goes on when there is room", "[mesh]") {
  // Two plates, one from above and one from below, meet where the ball is.
  const body both = together(plate(), plate(), {0, 0, 0.03});
  const auto at = [&](double lower) {
    auto nodes = both.nodes;
    for (std::size_t i = 8; i < nodes.size(); ++i) nodes[i].z -= lower;
    return nodes;
  };
  ph::mesh::surface s(both.triangles, both.nodes);
  ph::mesh::proxy ball({.radius = 5e-4});
  ball.touch(s);
  const triple x{0.0, 0.0, 0.01};
  double most = 0.0;
  const auto run = [&](int ticks, double lower) {
    for (int k = 0; k < ticks; ++k) {
      if (k % 33 == 0) REQUIRE(s.update(at(lower)));
      ball.step(x, T);
      most = std::max(most, std::abs(winding(shown(s, ball), ball.place())));
    }
  };
  run(100, 0.0);
  run(300, 0.031);  // through each other
  CHECK(ball.shown() < 0.99);
  CHECK(ball.clearance() >= 1.25e-4);
  run(300, 0.0);
  CHECK(most < 0.5);
  CHECK(length(ball.place() - x) < 1e-12);
  CHECK(ball.clearance() > 0.009);
}

TEST_CASE("a pose moves a mesh of any size at once, and carries the ball", "[mesh]") {
  const body b = plate();
  ph::mesh::surface s(b.triangles, b.nodes);
  ph::mesh::proxy ball({.radius = 5e-4});
  ball.touch(s);
  ball.step({0.01, 0.0, 0.01}, T);
  for (int k = 0; k < 10; ++k) ball.step({0.01, 0.0, -0.005}, T);
  ph::mesh::pose up;
  up.position = {0.0, 0.0, 0.04};
  REQUIRE(s.update(up));
  double last = ball.place().z, fastest = 0.0;
  for (int k = 0; k < 100; ++k) {
    ball.step({0.01, 0.0, -0.005}, T);
    fastest = std::max(fastest, ball.place().z - last);
    last = ball.place().z;
  }
  CHECK(std::abs(last - 0.0405) < 1e-9);
  CHECK(fastest < 1e-3);  // 40 mm within 50 ms, and no faster
  ph::mesh::pose turn;    // upside down, in steps
  for (int k = 1; k <= 2000; ++k) {
    if (k % 33 == 0) {
      const double half = 0.5 * pi * k / 1980.0;
      turn.w = std::cos(half);
      turn.axis = {std::sin(half), 0.0, 0.0};
      REQUIRE(s.update(turn));
    }
    ball.step({0.01, 0.0, -0.005}, T);
    CHECK(ball.clearance() >= 1.25e-4);
  }
}

TEST_CASE("a proxy's parameters are refused by name", "[mesh]") {
  CHECK_FALSE(ph::mesh::proxy_parameters{}.check());
  CHECK(std::string(ph::mesh::proxy_parameters{.radius = 0.0}.check().parameter) == "radius");
  CHECK(std::string(ph::mesh::proxy_parameters{.news_speed = -1.0}.check().parameter) ==
        "news_speed");
  CHECK(std::string(ph::mesh::proxy_parameters{.longest_way = 2.0}.check().parameter) ==
        "longest_way");
  // By itself, without a port that asks check(): it touches nothing, and keeps the last good ones.
  const body b = plate();
  const ph::mesh::surface s(b.triangles, b.nodes);
  ph::mesh::proxy ball({.radius = std::nan("")});
  CHECK_FALSE(ball.touch(s));
  ball.set({.radius = 5e-4});
  REQUIRE(ball.touch(s));
  ball.step({0, 0, 0.01}, T);
  ball.set({.radius = -1.0});
  for (int k = 0; k < 50; ++k) ball.step({0, 0, -0.01}, T);
  CHECK(length(ball.place() - triple{0, 0, 5e-4}) < 1e-9);
}
