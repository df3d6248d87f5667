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
  const int ticks = int(2.0 / dt), news = int(every * T / dt);
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
    for (const int every : {33, 1}) {
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

namespace {

/// A ball pressed into a plate that is told, in ticks that are due, where told(tick) [m] has it, for 4 s and then no more.
struct followed_plate {
  double off = 0.0;                ///< mean square of where it is felt less where it is [m²]
  double bare = 0.0;               ///< the same of where it was told [m²]
  double highest = -1.0;           ///< where it is felt at the most, after 1 s [m]
  double step = 0.0;               ///< the largest way of it in a tick [m]
  double at_last = 0.0, last = 0;  ///< where it is felt, and told, 0.4 s after the last news [m]
};
followed_plate follow_plate_when(bool by_pose, auto due, auto told) {
  const body b = plate();
  ph::mesh::surface s(b.triangles, b.nodes);
  ph::mesh::proxy ball({.radius = 5e-4});
  REQUIRE(ball.touch(s));
  followed_plate seen;
  double before = 0.0;
  for (int k = 0; k < 4400; ++k) {
    if (due(k) && k < 4000) {
      seen.last = told(k);
      auto nodes = b.nodes;
      for (triple& p : nodes) p.z += seen.last;
      REQUIRE((by_pose ? s.update(ph::mesh::pose{.position = {0.0, 0.0, seen.last}})
                       : s.update(nodes)));
    }
    ball.step({0.003, 0.002, std::max(0.02 - 1e-4 * k, -0.02)}, T);
    const double felt = ball.place().z - 5e-4;
    if (k >= 1000 && k < 4000) {
      seen.off += (felt - told(k)) * (felt - told(k)) / 3000;
      seen.bare += (seen.last - told(k)) * (seen.last - told(k)) / 3000;
      seen.highest = std::max(seen.highest, felt);
      seen.step = std::max(seen.step, std::abs(felt - before));
    }
    before = felt;
  }
  seen.at_last = before;
  ball.let_go();
  return seen;
}
/// The same, told every `period` ticks.
followed_plate follow_plate(bool by_pose, int period, auto told) {
  return follow_plate_when(
      by_pose, [=](int k) { return k % period == 0; }, told);
}

}  // namespace

TEST_CASE(
    "a mesh that moves steadily is felt where it is by now, and where it was told when it stops",
    "[mesh]") {
  const auto heaved = [](int k) { return 0.002 * std::sin(6.9e-3 * k); };
  for (const bool by_pose : {false, true}) {
    for (const int period : {33, 17, 10}) {
      const auto seen = follow_plate(by_pose, period, heaved);
      INFO(by_pose << ", every " << period << " ms");
      CHECK(std::sqrt(seen.off) < 0.4 * std::sqrt(seen.bare));
      CHECK(seen.step < 2e-5);  // [m]; it moves by 1.4e-5 itself
      CHECK(std::abs(seen.at_last - seen.last) < 1e-9);
    }
    CHECK(std::sqrt(follow_plate(by_pose, 1, heaved).off) < 1e-6);
  }
}

TEST_CASE("a mesh whose news come unevenly goes on steadily, and poses by the time between them",
          "[mesh]") {
  for (const auto& heave : {std::pair{0.002, 6.9e-3}, {0.005, 1.9e-3}}) {
    const auto heaved = [&](int k) { return heave.first * std::sin(heave.second * k); };
    for (const bool by_pose : {false, true}) {
      for (const double uneven : {0.15, 0.3, 0.6}) {
        std::mt19937 random(3);
        std::uniform_real_distribution<> any(1.0 - uneven, 1.0 + uneven);
        int next = 0;
        const auto due = [&](int k) {
          if (k < next) return false;
          next = k + int(33.0 * any(random));
          return true;
        };
        const auto seen = follow_plate_when(by_pose, due, heaved);
        INFO(by_pose << ", uneven by " << uneven << ": off by " << std::sqrt(seen.off) << " of "
                     << std::sqrt(seen.bare) << " m, step " << seen.step << " m");
        const double share = std::sqrt(seen.off / seen.bare);
        CHECK(share < (by_pose ? 0.2 + 0.4 * uneven : 0.8));
        // A step is what it moves by itself [m], and a half of that is made up for.
        CHECK(seen.step < 3.5 * heave.first * heave.second);
        CHECK(std::abs(seen.at_last - seen.last) < 1e-9);
      }
    }
  }
}

TEST_CASE("news that come at once because those before were late are no faster motion", "[mesh]") {
  // Every other shape of a plate that heaves by 1 mm comes 1 ms before the next one, or all of them 35 to 65 ms late.
  const auto heaved = [](int k) { return 0.001 * std::sin(6.9e-3 * k); };
  for (const bool by_pose : {false, true}) {
    for (const int period : {33, 17, 10}) {
      for (const bool at_random : {false, true}) {
        std::mt19937 random(5);
        std::uniform_int_distribution<> any(35, 65);
        std::vector<int> told(4400, -1);  // the newest news in each tick, and when they were true
        for (int k = 0, last = 0; k < 4400; k += period) {
          const int late = at_random ? any(random) : (k / period) % 2 == 0 ? period - 1 : 0;
          last = std::max(last, k + late);
          if (last < 4400) told[std::size_t(last)] = k;
        }
        const auto when = [&](int k) { return told[std::size_t(k)]; };
        const body b = plate();
        ph::mesh::surface s(b.triangles, b.nodes);
        ph::mesh::proxy ball({.radius = 5e-4});
        REQUIRE(ball.touch(s));
        double before = 0.0, step = 0.0;
        for (int k = 0; k < 4400; ++k) {
          if (when(k) >= 0) {
            const double z = heaved(when(k));
            auto nodes = b.nodes;
            for (triple& p : nodes) p.z += z;
            REQUIRE(
                (by_pose ? s.update(ph::mesh::pose{.position = {0.0, 0.0, z}}) : s.update(nodes)));
          }
          ball.step({0.003, 0.002, std::max(0.02 - 1e-4 * k, -0.02)}, T);
          const double felt = ball.place().z;
          if (k >= 1000) step = std::max(step, std::abs(felt - before));
          before = felt;
        }
        ball.let_go();
        INFO(by_pose << ", every " << period << " ms, at random " << at_random);
        CHECK(step < 6e-5);  // [m]; up to 4.4e-4 where the time since the last ones alone counts
      }
    }
  }
}

TEST_CASE("news that jump, tremble or come seldom are not felt beyond where they were told",
          "[mesh]") {
  for (const bool by_pose : {false, true}) {
    const auto jumped = follow_plate(by_pose, 33, [](int k) { return k < 2000 ? 0.0 : 0.002; });
    CHECK(jumped.highest < 0.002 + 1e-9);
    const auto climbed = follow_plate(by_pose, 300, [](int k) { return 0.001 * (k / 300); });
    CHECK(climbed.highest < 0.013 + 1e-9);
    CHECK(std::abs(climbed.at_last - climbed.last) < 1e-9);
    std::mt19937 random(3);
    std::vector<double> noise(4400);
    for (double& z : noise) z = 1e-3 * std::uniform_real_distribution<>(-1.0, 1.0)(random);
    const auto trembled = follow_plate(by_pose, 33, [&](int k) { return noise[std::size_t(k)]; });
    CHECK(trembled.highest < 1.3e-3);
  }
}

TEST_CASE("a mesh of which the news say how old they are is felt where it is by now", "[mesh]") {
  // Each is told an age that is twice the time since the one before, or more.
  using clock = ph::mesh::surface::clock;
  const auto ahead = [](bool with_time) {
    const body b = plate();
    ph::mesh::surface s(b.triangles, b.nodes);
    ph::mesh::proxy ball({.radius = 5e-4});
    REQUIRE(ball.touch(s));
    const auto first = clock::now() - std::chrono::hours(1);
    double most = 0.0;
    for (int k = 0; k < 2000; ++k) {
      const double there = 5e-5 * (k / 20);
      const ph::mesh::pose where{.position = {0.0, 0.0, there}};
      if (k % 20 == 0) {
        REQUIRE(
            (with_time ? s.update(where, first + std::chrono::milliseconds(k)) : s.update(where)));
      }
      ball.step({0.003, 0.002, std::max(0.02 - 1e-4 * k, -0.02)}, T);
      if (k % 20 == 19) most = ball.where().position.z - there;
    }
    ball.let_go();
    return most;
  };
  CHECK(std::abs(ahead(false) - 5e-5) < 1e-9);
  CHECK(std::abs(ahead(true) - 15e-5) < 1e-9);
}

TEST_CASE("a mesh that goes back and forth is followed by all of longest_way", "[mesh]") {
  const auto share_of_a_tick = [](double phase) {  // of the way between two news, which take 20 ms
    const body b = plate();
    ph::mesh::surface s(b.triangles, b.nodes);
    ph::mesh::proxy ball({.radius = 5e-4});
    REQUIRE(ball.touch(s));
    double before = 0.0, share = 1.0;
    for (int k = 0; k < 800; ++k) {
      if (k % 20 == 0) {
        auto nodes = b.nodes;
        for (auto& p : nodes) p.z += 1e-4 * std::sin(phase * (k / 20));
        REQUIRE(s.update(nodes));
      }
      ball.step({0.003, 0.002, std::max(0.02 - 1e-4 * k, -0.002)}, T);
      if (k > 600 && ball.shown() > before) share = std::min(share, ball.shown() - before);
      before = ball.shown();
    }
    ball.let_go();
    return share;
  };
  CHECK(std::abs(share_of_a_tick(1.8) - 1.0 / 50.0) < 1e-9);  // it could be foreseen as well
  CHECK(share_of_a_tick(0.3) > 1.0 / 25.0);
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
