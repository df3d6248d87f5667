// SPDX-License-Identifier: BSD-3-Clause
// A mesh as the source of a port: thin plates hold 1 m/s and 10 N, no joule comes out, and what rests is quiet.
#include "mesh/shapes.hpp"
#include <passive_haptics/environment/contact_surface.hpp>
#include <passive_haptics/environment/surface_search.hpp>
#include <passive_haptics/mesh.hpp>

using namespace meshes;
namespace env = ph::environment;

namespace {

auto port_of(double K, double mass, auto bound, double radius = 5e-4) {
  return ph::passive_port{
      scene{},
      ph::mesh_contact{.spring = {.mass = mass}, .stiffness = K, .proxy = {.radius = radius}},
      ph::reduced_energy{.damping = 0.03}, bound, ph::loop_limits{.longest_tick = T}};
}
auto reachable(double mass) {
  return ph::reachable_bound{.mass = mass, .hand_force = 10};
}

using hand = sim::impedance_hand<scene>;
using device = sim::device<scene, hand>;
/// Drawn to a place by that many newtons at most, per metre and per metre a second.
hand drawn(const vector& to, double newtons, double per_metre = 400, double per_speed = 2) {
  hand h;
  h.stiffness = per_metre;
  h.damping = per_speed;
  h.limit = newtons;
  h.target = to;
  return h;
}

/// What make_mesh_touch makes of a device of 0.1 kg, K in N/m.
auto at_the_door(double K) {
  return ph::make_mesh_touch<scene>(
      {.mass = 0.1, .damping = 0.1, .force_limit = 9, .longest_tick = T}, {.force = 5},
      {.stiffness = K});
}

}  // namespace

TEST_CASE("a plate of 2 mm holds 1 m/s and 10 N from both sides, at news of 30 Hz", "[mesh]") {
  for (const auto& told : {std::pair{1000.0, 0.3}, {2000.0, 0.05}, {10000.0, 0.1}}) {
    const double K = told.first, mass = told.second;
    for (const double side : {1.0, -1.0}) {
      for (const double speed : {0.1, 1.0}) {
        for (const bool heaves : {false, true}) {
          const moving m{"", plate(), shaken({0, 0, heaves ? 0.005 : 0.0}, 1.5)};
          ph::mesh::surface s(m.rest.triangles, m.rest.nodes);
          auto port = port_of(K, mass, reachable(mass));
          port.source().touch(s);
          device dev({.mass = mass,
                      .start = vector(0.003, 0.002, 0.03 * side),
                      .start_velocity = vector(0, 0, -speed * side)},
                     drawn(vector(0.003, 0.002, -0.2 * side), 10, 1000));
          double other = 1.0;
          const auto seen = sim::run(dev, port, 3000, [&](auto& now) {
            if (now.tick % 33 == 0) REQUIRE(s.update(m.nodes(now.time)));
            if (!port.source().ball().placed()) return;
            const double middle = port.source().ball().triangle(0)[0].z - 0.001;
            other = std::min(other, side * (port.source().ball().place().z - middle));
          });
          INFO(K << " N/m, " << mass << " kg, " << side << ", " << speed << " m/s");
          CHECK(other > 0.001);
          CHECK(seen.least_energy >= -1e-12);
          CHECK(seen.largest_force > 9.0);
        }
      }
    }
  }
}

TEST_CASE("the planes and quadrics that are told at 30 Hz lose the same plate", "[mesh]") {
  // What a slow thread finds by the closest point, with a side of its own for each triangle: in the same run, a
  // device pressed by 10 N ends on the far side. The mesh that remembers holds it.
  const body b = plate();
  std::vector<Eigen::Vector3d> nodes;
  for (const triple& p : b.nodes) nodes.push_back(of(p));
  std::vector<env::surface_triangle> triangles;
  for (const triangle& t : b.triangles) triangles.push_back({t});
  const env::surface_search search(triangles, nodes);
  const auto through = [&](auto port, auto tell) {
    device dev(
        {.mass = 0.1, .start = vector(0.003, 0.002, 0.02), .start_velocity = vector(0, 0, -1)},
        drawn(vector(0.003, 0.002, -0.2), 10, 1000));
    sim::run(dev, port, 2000, [&](auto& now) { tell(port, now); });
    return dev.position()(2) < -0.05;
  };
  const auto local = [](auto surface) {
    using kind = decltype(surface);
    return ph::passive_port{
        scene{},
        ph::contact_set{ph::proxy_spring{.mass = 0.1}, ph::pursuit{}, ph::slots<kind, 1>{}},
        ph::reduced_energy{.damping = 0.03}, reachable(0.1), ph::loop_limits{.longest_tick = T}};
  };
  const auto closest = [&](const auto& now) {
    return *search.closest_point(nodes, vector(now.sample.position));
  };
  CHECK(through(local(ph::half_space<scene>{}), [&](auto& port, auto& now) {
    if (now.tick % 33 != 0) return;
    const auto on = closest(now);
    port.source().update(
        0, ph::half_space<scene>{.point = on.point, .normal = on.normal, .stiffness = 1000.0});
  }));
  CHECK(through(local(ph::quadric<scene>{}), [&](auto& port, auto& now) {
    if (now.tick % 33 != 0) return;
    port.source().update(
        0, env::quadric_at(search, nodes, closest(now), 1000.0, {.thickness = 0.002}));
  }));
  ph::mesh::surface s(b.triangles, b.nodes);
  auto remembers = port_of(1000, 0.1, reachable(0.1));
  remembers.source().touch(s);
  CHECK_FALSE(through(remembers, [](auto&, auto&) {}));
}

TEST_CASE("no joule comes out of a mesh, however it moves, behind a strict and a reachable bound",
          "[mesh][long]") {
  double largest = 0.0, bare = 0.0;
  for (const moving& m : all_worst()) {
    const auto least = [&](auto bound, unsigned seed) {
      ph::mesh::surface s(m.rest.triangles, m.nodes(0.0));
      auto port = port_of(2000, 0.1, bound);
      port.source().touch(s);
      restless in_hand(seed);
      const auto seen = sim::run(
          in_hand.device, port, 3000,
          [&](auto& now) {
            if (now.tick % 33 == 0) REQUIRE(s.update(m.nodes(now.time)));
          },
          [&](auto& now) { in_hand.move(now); });
      largest = std::max(largest, seen.largest_force);
      return seen.least_energy;
    };
    for (const unsigned seed : {1U, 2U}) {
      INFO(m.name << ", seed " << seed);
      CHECK(least(ph::strict_bound{}, seed) >= -1e-12);
      CHECK(least(reachable(0.1), seed) >= -1e-12);
      bare = std::min(bare, least(ph::no_bound{}, seed));
    }
  }
  CHECK(largest > 5.0);
  CHECK(bare < -1e-3);  // without a bound they give out energy
}

TEST_CASE("what rests on a facet, in a groove, in a pit, on an edge or at a tip is quiet in 5 s",
          "[mesh]") {
  body groove{{}, {}};  // a wavy sheet: grooves and ridges along y, every 20 mm
  for (int j = 0; j < 2; ++j) {
    for (int i = -4; i <= 4; ++i) {
      groove.nodes.push_back({0.01 * i, j == 0 ? -0.05 : 0.05, i % 2 == 0 ? -0.005 : 0.005});
    }
  }
  for (int i = 0; i < 8; ++i) {
    groove.triangles.push_back({i, i + 1, i + 10});
    groove.triangles.push_back({i, i + 10, i + 9});
  }
  body pit;  // three facets that meet below
  pit.nodes = {{0, 0, -0.02}, {0.05, 0, 0}, {-0.025, 0.0433, 0}, {-0.025, -0.0433, 0}};
  pit.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}};
  struct scene_of {
    const char* name;
    body mesh;
    vector start, to;
  };
  const scene_of scenes[] = {
      {"facet", plate(), {0.01, 0.004, 0.01}, {0.011, 0.005, -0.05}},
      {"groove", groove, {0.003, 0.004, 0.01}, {0.001, 0.002, -0.05}},
      {"ridge", groove, {0.009, 0.004, 0.02}, {0.0095, 0.002, -0.03}},
      {"pit", pit, {0.003, 0.004, 0.01}, {0.001, 0.001, -0.06}},
      {"sphere", sphere(3, 0.04), {0.003, 0.004, 0.06}, {0.002, 0.001, 0.0}},
      {"sphere of 20480", sphere(5, 0.04), {0.003, 0.004, 0.06}, {0.002, 0.001, 0.0}},
      {"star", star(), {0.01, 0.004, 0.09}, {0.002, 0.001, 0.0}},
      {"noise",
       {sphere(2, 0.04).triangles, all_worst()[12].nodes(0.1)},
       {0.003, 0.004, 0.06},
       {0, 0, 0.01}},
  };
  for (const scene_of& here : scenes) {
    for (const auto& told : {std::pair{500.0, 0.05}, {2000.0, 0.3}, {20000.0, 0.05}}) {
      const double K = told.first, mass = told.second;
      const bool stiff = mass > 0.1;
      ph::mesh::surface s(here.mesh.triangles, here.mesh.nodes);
      auto port = port_of(K, mass, reachable(mass));
      port.source().touch(s);
      device dev({.mass = mass, .damping = 0.1, .start = here.start},
                 drawn(here.to, 8, stiff ? 400 : 100, stiff ? 6 : 1));
      sim::quiet_judge<scene> judge;
      const auto seen = sim::run(dev, port, 5500, sim::idle, sim::idle,
                                 [&](auto& now) { show(judge, port.source().ball(), now); });
      INFO(here.name << ", " << K << " N/m, " << mass << " kg, stiff hand: " << stiff << ", "
                     << judge.figures().force << " N, " << judge.figures().speed << " m/s, "
                     << judge.figures().step << " N");
      CHECK(judge.quiet());
      CHECK(judge.since() <= 5.0);
      CHECK(seen.least_energy >= -1e-12);
      CHECK(seen.largest_force > 0.5);
    }
  }
}

TEST_CASE(
    "a stroke over nodes and edges of a smooth sphere is not braked by facets that do not press",
    "[mesh]") {
  // 60 mm/s along a great circle of a sphere of 40 mm, 2.5 mm deep, and 3 mm/s in and out.
  const body b = sphere(3, 0.0395);
  const auto off = [&](std::optional<ph::mesh::smooth> rounded, double& step) {
    ph::mesh::surface s(b.triangles, b.nodes, {}, rounded);
    auto port = port_of(1000.0, 0.1, reachable(0.1));
    port.source().touch(s);
    double sum = 0.0;
    vector last = vector::Zero();
    for (int n = 0; n < 4000; ++n) {
      const double angle = 0.35 * std::sin(4e-3 * n);
      const double r = 0.0375 + std::max(0.006 - 1e-5 * n, 0.0) - 5e-4 * std::sin(6e-3 * n);
      const vector up(std::sin(angle), 0.0, std::cos(angle));
      const vector f = port.tick(vector(r * up), ph::seconds{T}).force;
      if (n > 1000) {
        sum += (f - 1000.0 * (0.04 - r) * up).squaredNorm() / 2999;
        step = std::max(step, (f - last).norm());
      }
      last = f;
    }
    port.source().let_go();
    return std::sqrt(sum);
  };
  double step = 0.0, facets = 0.0;
  CHECK(off(ph::mesh::smooth{}, step) < 0.01);
  CHECK(step < 0.015);
  CHECK(off(std::nullopt, facets) > 0.1);
  CHECK(facets > 0.2);
}

TEST_CASE("a mesh that pushes a hand stops before the ledger is used up", "[mesh]") {
  // A hand of 100 or 400 N/m rests on a plate that then heaves by 5 or 9 mm, 30 times a second. The control is the
  // spring of the same ball behind the same bound.
  const body b = plate();
  double least = 0.0;
  const auto largest_step = [&](bool bare, bool by_pose, double K, double k, double way) {
    ph::mesh::surface s(b.triangles, b.nodes);
    auto port = port_of(K, 1.0, reachable(1.0));
    ph::passive_port given{scene{}, ph::given_force{}, ph::reduced_energy{.damping = 0.03},
                           reachable(1.0), ph::loop_limits{.longest_tick = T}};
    ph::mesh::proxy ball;
    REQUIRE((bare ? ball.touch(s) : port.source().touch(s)));
    device dev({.mass = 1.0, .damping = 0.05, .start = vector(0.003, 0.002, 0.004)},
               drawn(vector(0.003, 0.002, -1.0 / k), 9, k, 10));
    double step = 0.0;
    vector force = vector::Zero();
    auto sample = dev.exchange(force);
    for (int n = 1; n < 4500; ++n) {
      const double up = n < 1500 ? 0.0 : way * std::sin(6.9e-3 * (n - 1500));
      auto nodes = b.nodes;
      for (triple& p : nodes) p.z += up;
      if (n % 33 == 0) {
        REQUIRE((by_pose ? s.update(ph::mesh::pose{.position = {0, 0, up}}) : s.update(nodes)));
      }
      const vector last = force;
      if (bare) {
        ball.step(of(sample.position), T);
        force = given.tick(sample, vector(K * of(ball.push()))).force;
      } else {
        force = port.tick(sample).force;
      }
      if (n > 1500) step = std::max(step, (force - last).norm());
      sample = dev.exchange(force);
    }
    least = std::min(least, dev.meter().minimum());
    ball.let_go();
    port.source().let_go();
    return step;
  };
  double eased = 0.0, plain = 0.0;
  for (const double K : {700.0, 3000.0}) {
    for (const double k : {100.0, 400.0}) {
      for (const double way : {0.005, 0.009}) {
        for (const bool by_pose : {false, true}) {
          eased += largest_step(false, by_pose, K, k, way) / 16;
          plain += largest_step(true, by_pose, K, k, way) / 16;
        }
      }
    }
  }
  CAPTURE(eased, plain);
  CHECK(eased < 0.8 * plain);
  CHECK(least >= -1e-12);
}

TEST_CASE("a mesh that jumps onto a hand is felt there at a limited rate", "[mesh]") {
  const body b = plate();
  for (const bool by_pose : {false, true}) {
    for (const double way : {0.05, 0.3, 3.0}) {
      ph::mesh::surface s(b.triangles, b.nodes);
      auto port = port_of(1000, 0.1, reachable(0.1));
      REQUIRE(port.source().touch(s));
      device dev({.mass = 0.1, .damping = 0.2, .start = vector(0.003, 0.002, 0.004)},
                 drawn(vector(0.003, 0.002, -0.01), 9, 200, 2));
      vector force = vector::Zero();
      auto sample = dev.exchange(force);
      double step = 0.0, most = 0.0;
      int followed = 0;
      for (int n = 1; n < 5000; ++n) {
        auto nodes = b.nodes;
        const double up = n < 2000 ? 0.0 : way;
        for (triple& p : nodes) p.z += up;
        if (n % 33 == 0 && n < 2500) {
          REQUIRE((by_pose ? s.update(ph::mesh::pose{.position = {0, 0, up}}) : s.update(nodes)));
        }
        const vector last = force;
        force = port.tick(sample).force;
        if (n > 1900) step = std::max(step, (force - last).norm());
        most = std::max(most, force.norm());
        sample = dev.exchange(force);
        const auto said = port.explain();
        followed += said.now == ph::softened_by::news ? 1 : 0;
        if (n < 4500) continue;
        REQUIRE(said.force < 0.5 * said.shown * said.depth);  // it has stopped far below
        REQUIRE(said.now == ph::softened_by::ledger);
      }
      CHECK(followed > 0);
      INFO(by_pose << ", by " << way << " m: " << step << " N");
      CHECK(step < 0.7);
      CHECK(most > 3.0);
      CHECK(dev.meter().minimum() >= -1e-12);
      port.source().let_go();
    }
  }
}

TEST_CASE("a mesh that jumps onto a hand does not let go of it where motors are weak", "[mesh]") {
  // The motors' limit is a force, so the way that is not yet felt does not count against it. A finger that is held
  // still shows the step, and a hand that gives way the energy.
  const body b = plate();
  for (const bool by_pose : {false, true}) {
    for (const double way : {0.05, 0.5, 10.0, -0.05}) {
      for (const bool held : {true, false}) {
        ph::mesh::surface s(b.triangles, b.nodes);
        auto port = at_the_door(1000);
        REQUIRE(port.source().touch(s));
        device dev({.mass = 0.1, .damping = 0.1, .start = vector(0.003, 0.002, 0.006)},
                   drawn(vector(0.003, 0.002, -0.006), 5, 1000, 10));
        double step = 0.0, most = 0.0;
        vector force = vector::Zero();
        auto sample = dev.exchange(force);
        for (int n = 0; n < 2000; ++n) {
          auto nodes = b.nodes;
          for (triple& p : nodes) p.z += way;
          const ph::mesh::pose there{.position = {0, 0, way}};
          if (n >= 1000 && n % 33 == 0) REQUIRE((by_pose ? s.update(there) : s.update(nodes)));
          const vector last = force, x(0.003, 0.002, 0.006 - std::min(0.0095, 2e-5 * n));
          force = held ? port.tick(x, ph::seconds{T}).force : port.tick(sample).force;
          if (!held) sample = dev.exchange(force);
          if (n > 600) step = std::max(step, (force - last).norm());
          most = std::max(most, force.norm());
        }
        INFO(by_pose << ", by " << way << " m, held " << held << ": " << step << " N");
        CHECK(most > 3.9);
        if (held && way > 0.0) CHECK(step < 0.3);
        CHECK((force.norm() > 0.0) == (way > 0.0));  // a mesh that has left holds nothing
        CHECK(dev.meter().minimum() >= -1e-12);
        port.source().let_go();
      }
    }
  }
}

TEST_CASE("a mesh that the device is in when the forces are on again is met from no force on",
          "[mesh]") {
  const body b = plate();
  for (const double k : {100.0, 400.0, 2000.0}) {
    INFO(k << " N/m");
    ph::mesh::surface s(b.triangles, b.nodes);
    auto port = at_the_door(2000);
    REQUIRE(port.source().touch(s));
    device dev({.mass = 0.1, .damping = 0.1, .start = vector(0.003, 0.002, 0.004)},
               drawn(vector(0.003, 0.002, -3.0 / k), 5, k, k / 100 + 1));
    vector force = vector::Zero();
    auto sample = dev.exchange(force);
    for (int n = 1; n < 4000; ++n) {
      if (n == 2000) port.enable_forces(false);
      if (n == 2020) port.enable_forces(true);
      force = port.tick(sample).force;
      if (n == 2019) REQUIRE(force.norm() == 0.0);
      if (n == 2020) CHECK(force.norm() < 0.06);  // 50 N/s
      sample = dev.exchange(force);
    }
    CHECK(force.norm() > 0.5);
    CHECK(dev.meter().minimum() >= -1e-12);
    port.source().let_go();
  }
}

TEST_CASE("a ball of another radius and a mesh of another stiffness are felt at a limited rate",
          "[mesh]") {
  const body b = plate();
  const auto largest_step = [&](double k, bool larger, double stiffer, bool by_mesh) {
    ph::mesh::surface s(b.triangles, b.nodes);
    auto port = at_the_door(500);
    REQUIRE(port.source().touch(s));
    device dev({.mass = 0.1, .damping = 0.1, .start = vector(0.003, 0.002, 0.006)},
               drawn(vector(0.003, 0.002, 0.006), 5, k, k / 100 + 1));
    vector force = vector::Zero();
    auto sample = dev.exchange(force);
    double step = 0.0;
    for (int n = 1; n < 8000; ++n) {
      // A hand that comes slowly pays in little.
      dev.hand().target =
          vector(0.003, 0.002, 0.006 - (0.006 + 2.0 / k) * std::min(1.0, n / 700.0));
      if (n == 3000) {
        auto other = port.source().parameters();
        if (larger) other.proxy.radius *= 4.0;
        other.stiffness *= by_mesh ? 1.0 : stiffer;
        REQUIRE_FALSE(port.set(other));
        const std::vector<std::uint8_t> of(b.triangles.size(), 0);
        if (by_mesh) REQUIRE(s.update(ph::mesh::made_of{{{500 * stiffer, 0.0, 0.0}}, of}));
      }
      const vector last = force;
      force = port.tick(sample).force;
      if (n >= 3000) step = std::max(step, (force - last).norm());
      sample = dev.exchange(force);
    }
    CHECK(dev.meter().minimum() >= -1e-12);
    port.source().let_go();
    return step;
  };
  for (const double k : {100.0, 400.0, 2000.0}) {
    INFO(k << " N/m");
    CHECK(largest_step(k, true, 1.0, false) < 0.06);
    CHECK(largest_step(k, false, 3.0, false) < 0.2);
    CHECK(largest_step(k, false, 3.0, true) < 0.2);
  }
}

TEST_CASE("a mesh that takes the place of the one that is pressed is felt on", "[mesh]") {
  // A sphere of another topology every 40 ms, its facets up to 0.4 mm apart from those before; and one touched again.
  for (const bool again : {false, true}) {
    for (const double K : {1000.0, 4000.0}) {
      std::vector<std::unique_ptr<ph::mesh::surface>> levels;
      for (const int level : {3, 4}) {
        const body b = sphere(level, 0.05);
        levels.push_back(std::make_unique<ph::mesh::surface>(b.triangles, b.nodes));
      }
      auto port = port_of(K, 0.1, reachable(0.1));
      REQUIRE(port.source().touch(*levels[0]));
      device dev({.mass = 0.1, .start = vector(0.01, 0.02, 0.06)},
                 drawn(vector(0.01, 0.02, 0.03), 5));
      double step = 0.0, least = 1e9, last = 0.0;
      const auto seen = sim::run(
          dev, port, 3000,
          [&](auto& now) {
            if (now.tick % 40 == 0) {
              REQUIRE(port.source().touch(
                  *levels[again ? 0U : static_cast<std::size_t>(now.tick / 40) % levels.size()]));
            }
          },
          sim::idle,
          [&](auto& now) {
            const double force = now.force.norm(), before = std::exchange(last, force);
            if (now.tick < 1000) return;
            step = std::max(step, std::abs(force - before));
            least = std::min(least, force);
          });
      INFO(again << ", " << K << " N/m: steps " << step << " N, least " << least << " N");
      CHECK(step < (again ? 1e-5 : 0.06));  // 50 N/s
      CHECK(least > 3.0);
      CHECK(seen.least_energy >= -1e-12);
      CHECK(port.source().ball().meshes() == 1);
      port.source().let_go();
    }
  }
}

TEST_CASE("a mesh that takes the place of one that leans otherwise turns the force without a step",
          "[mesh]") {
  for (const double lean : {0.02, 0.1}) {
    const body flat = plate();
    body leans = flat;
    for (triple& p : leans.nodes) p = turned(p, lean);
    const ph::mesh::surface one(flat.triangles, flat.nodes), other(leans.triangles, leans.nodes);
    auto port = port_of(2000, 0.1, reachable(0.1));
    REQUIRE(port.source().touch(one));
    device dev({.mass = 0.1, .damping = 0.1, .start = vector(0, 0.001, 0.01)},
               drawn(vector(0, 0.001, -0.004), 9, 3000, 30));
    double step = 0.0, beside = 0.0;
    vector last = vector::Zero();
    const auto seen = sim::run(
        dev, port, 3000,
        [&](auto& now) {
          if (now.tick >= 1000 && now.tick % 100 == 0) {
            REQUIRE(port.source().touch(now.tick % 200 == 0 ? other : one));
          }
        },
        sim::idle,
        [&](auto& now) {
          const vector force = now.force, before = std::exchange(last, force);
          if (now.tick < 1000) return;
          step = std::max(step, (force - before).norm());
          beside = std::max(beside, std::abs(force.y() / force.z()));
        });
    INFO(lean << ": steps " << step << " N, " << beside << " beside");
    CHECK(step < 0.12);                                     // 0.49 N where it turned at once
    CHECK(beside == Approx(std::tan(lean)).epsilon(0.02));  // it arrives
    CHECK(seen.least_energy >= -1e-12);
    port.source().let_go();
  }
}

TEST_CASE("a device that begins at a mesh is told why it feels nothing, until it is clear",
          "[mesh]") {
  const body b = plate();
  ph::mesh::surface s(b.triangles, b.nodes);
  auto port = port_of(1000, 0.1, reachable(0.1));
  CHECK(std::string(port.explain().because()).find("source().touch()") != std::string::npos);
  REQUIRE(port.source().touch(s));
  CHECK(port.explain().now == ph::softened_by::nothing);
  for (int n = 0; n < 5; ++n) {
    CHECK(port.tick(vector(0, 0, 2e-4), ph::seconds{T}).what == ph::event::started_inside);
    CHECK(port.explain().now == ph::softened_by::started_inside);
  }
  CHECK(port.tick(vector(0, 0, 0.002), ph::seconds{T}).what == ph::event::nominal);
  CHECK(port.tick(vector(0, 0, 2e-4), ph::seconds{T}).what == ph::event::nominal);
  CHECK(port.explain().now != ph::softened_by::started_inside);
}

TEST_CASE("a mesh contact states and refuses its parameters, and lives without a mesh", "[mesh]") {
  CHECK(std::string(ph::mesh_contact{}.check().parameter) == "mass");
  CHECK(
      std::string(ph::mesh_contact{.spring = {.mass = 0.1}, .stiffness = 0.0}.check().parameter) ==
      "stiffness");
  CHECK(
      std::string(
          ph::mesh_contact{.spring = {.mass = 0.1}, .proxy = {.radius = 0.0}}.check().parameter) ==
      "radius");
  auto port = port_of(1000, 0.1, reachable(0.1));
  const auto out = port.tick(vector::Zero(), ph::seconds{T});
  CHECK(out.what == ph::event::no_target);
  CHECK(out.force == vector::Zero());
  const body b = plate();
  ph::mesh::surface s(b.triangles, b.nodes);
  port.source().touch(s);
  for (int k = 0; k < 10; ++k) (void)port.tick(vector(0, 0, 0.004 - 0.001 * k), ph::seconds{T});
  CHECK(port.source().ball().pressed().count == 1);
  CHECK(port.source().settles());
  CHECK(port.source().parameters().stiffness == 1000.0);
  port.source().let_go();
  CHECK(port.tick(vector(0, 0, -0.005), ph::seconds{T}).force == vector::Zero());
}

TEST_CASE("the door for a mesh takes a device's facts, and friction pays for what encoders show",
          "[mesh]") {
  const ph::exact_device exact{.mass = 0.1, .damping = 0.1, .force_limit = 9.0};
  const ph::encoder_device stepped{.mass = 0.1,
                                   .damping = 0.1,
                                   .friction = 0.1,
                                   .presliding = 1e-5,
                                   .quantum = 6e-5,
                                   .force_limit = 9.0};
  const body b = plate();
  const auto pressed = [&](auto port, double depth) {
    CHECK(!port.check());
    ph::mesh::surface s(b.triangles, b.nodes);
    port.source().touch(s);
    double force = 0.0, x = 0.002;
    for (; x > -depth; x -= 1e-5) force = port.tick(vector(0, 0, x), ph::seconds{T}).force(2);
    CHECK(port.source().settles());
    return force;
  };
  const ph::known_hand hand{.force = 10.0};
  const double stiff = pressed(ph::make_mesh_touch<scene>(exact, hand, {.stiffness = 2000}), 3e-3);
  const double soft = pressed(ph::make_mesh_touch<scene>(stepped, hand, {.stiffness = 2000}), 3e-3);
  const double paid_for = ph::detail::budget_of(stepped, hand, 0);
  CHECK(stiff > 4.0);
  CHECK(paid_for < 1900.0);
  CHECK(soft > 0.5);
  CHECK(soft <= 1.05 * paid_for * 3.5e-3);  // of the ball, whose radius is 0.5 mm
  CHECK(soft < 0.9 * stiff);
  const auto without = ph::make_mesh_touch<scene>(ph::exact_device{}, hand);
  CHECK(without.check());
}
