// SPDX-License-Identifier: BSD-3-Clause
// A tool that turns and touches meshes at eight points: none goes through, no joule comes out, and what rests is quiet.
#include "mesh/shapes.hpp"
#include <passive_haptics/mesh/mesh_tool.hpp>
#include <passive_haptics/simulation/rigid_device.hpp>

using namespace meshes;

namespace {

using handle = ph::rigid_body<double>;
/// Corners and edges of a box of 30 x 20 x 8 mm.
constexpr std::array<std::array<double, 3>, 8> box{{{-0.015, -0.01, -0.004},
                                                    {0.015, -0.01, -0.004},
                                                    {-0.015, 0.01, -0.004},
                                                    {0.015, 0.01, -0.004},
                                                    {0, 0, -0.004},
                                                    {0, -0.01, 0.004},
                                                    {0.015, 0, -0.004},
                                                    {-0.015, 0, 0.004}}};
constexpr ph::rigid_hand grip{.force = 8, .torque = 0.1};
constexpr ph::rigid_device facts{.inertia = {.mass = 0.15, .least = 1e-4, .spread = 2e-4},
                                 .damping = {0.03, 1e-4},
                                 .damping_most = {0.06, 2e-4},
                                 .force_limit = 9,
                                 .torque_limit = 0.5,
                                 .longest_tick = 1.1e-3};
auto tool_of(double K, const ph::rigid_device& stated = facts) {
  return ph::make_mesh_tool(stated, grip, box, {.stiffness = K});
}

struct outcome {
  double least_energy = 0.0, largest = 0.0, deepest = 0.0;
  double step = 0.0;              ///< of the force, after a second [N]
  int through = 0, pressing = 0;  ///< pressing: the most points at once
  int device_through = 0;         ///< of the handle's points themselves, which nothing holds
  sim::quiet_judge<handle> judge;
};
/// A hand with a spring draws the tool to `to` and holds it upright, 5 N and 0.09 N·m at most.
outcome run(auto port, const moving& m, const vector& start, auto to, int ticks) {
  REQUIRE_FALSE(port.check());
  ph::mesh::surface s(m.rest.triangles, m.nodes(0.0));
  REQUIRE(port.source().touch(s));
  sim::rigid_device dev({}, {start, {}}, vector(0.5, 0.3, 0.2));
  outcome seen;
  vector last = vector::Zero();
  std::array<double, box.size()> round{}, device_round{};
  std::array<witness, box.size()> watch;
  for (int n = 0; n < ticks; ++n) {
    if (n % 33 == 0) REQUIRE(s.update(m.nodes(n * T)));
    const auto x = dev.at();
    const vector target = to(n, x), turn(x.orientation.x, x.orientation.y, x.orientation.z);
    dev.push(handle::join(
        sim::clamp_norm<scene>(400.0 * (target - vector(x.position)) - 8.0 * dev.velocity(), 5.0),
        sim::clamp_norm<scene>((x.orientation.w < 0 ? 0.5 : -0.5) * turn - 0.014 * dev.rate(),
                               0.09)));
    const auto out = port.tick(x, ph::seconds{T});
    std::vector<handle::motion> rows;
    for (int k = 0; k < int(box.size()); ++k) {
      const auto& ball = port.source().ball(k);
      const triple push = ball.push();
      if (length(push) > 0.0) {
        const vector n_k = of(push).normalized();
        rows.push_back(handle::join(
            n_k, scene::cross(vector(port.source().place(x, k) - vector(x.position)), n_k)));
      }
      if (!ball.placed() || (m.closed && n % 10 != 0)) continue;
      const auto i = std::size_t(k);
      if (m.closed) {
        const double now = winding(shown(s, ball), ball.place());
        seen.through += n > 200 && std::abs(now - round[i]) > 0.5;
        round[i] = now;
        const double its = winding(shown(s, ball), of(port.source().place(x, k)));
        seen.device_through += n > 200 && std::abs(its - device_round[i]) > 0.5;
        device_round[i] = its;
      } else {
        seen.through += watch[i].look(shown(s, ball), ball.place());
      }
    }
    seen.judge.add_at(out.force, x, T, std::span<const handle::motion>(rows));
    seen.pressing = std::max(seen.pressing, int(rows.size()));
    seen.largest = std::max(seen.largest, handle::linear(out.force).norm());
    seen.deepest = std::max(seen.deepest, out.depth);
    const vector force = handle::linear(out.force), before = std::exchange(last, force);
    if (n > 1000) seen.step = std::max(seen.step, (force - before).norm());
    (void)dev.exchange(out.force);
    seen.least_energy = std::min(seen.least_energy, dev.energy());
  }
  port.source().let_go();
  return seen;
}

}  // namespace

TEST_CASE("no point of a tool goes through a mesh that moves, and no joule comes out of it",
          "[mesh][long]") {
  double bare = 0.0;
  int device_through = 0;
  for (const moving& m : all_worst()) {
    for (const bool taps : {false, true}) {
      const auto hand = [&, random = std::mt19937(7), to = vector(0, 0, 0),
                         dragged = vector(0, 0, 0)](int n, const handle::pose& x) mutable {
        std::uniform_real_distribution<> any(-0.06, 0.06);
        if (!taps) {
          if (n % 200 == 0) to = vector(any(random), any(random), any(random));
          return to;
        }
        if (n % 40 == 0) to = n % 80 == 0 ? vector(0, 0, 0) : vector(3.0 * vector(x.position));
        return to;
      };
      INFO(m.name << (taps ? ", tapped" : ", stroked"));
      const auto seen = run(tool_of(2000), m, vector(0.13, 0, 0), hand, 1200);
      CHECK(seen.through == 0);
      device_through += seen.device_through;
      CHECK(seen.least_energy >= -1e-12);
      CHECK(seen.largest <= 9.0 * (1 + 1e-12));
      const auto source = tool_of(2000).source().parameters();
      const ph::passive_port unbound{handle{}, source, ph::no_observer{}, ph::no_bound{},
                                     ph::loop_limits{.longest_tick = 1.1e-3}};
      bare = std::min(bare, run(unbound, m, vector(0.13, 0, 0), hand, 600).least_energy);
    }
  }
  CHECK(bare < -1e-3);  // without a bound they give out energy
  CHECK(device_through > 100);
}

TEST_CASE("a tool that is in a mesh when the forces are on again is met from no force on",
          "[mesh]") {
  const body b = plate();
  ph::mesh::surface s(b.triangles, b.nodes);
  auto port = tool_of(2000);
  REQUIRE(port.source().touch(s));
  double pressed = 0.0;
  for (int n = 0; n < 440; ++n) {
    if (n == 400) port.enable_forces(false);
    if (n == 420) port.enable_forces(true);
    const double z = n < 200 ? 0.008 - 3e-5 * n : n < 400 ? 0.002 : 0.002 - 1e-4 * (n - 400);
    const handle::pose x{{0.0, 0.0, z}, {}};
    const double force = handle::linear(port.tick(x, ph::seconds{T}).force).norm();
    if (n < 400) pressed = std::max(pressed, force);
    if (n == 420) CHECK(force < 8 * 0.06);  // 50 N/s at each point
  }
  CHECK(pressed > 1.0);
  port.source().let_go();
}

TEST_CASE("the points of a tool share what the ledger pays for when a mesh heaves", "[mesh]") {
  for (const double K : {600.0, 1500.0}) {
    const moving heaves{"plate that heaves", plate(), shaken({0, 0, 0.002}, 2.5)};
    const auto seen = run(
        tool_of(K), heaves, vector(0.002, 0.001, 0.02),
        [](int n, const auto& /*x*/) {
          return vector(0.002, 0.001, 0.02 - 0.027 * std::min(n / 600.0, 1.0));
        },
        4000);
    INFO(K << " N/m: steps " << seen.step << " N, least " << seen.least_energy << " J");
    CHECK(seen.pressing > 3);
    CHECK(seen.step < 0.4);  // 0.56 and 0.68 N where each spends all of it
    CHECK(seen.least_energy >= -1e-12);
  }
}

TEST_CASE("a tool that rests on a mesh by many points is quiet, if its inertia is what is stated",
          "[mesh][long]") {
  const body groove{{{0, 1, 3}, {0, 3, 2}, {2, 3, 5}, {2, 5, 4}},
                    {{-0.1, -0.1, 0.03},
                     {0.1, -0.1, 0.03},
                     {-0.1, 0, 0},
                     {0.1, 0, 0},
                     {-0.1, 0.1, 0.03},
                     {0.1, 0.1, 0.03}}};
  int rings = 0;
  for (const moving& m :
       {moving{"plate", plate(), still}, moving{"groove", groove, still, false},
        moving{"sphere", sphere(3, 0.05), still}, moving{"star", star(), still}}) {
    for (const double side : {1.0, -1.0}) {
      const double from = side * (m.rest.nodes.size() < 10 ? 0.04 : 0.13);
      const vector to(0.003, 0.002, m.rest.nodes.size() < 10 ? -0.03 * side : 0.0);
      const auto press = [&](const auto& port) {
        return run(
            port, m, vector(0.003, 0.002, from),
            [&](int n, const auto&) {
              return n < 300
                         ? vector(vector(0.003, 0.002, from) * (1 - n / 300.0) + to * (n / 300.0))
                         : to;
            },
            3200);
      };
      for (const double K : {500.0, 10000.0}) {
        INFO(m.name << " from " << side << ", " << K << " N/m");
        const auto seen = press(tool_of(K));
        CHECK(seen.judge.quiet());
        CHECK(seen.judge.since() <= 2.0);
        CHECK(seen.through == 0);
        CHECK(seen.least_energy >= -1e-12);
        CHECK(seen.largest > 3.0);
        CHECK(seen.pressing >= 2);
      }
      if (side < 0.0) continue;
      ph::rigid_device heavy = facts;  // the control: as if each point had the whole of the handle
      heavy.inertia.mass *= 20;
      heavy.inertia.least *= 20;
      heavy.inertia.spread *= 20;
      rings += !press(tool_of(1e5, heavy)).judge.quiet();
    }
  }
  CHECK(rings >= 3);
}

TEST_CASE(
    "a mesh tool states and refuses its parameters, and touches with all of its points or none",
    "[mesh]") {
  auto port = tool_of(1500);
  REQUIRE_FALSE(port.check());
  CHECK(port.source().settles());
  auto p = port.source().parameters();
  CHECK(p.shape.stiffness == 1500.0);
  CHECK(p.contact(4).spring.mass == Approx(1.0 / (8 * (1 / 0.15 + 0.004 * 0.004 / 1e-4))));
  p.points[3][1] = std::nan("");
  CHECK(std::string(p.check().parameter) == "points");
  p = port.source().parameters();
  p.least_inertia = 0.0;
  CHECK(std::string(p.check().parameter) == "least_inertia");
  p = port.source().parameters();
  for (const int none : {0, -1, 9}) {
    p.used = none;
    CHECK(std::string(p.check().parameter) == "used");
  }
  p.used = 3;
  CHECK_FALSE(port.set(p));
  CHECK(port.source().parameters().used == 8);  // as it was made
  p.shape.proxy.radius = -1.0;
  CHECK(std::string(p.check().parameter) == "radius");
  p.shape.proxy.radius = 1e-3;
  CHECK_FALSE(port.set(p));
  CHECK(port.source().ball(7).parameters().radius == 1e-3);

  const body b = plate();
  ph::mesh::surface s(b.triangles, b.nodes);
  handle::pose x{vector(0, 0, 0.01), {}};
  CHECK(port.tick(x, ph::seconds{T}).what == ph::event::no_target);
  CHECK(port.source().touch(s));
  CHECK_FALSE(port.source().touch(s));  // once is enough
  std::array<ph::mesh::proxy, 53> others;
  for (auto& one : others) REQUIRE(one.touch(s));
  auto second = tool_of(1500);
  CHECK_FALSE(second.source().touch(s));  // three places are left
  CHECK_FALSE(second.source().ball(0).touching());
  auto third = ph::make_mesh_tool(facts, grip, box, {}, 3);
  CHECK(third.source().touch(s));  // by three of the eight
  CHECK((third.source().ball(2).touching() && !third.source().ball(3).touching()));
  third.source().let_go();
  others[0].let_go();
  double force = 0.0;
  for (int n = 0; n < 100; ++n) {
    x.position = vector(0, 0, 0.01 - 1e-4 * n);
    force = port.tick(x, ph::seconds{T}).force(2);
  }
  CHECK(force > 5.0);
  CHECK(port.explain().depth > 3e-3);
  port.source().let_go(s);
  CHECK(port.tick(x, ph::seconds{T}).force == handle::effort(handle::zero()));
  for (auto& one : others) one.let_go();
}
