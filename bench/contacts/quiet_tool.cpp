// SPDX-License-Identifier: BSD-3-Clause
// Is a tool in a hand quiet where it rests? A block and a pen in a hole, in a groove, in the corner of a box.
#include "quiet.hpp"
#include <passive_haptics/contact/rigid_tool.hpp>
#include <passive_haptics/device/rigid_damping.hpp>
#include <passive_haptics/force_bound/rigid_reachable_bound.hpp>
#include <passive_haptics/simulation/rigid_device.hpp>

namespace contacts {

namespace {

using body = ph::rigid_body<double>;

enum class place : std::uint8_t { hole, groove, corner };
constexpr std::array<const char*, 3> places{"peg in a hole", "V of 60 deg", "box corner"};
constexpr int slots_of_a_tool = 24;

/// How a hand holds a tool: the spring and damper of a point, and the same about the handle. None is off: what
/// nobody holds tips over, and swings about its points for 20 s. The light one follows and damps.
struct grip {
  still_hand hand;
  double turning_stiffness;  ///< [N·m/rad]
  double turning_damping;    ///< [N·m·s/rad]
};
constexpr std::array<grip, 3> grips{
    {{{"light", 0.0, 1.0}, 0.05, 2e-3}, {still_hands[1], 0.1, 5e-4}, {still_hands[2], 0.5, 3e-3}}};

struct tool_scene {
  place where{};
  bool pen = false;
  double lever = 0.03;  ///< the tool's length below the handle [m]
};

struct drawn_tool {
  sim::rigid_device_parameters device;
  double told = 1.0;  ///< of mass and inertia
  std::array<double, 3> stiffness{};
  vector load, torque;
};
drawn_tool draw(const tool_scene& scene, std::uint64_t seed) {
  draws d(seed);
  drawn_tool t;
  const double scale = d.scale(0.5, 3.0);
  t.device.mass = 0.15 * scale;
  t.device.moments = scene.pen ? std::array{3e-4, 3e-4, 1e-5} : std::array{1e-4, 3e-4, 1.5e-4};
  for (double& moment : t.device.moments) moment *= scale;
  t.device.period = T / 4.0;  // the hand is asked four times a tick
  t.device.substeps = 1;
  t.told = d.told();
  const bool same = d.chance(0.5);
  const double K = d.stiffness();
  for (double& each : t.stiffness) each = same ? K : d.stiffness();
  const double aside = scene.where == place::corner ? -d.between(0.7, 1.3) : d.between(-0.7, 0.7);
  const double ahead = scene.where == place::corner   ? -d.between(0.7, 1.3)
                       : scene.where == place::groove ? 0.0
                                                      : d.between(-0.7, 0.7);
  t.load = {aside, ahead, -d.between(1.0, 3.0)};
  t.torque = {d.between(-0.01, 0.01), d.between(-0.01, 0.01), d.between(-0.005, 0.005)};
  return t;
}

/// The wall of the groove on that side.
vector leaning(double side) {
  return {side * std::cos(30.0 * degree), 0.0, std::sin(30.0 * degree)};
}
/// A tool of four edges, 20 mm wide, with a point at both ends of each.
template <class Port>
int touch(Port& port, const tool_scene& scene, const std::array<double, 3>& K) {
  constexpr double half = 0.01, room = half + 0.25e-3;
  int slot = 0;
  const auto put = [&](const vector& point, const vector& from, const vector& n, std::size_t i) {
    port.source().update(slot++, point, plane{from, n, K[i]});
  };
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      for (const double z : {-scene.lever, 0.0}) {
        const vector point(half * x, half * y, z);
        if (scene.where == place::hole) {
          put(point, {room * x, 0.0, 0.0}, {-x, 0.0, 0.0}, 0);
          put(point, {0.0, room * y, 0.0}, {0.0, -y, 0.0}, 1);
        } else if (scene.where == place::groove) {
          put(point, vector::Zero(), leaning(1.0), 0);
          put(point, vector::Zero(), leaning(-1.0), 1);
        } else {
          put(point, {-0.02, 0.0, 0.0}, {1.0, 0.0, 0.0}, 0);
          put(point, {0.0, -0.02, 0.0}, {0.0, 1.0, 0.0}, 1);
        }
        put(point, vector::Zero(), {0.0, 0.0, 1.0}, 2);  // of both ends: what tips over lies there
      }
    }
  }
  return slot;
}

quiet_run run_of(const tool_scene& scene, const drawn_tool& tool, const grip& held) {
  const auto& I = tool.device.moments;
  const double least = *std::min_element(I.begin(), I.end());
  const double most = *std::max_element(I.begin(), I.end());
  const ph::tool_spring spring{.mass = tool.device.mass * tool.told,
                               .least_inertia = least * tool.told,
                               .lever = scene.lever};
  ph::passive_port port{
      body{}, ph::rigid_tool{spring, ph::pursuit{}, ph::slots<plane, slots_of_a_tool>{}},
      ph::basic_reduced_energy<ph::rigid_damping>{
          .damping = {tool.device.linear_damping[0], tool.device.angular_damping[0]}},
      ph::rigid_reachable_bound{
          .inertia = {.mass = spring.mass, .least = spring.least_inertia, .spread = most - least},
          .hand_force = 20.0,
          .hand_torque = 1.0,
          .linear_damping_most = tool.device.linear_damping[0],
          .angular_damping_most = tool.device.angular_damping[0]},
      ph::loop_limits{.longest_tick = T}};
  const int slots = touch(port, scene, tool.stiffness);
  const double above = scene.where == place::groove ? 0.03 : 0.012;
  const vector goal(0.0, 0.0, scene.lever);
  sim::rigid_device device(tool.device, {vector(0.0, 0.0, scene.lever + above), {}});
  sim::quiet_bars bars;
  bars.lever = scene.lever;
  sim::quiet_judge<body> judge(bars);
  quiet_run run;
  std::vector<body::vector> room;
  body::effort command = body::zero();
  int until = static_cast<int>(watched / T);
  for (int tick = 0; tick < until; ++tick) {
    command = port.tick(device.at(), ph::seconds{T}).force;
    const auto rows = pressing_rows<body>(port.source(), slots, device.at().orientation, room);
    judge.add(command, body::join(device.velocity(), device.rate()), T, rows);
    for (int i = 0; i < 4; ++i) {
      const auto off = body::between({goal, {}}, device.at());
      const auto& hand = held.hand;
      device.push(body::join(
          vector(tool.load - hand.stiffness * body::linear(off) - hand.damping * device.velocity()),
          vector(tool.torque - held.turning_stiffness * body::angular(off) -
                 held.turning_damping * device.rate())));
      static_cast<void>(device.exchange(command));
      run.least_energy = std::min(run.least_energy, device.energy());
    }
    if (!rows.empty()) run.touched = tick * T;
    until = ticks_of(until, tick, judge);
    run.seconds = (tick + 1) * T;
    if (!(vector(device.at().position).norm() < 0.4)) {
      run.gone = true;
      break;
    }
  }
  run.end(judge, device.velocity().norm());
  run.loss_allowed += std::abs(device.residual());
  if (!run.counts() || !judge.quiet()) return run;
  auto at = device.at();
  asked_stiffness asked;
  for (int i = 0; i < slots; ++i) {
    const auto& slot = port.source().slot(i);
    const double can_be = 0.1 * spring.mass / (T * T) * (1.0 - spring.softness);
    asked.add(slot.pressed(), slot.target().stiffness, can_be);
  }
  asked.tell(run);
  run.shown = ex::shown_by(
      [&](const vector& where) -> vector {
        at.position = where;
        return body::linear(port.tick(at, ph::seconds{T}).force);
      },
      vector(at.position));
  return run;
}

}  // namespace

std::vector<std::string> run_quiet_tool(const session& s) {
  s.out.section(
      "Quiet: tools",
      "A block and a pen, 0.075 to 0.45 kg, 20 mm wide and 30, 60 or 100 mm long, with points at "
      "both ends of their four edges, in scenes drawn at random with --seed " +
          std::to_string(s.chosen.seed) +
          ": walls of 0.3 to 80 kN/m, 30 to 100 % of the inertia told, loads off the axis. The "
          "light hand is a load, 1 N·s/m, 0.05 N·m/rad and 2 mN·m·s/rad. The bar "
          "of points; a torque counts as a force at the tool's length.");
  struct job {
    tool_scene scene;
    std::size_t hand, part;
  };
  std::vector<job> jobs;
  for (const place where : {place::hole, place::groove, place::corner}) {
    for (const bool pen : {false, true}) {
      for (const double lever : {0.03, 0.06, 0.1}) {
        for (std::size_t h = 0; h < grips.size(); ++h) {
          jobs.push_back({{where, pen, lever}, h, jobs.size()});
        }
      }
    }
  }
  const int cases = s.chosen.quick ? 1 : 12;
  const auto rows = s.rows("quiet_tool.csv", "quiet_tool", jobs, [&](const job& j) {
    const std::string name = std::string(places[static_cast<std::size_t>(j.scene.where)]) +
                             (j.scene.pen ? ", pen of " : ", block of ") +
                             ex::format("%g mm", j.scene.lever * 1e3);
    const auto seed = (static_cast<std::uint64_t>(s.chosen.seed) << 32U) + (j.part << 20U);
    return judged({.scene = name, .hand = grips[j.hand].hand.name, .cases = cases}, [&](int i) {
      return run_of(j.scene, draw(j.scene, seed + static_cast<std::uint64_t>(i)), grips[j.hand]);
    });
  });
  ex::show_rows(s.out, "quiet_tool", rows);
  std::vector<std::string> found;
  for (const auto& r : rows) expect_quiet(found, r);
  return found;
}

}  // namespace contacts
