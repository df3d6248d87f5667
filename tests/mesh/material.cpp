// SPDX-License-Identifier: BSD-3-Clause
// What triangles are made of: each shows its own stiffness, rubs by its own μ and c, and gives out nothing.
#include "mesh/shapes.hpp"
#include <passive_haptics/mesh.hpp>

#include <random>
#include <string>

using namespace meshes;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// Two squares of 100 mm side by side at z = 0: triangles 0 and 1 at x < 0, 2 and 3 at x > 0.
body floor() {
  return {
      {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}},
      {{-0.1, -0.1, 0}, {0, -0.1, 0}, {0.1, -0.1, 0}, {-0.1, 0.1, 0}, {0, 0.1, 0}, {0.1, 0.1, 0}}};
}
/// A port that shows what the source asks for.
auto bare(const ph::mesh_contact& c) {
  return ph::passive_port{scene{}, c, ph::no_observer{}, ph::no_bound{},
                          ph::loop_limits{.longest_tick = T, .top_speed = 1e4}};
}
auto port_of(double friction, double viscosity, double K, double mass, auto bound) {
  return ph::passive_port{scene{},
                          ph::mesh_contact{.spring = {.mass = mass},
                                           .stiffness = K,
                                           .viscosity = viscosity,
                                           .proxy = {.friction = friction}},
                          ph::reduced_energy{.damping = 0.03}, bound,
                          ph::loop_limits{.longest_tick = T}};
}
constexpr ph::reachable_bound reachable(double mass) {
  return {.mass = mass, .hand_force = 10};
}
/// r is where the floor holds the ball.
constexpr double r = 5e-4;
/// It comes from above, and stays 1 mm deep at (x, 0).
void press(auto& port, double x, int ticks = 400) {
  for (int k = 0; k < ticks; ++k) {
    (void)port.tick(vector(x, 0, r + std::max(-1e-3, 5e-3 - 5e-5 * k)), ph::seconds{T});
  }
}

}  // namespace

TEST_CASE("a stroked mesh rubs by mu, sticks below it, and turns round with the finger", "[mesh]") {
  const body b = floor();
  for (const double mu : {0.2, 0.7}) {
    for (const double angle : {0.0, 0.4, 2.0}) {
      ph::mesh::surface s(b.triangles, b.nodes);
      auto port = bare({.spring = {.mass = 0.1}, .stiffness = 500, .proxy = {.friction = mu}});
      port.source().touch(s);
      press(port, 0.01);
      const vector along(std::cos(angle), std::sin(angle), 0);
      vector x(0.01, 0, r - 1e-3), f = vector::Zero(), last = f;
      double step = 0.0;
      double now = 0.0;
      const auto go = [&](double speed, int ticks) {  // no faster than 1 m/s²
        for (int k = 0; k < ticks; ++k) {
          now = std::clamp(speed, now - 1e-3, now + 1e-3);
          x += along * now * T;
          last = f;
          f = port.tick(x, ph::seconds{T}).force;
          if (last.norm() > 0.0) step = std::max(step, (f - last).norm());
          REQUIRE(f.head<2>().norm() <= mu * f(2) * (1 + 1e-9));
        }
      };
      INFO("mu " << mu << ", towards " << angle);
      go(0.002, 21);  // 41 µm and 1 µm more: it sticks, and pulls back by K times that
      go(0.0, 20);
      CHECK_THAT(f.dot(along), WithinAbs(-500 * 42e-6, 1e-9));
      CHECK_THAT(f(2), WithinRel(0.5, 1e-9));
      go(0.05, 400);
      CHECK_THAT(f.dot(along), WithinRel(-mu * 0.5, 1e-9));
      go(-0.05, 400);
      CHECK_THAT(f.dot(along), WithinRel(mu * 0.5, 1e-9));
      CHECK(step < 0.06);
    }
  }
}

TEST_CASE("each triangle shows its own stiffness, and a border between two is no blow", "[mesh]") {
  const body b = floor();
  ph::mesh::surface s(b.triangles, b.nodes,
                      {.materials = {{.stiffness = 400}, {.stiffness = 1600, .friction = 0.3}},
                       .of = {0, 0, 1, 1}});
  auto port = bare({.spring = {.mass = 0.1}});
  port.source().touch(s);
  press(port, -0.02);
  CHECK_THAT(port.explain().shown, WithinRel(400.0, 1e-9));
  double step = 0.0;
  vector f = port.tick(vector(-0.02, 0, r - 1e-3), ph::seconds{T}).force;
  CHECK_THAT(f(2), WithinRel(0.4, 1e-9));
  int arrived = -1;
  for (int k = 0; k < 400; ++k) {  // 40 mm at 100 mm/s: at the border after 200 ms
    const vector last = f;
    f = port.tick(vector(-0.02 + 1e-4 * k, 0, r - 1e-3), ph::seconds{T}).force;
    step = std::max(step, (f - last).norm());
    if (arrived < 0 && f(2) > 1.599) arrived = k;
  }
  CHECK(step < 0.08);  // 0.05 N of what presses, as much of what rubs, and mu times the first
  CHECK(arrived > 200);
  CHECK(arrived < 240);
  CHECK_THAT(f(2), WithinRel(1.6, 1e-9));
  CHECK_THAT(f(0), WithinRel(-0.48, 1e-9));
  CHECK_THAT(port.explain().asked, WithinRel(1600.0, 1e-9));
}

TEST_CASE("a ball on edges between two materials shows one of them, not both by turns", "[mesh]") {
  // A rough sheet, 250 and 1000 N/m by turns, and balls larger than its triangles, which trembles by 1 um as a hand does.
  std::mt19937 random(5);
  std::uniform_real_distribution<> any(-1e-3, 1e-3);
  body b;
  const int n = 40;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const double x = 0.0025 * (i - n / 2) + 0.3 * any(random);
      const double y = 0.0025 * (j - n / 2) + 0.3 * any(random);
      b.nodes.push_back({x, y, any(random)});
    }
  }
  ph::mesh::made_of stuff{.materials = {{.stiffness = 1000.0}, {.stiffness = 250.0}}, .of = {}};
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      b.triangles.push_back({a, a + 1, a + n + 2});
      b.triangles.push_back({a, a + n + 2, a + n + 1});
      stuff.of.push_back(std::uint8_t((i + j) % 2));
      stuff.of.push_back(std::uint8_t((i + j + 1) % 2));
    }
  }
  for (const double radius : {5e-4, 2e-3, 5e-3, 1e-2}) {
    ph::mesh::surface s(b.triangles, b.nodes, stuff);
    ph::passive_port port{
        scene{}, ph::mesh_contact{.spring = {.mass = 0.1}, .proxy = {.radius = radius}},
        ph::reduced_energy{.damping = 0.1}, ph::no_bound{}, ph::loop_limits{.longest_tick = T}};
    REQUIRE(port.source().touch(s));
    double step = 0.0;
    vector last = vector::Zero();
    for (int k = 0; k < 4000; ++k) {
      const double z = std::max(0.02 - 1e-4 * k, radius - 0.002) + 1e-6 * std::sin(0.06 * k);
      const vector f = port.tick(vector(0.0011, 0.0007, z), ph::seconds{T}).force;
      if (k > 1000) step = std::max(step, (f - last).norm());
      last = f;
    }
    INFO(radius << " m: " << step << " N");
    CHECK(step < 2e-3);
    CHECK(last.norm() > 0.3);
    port.source().let_go();
  }
}

TEST_CASE("a material that changes under the finger is followed by 0.05 N a tick", "[mesh]") {
  using ph::mesh::material;
  const body b = floor();
  const struct {
    material before, after;
    double speed;  ///< of the finger along the mesh [m/s]
    double most;   ///< largest step [N]
  } all[] = {
      {{.stiffness = 400}, {.stiffness = 4000}, 0.0, 0.05},
      {{.stiffness = 4000}, {.stiffness = 400}, 0.05, 0.05},
      {{.stiffness = 2000, .friction = 0.8}, {.stiffness = 2000}, 0.05, 0.05},
      {{.stiffness = 2000}, {.stiffness = 2000, .friction = 0.8}, 0.05, 0.05},
      {{.stiffness = 2000, .friction = 0.8}, {.stiffness = 2000}, 0.0, 0.05},
      {{.viscosity = 25}, {}, 0.05, 0.05},
      {{}, {.viscosity = 25}, 0.05, 0.05},
      // 0.05 N of what presses, as much of what rubs, and μ times the first
      {{.stiffness = 3000, .friction = 0.6}, {.stiffness = 600}, 0.05, 0.11},
  };
  for (const auto& c : all) {
    for (const char* by : {"the mesh", "the port", "a border"}) {
      const bool border = by[0] == 'a';
      const std::vector<std::uint8_t> of(4, 0);
      ph::mesh::surface s(b.triangles, b.nodes,
                          border ? ph::mesh::made_of{{c.before, c.after}, {0, 0, 1, 1}}
                                 : ph::mesh::made_of{{c.before}, of});
      const ph::mesh_contact stated{.spring = {.mass = 0.1}};
      auto port = bare(stated);
      const auto as = [&](const material& m) {
        ph::mesh_contact now = port.source().parameters();
        now.stiffness = m.stiffness;
        now.viscosity = m.viscosity;
        now.proxy.friction = m.friction;
        return now;
      };
      if (by[4] == 'p') {
        CHECK(s.update(ph::mesh::made_of{}));
        CHECK_FALSE(port.set(as(c.before)));
      }
      if (border && c.speed == 0.0) continue;
      port.source().touch(s);
      press(port, -0.01);
      double step = 0.0, x = -0.01;
      vector f = vector::Zero(), first = f;
      const auto stroke = [&](int ticks) {
        for (int k = 0; k < ticks; ++k) {
          const vector last = f;
          f = port.tick(vector(x += c.speed * T, 0, r - 1e-3), ph::seconds{T}).force;
          if (k > 0) step = std::max(step, (f - last).norm());
        }
      };
      for (int k = 0; k < 100; ++k) {  // up to speed, and what is at rest is pulled aside first
        x += T * (c.speed > 0 ? c.speed * k / 100 : k < 50 ? 1e-3 * k / 50 : 1e-3 * (99 - k) / 50);
        f = port.tick(vector(x, 0, r - 1e-3), ph::seconds{T}).force;
      }
      stroke(20);
      INFO(by << ": K " << c.before.stiffness << " to " << c.after.stiffness << " N/m, mu "
              << c.before.friction << " to " << c.after.friction << ", c " << c.before.viscosity
              << " to " << c.after.viscosity << ", " << c.speed << " m/s");
      CHECK(step < 1e-6);
      first = f;
      if (by[4] == 'm') CHECK(s.update(ph::mesh::made_of{{c.after}, of}));
      if (by[4] == 'p') CHECK_FALSE(port.set(as(c.after)));
      stroke(border ? 400 : 120);
      CHECK(step <= c.most * (1 + 1e-6));
      CHECK((f - first).norm() > (c.speed == 0.0 && c.before.friction > 0 ? 0.09 : 1.0));
      CHECK_THAT(f(2), WithinRel(c.after.stiffness * 1e-3, 1e-6));
      CHECK_THAT(port.explain().asked, WithinRel(c.after.stiffness, 1e-9));
    }
  }
}

TEST_CASE("a viscous mesh drags by its speed, no more than a sampled mass takes", "[mesh]") {
  const body b = floor();
  for (const double c : {2.0, 1e6}) {
    ph::mesh::surface s(b.triangles, b.nodes);
    auto port = bare({.spring = {.mass = 0.1}, .viscosity = c});
    port.source().touch(s);
    press(port, 0.0);
    double drag = 0.0;
    for (int k = 0; k < 50; ++k) {
      drag = -port.tick(vector(2e-5 * k, 0, r - 1e-3), ph::seconds{T}).force(0);
    }
    CHECK_THAT(drag, WithinRel(std::min(c, 0.5 * 0.1 / T) * 0.02, 1e-6));
  }
}

TEST_CASE("a rough mesh that moves takes the finger along, a smooth one does not", "[mesh]") {
  const body b = floor();
  for (const double mu : {0.0, 0.5}) {
    ph::mesh::surface s(b.triangles, b.nodes);
    auto port = bare({.spring = {.mass = 0.1}, .stiffness = 500, .proxy = {.friction = mu}});
    port.source().touch(s);
    press(port, 0.01);
    vector f;
    for (int k = 0; k < 500; ++k) {
      if (k % 33 == 0) {
        ph::mesh::pose p;
        p.position = {0.05 * T * k, 0, 0};
        REQUIRE(s.update(p));
      }
      f = port.tick(vector(0.01, 0, r - 1e-3), ph::seconds{T}).force;
    }
    CHECK_THAT(f(0), WithinAbs(mu * 0.5, 1e-6));
  }
}

TEST_CASE("no joule comes out of a rough mesh, however it moves, and what rests is quiet",
          "[mesh][long]") {
  double bare_one = 0.0;
  for (const moving& m : all_worst()) {
    const auto least = [&](auto bound, unsigned seed) {
      ph::mesh::surface s(m.rest.triangles, m.nodes(0.0));
      auto port = port_of(0.2, 0.0, 2000, 0.1, bound);
      port.source().touch(s);
      restless in_hand(seed);
      return sim::run(
                 in_hand.device, port, 3000,
                 [&](auto& now) {
                   if (now.tick % 33 == 0) REQUIRE(s.update(m.nodes(now.time)));
                 },
                 [&](auto& now) { in_hand.move(now); })
          .least_energy;
    };
    INFO(m.name);
    CHECK(least(ph::strict_bound{}, 3) >= -1e-12);
    CHECK(least(reachable(0.1), 4) >= -1e-12);
    for (unsigned seed : {1U, 2U}) bare_one = std::min(bare_one, least(ph::no_bound{}, seed));
  }
  CHECK(bare_one < -1e-3);

  for (const body& b : {floor(), sphere(3, 0.04), star()}) {
    for (const auto& told : {std::pair{500.0, 0.05}, {2000.0, 0.3}, {20000.0, 0.05}}) {
      const double K = told.first, mass = told.second;
      for (const double mu : {0.1, 0.4, 1.5}) {
        ph::mesh::surface s(b.triangles, b.nodes);
        auto port = port_of(mu, 0.0, K, mass, reachable(mass));
        port.source().touch(s);
        sim::impedance_hand<scene> hand;
        hand.stiffness = 200;
        hand.damping = 1;
        hand.limit = 8;
        hand.target = vector(0.012, 0.005, -0.02);
        sim::device<scene, sim::impedance_hand<scene>> dev(
            {.mass = mass, .damping = 0.1, .start = vector(0.003, 0.004, 0.1)}, hand);
        sim::quiet_judge<scene> judge;
        const auto seen = sim::run(dev, port, 5500, sim::idle, sim::idle,
                                   [&](auto& now) { show(judge, port.source().ball(), now); });
        INFO(b.triangles.size() << " triangles, " << K << " N/m, " << mass << " kg, mu " << mu
                                << ": " << judge.figures().force << " N, " << judge.figures().speed
                                << " m/s, " << judge.figures().step << " N");
        CHECK(judge.quiet());
        CHECK(seen.least_energy >= -1e-12);
        CHECK(seen.largest_force > 0.5);
      }
    }
  }
}

TEST_CASE("materials that fit no mesh are refused with a sentence", "[mesh]") {
  const body b = floor();
  const auto said = [&](const ph::mesh::made_of& stuff) -> std::string {
    try {
      ph::mesh::surface s(b.triangles, b.nodes, stuff);
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "";
  };
  CHECK(said({}).empty());
  CHECK(said({.materials = {{}}, .of = {0, 0, 0, 0}}).empty());
  CHECK_THAT(said({.materials = {{}}, .of = {0, 0}}), Contains("2 of 4 triangles"));
  CHECK_THAT(said({.materials = {{}}, .of = {0, 0, 1, 0}}),
             Contains("triangle 2 is of material 1"));
  CHECK_THAT(said({.materials = {}, .of = {0, 0, 0, 0}}), Contains("0 materials"));
  CHECK_THAT(said({.materials = std::vector<ph::mesh::material>(257), .of = {0, 0, 0, 0}}),
             Contains("257 materials"));
  CHECK_THAT(said({.materials = {{.stiffness = 0}}, .of = {0, 0, 0, 0}}),
             Contains("the stiffness is 0"));
  CHECK_THAT(said({.materials = {{.friction = std::nan("")}}, .of = {0, 0, 0, 0}}),
             Contains("of material 0 the friction"));
  ph::mesh::surface s(b.triangles, b.nodes);
  CHECK_FALSE(s.update(ph::mesh::made_of{.materials = {{}}, .of = {0, 0}}));
  CHECK_THAT(s.fault(), Contains("2 of 4 triangles"));
  CHECK(s.update(ph::mesh::made_of{.materials = {{}}, .of = {0, 0, 0, 0}}));
  CHECK(s.fault().empty());
  CHECK(ph::mesh_contact{.spring = {.mass = 0.1}, .viscosity = -1}.check());
  CHECK(ph::mesh_contact{.spring = {.mass = 0.1}, .proxy = {.friction = -1}}.check());
}
