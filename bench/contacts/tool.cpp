// SPDX-License-Identifier: BSD-3-Clause
// Does a box that is dropped come to rest on its eight points, on a floor and in the corner of a room? 0.06 to
// 0.56 kg, 3e2 to 1e9 N/m, three attitudes, smooth and rough, drawn about these by the seed.
#include "quiet.hpp"
#include <passive_haptics/contact/rigid_tool.hpp>
#include <passive_haptics/device/rigid_damping.hpp>
#include <passive_haptics/force_bound/rigid_reachable_bound.hpp>
#include <passive_haptics/simulation/rigid_device.hpp>

namespace contacts {

namespace {

using body = ph::rigid_body<double>;

struct tool_row {
  bool corner = false, rough = false;
  int cases = 0, unsettled = 0;
  int late = 0;               ///< drops that still moved by 0.5 mm in a second after 8 s
  double slowest = 0.0;       ///< of those that settle [s]
  double swing = 0.0;         ///< of the handle in the last second, twice the farthest [m]
  double turning = 0.0;       ///< the fastest at the end [rad/s]
  double least_energy = 0.0;  ///< [J]
  double residual = 0.0;      ///< of the integration [J]
  int seed = 1;
  ex::at_rest still{};
};
ex::record record_of(const tool_row& r) {
  return ex::with({{"scene", r.corner ? "box corner" : "floor"},
                   {"rough", r.rough},
                   {"cases", r.cases},
                   {"unsettled", r.unsettled},
                   {"after_8_s", r.late},
                   {"slowest_s", r.slowest, "%.2f"},
                   {"widest_swing_mm", r.swing * 1e3, "%.4f"},
                   {"turns_rad_per_s", r.turning, "%.4f"},
                   {"least_energy_J", r.least_energy},
                   {"residual_J", r.residual}},
                  r.still);
}

constexpr int longest = 30;  // of a drop that still moves after the usual time [s]

/// One drop; K of every surface [N/m], `scale` of mass and inertia, turned by that [rad].
template <class Friction>
void drop(tool_row& row, double scale, double K, const vector& turned, int seconds) {
  sim::rigid_device_parameters d;
  d.mass *= scale;
  for (double& moment : d.moments) moment *= scale;
  d.substeps = 2;
  const double least = *std::min_element(d.moments.begin(), d.moments.end());
  const double most = *std::max_element(d.moments.begin(), d.moments.end());
  const double weight = gravity * d.mass;
  ph::passive_port port{
      body{},
      ph::rigid_tool{ph::tool_spring{.mass = d.mass, .least_inertia = least}, ph::pursuit{},
                     Friction{}, ph::slots<plane, 24>{}},
      ph::basic_reduced_energy<ph::rigid_damping>{
          .damping = {d.linear_damping[0], d.angular_damping[0]}},
      ph::rigid_reachable_bound{.inertia = {.mass = d.mass, .least = least, .spread = most - least},
                                .hand_force = weight,
                                .hand_torque = 0.0,
                                .linear_damping_most = d.linear_damping[0],
                                .angular_damping_most = d.angular_damping[0]},
      ph::loop_limits{.longest_tick = T}};
  int slot = 0;
  for (int i = 0; i < 8; ++i) {
    const vector point((i & 1) != 0 ? 0.03 : -0.03, (i & 2) != 0 ? 0.02 : -0.02,
                       (i & 4) != 0 ? 0.01 : -0.01);
    for (int j = 0; j < (row.corner ? 3 : 1); ++j) {
      const vector n = row.corner ? vector(vector::Unit(j)) : vector(0.0, 0.0, 1.0);
      port.source().update(slot++, point, plane{vector(0.0, 0.0, 0.0), n, K});
    }
  }
  const vector start = row.corner ? vector(0.06, 0.06, 0.09) : vector(0.0, 0.0, 0.09);
  const vector down =
      row.corner ? vector(vector(-1.0, -0.8, -1.5).normalized()) : vector(0.0, 0.0, -1.0);
  sim::rigid_device device(d, {start, ph::rotation::exp<double>(turned)});
  device.push(body::join(vector(down * weight), vector(0.0, 0.0, 0.0)));
  std::vector<vector> track;
  body::effort command = body::zero();
  sim::quiet_judge<body> judge;  // a lever of 30 mm, half the box
  std::vector<body::vector> room;
  int until = seconds * 1000;
  for (int n = 0; n < until; ++n) {
    command = port.tick(device.exchange(command)).force;
    judge.add(command, body::join(device.velocity(), device.rate()), T,
              pressing_rows<body>(port.source(), slot, device.at().orientation, room));
    track.push_back(device.at().position);
    row.least_energy = std::min(row.least_energy, device.energy());
    if (n + 1 == seconds * 1000) {
      const auto moved = [&](const vector& x) { return (x - track.back()).norm() > 0.5e-3; };
      if (std::any_of(track.end() - 1000, track.end(), moved)) until = longest * 1000;
    }
  }
  row.late += until > seconds * 1000 ? 1 : 0;
  row.residual = std::max(row.residual, std::abs(device.residual()));
  auto at = device.at();
  const auto force = [&, pressed = port](const vector& where) mutable -> vector {
    at.position = where;
    return body::linear(pressed.tick(at, ph::seconds{T}).force);
  };
  row.still.add(judge, {K, ex::shown_by(force, vector(at.position))});
  vector end = vector::Zero();
  for (std::size_t i = track.size() - 1000; i < track.size(); ++i) end += track[i] / 1000.0;
  double settling = 0.0, swing = 0.0;
  for (std::size_t i = 0; i < track.size(); ++i) {
    const double away = (track[i] - end).norm();
    if (away > 0.5e-3) settling = static_cast<double>(i + 1) * T;
    if (i + 1000 >= track.size()) swing = std::max(swing, 2.0 * away);
  }
  ++row.cases;
  if (swing < 1e-3) {
    row.slowest = std::max(row.slowest, settling);
  } else {
    ++row.unsettled;
  }
  row.swing = std::max(row.swing, swing);
  row.turning = std::max(row.turning, device.rate().norm());
}

tool_row judge(tool_row row) {
  constexpr int seconds = 8;
  const vector turns[] = {{0.0, 0.0, 0.0}, {0.4, 0.3, 0.0}, {0.9, -0.6, 0.5}};
  draws d(static_cast<std::uint64_t>(row.seed));
  for (const double scale : {0.5, 1.0, 3.0}) {
    for (const double K : {1e3, 1e4, 1e6, 1e9}) {
      for (const vector& turn : turns) {
        const bool flat = turn.norm() == 0.0;  // that attitude is one of the three as it is
        const double mass = scale * d.scale(0.8, 1.25), stiffness = K / d.scale(1.0, 3.0);
        const vector turned = flat ? turn : vector(turn + 0.2 * d.direction());
        if (row.rough) {
          drop<ph::stick_slip>(row, mass, stiffness, turned, seconds);
        } else {
          drop<ph::frictionless>(row, mass, stiffness, turned, seconds);
        }
      }
    }
  }
  return row;
}

}  // namespace

std::vector<std::string> run_tool(const session& s) {
  s.out.section(
      "Settling of a tool",
      "A box with eight points, dropped from 9 cm on a floor and into the corner of a room, "
      "under rigid_reachable_bound. Without friction what turns about the normal of the floor "
      "goes on turning until the handle's own damper has stopped it. Masses, stiffnesses and "
      "attitudes are drawn about their decades with --seed " +
          std::to_string(s.chosen.seed) +
          ", and what still moves by 0.5 mm in a second after 8 s is watched for 30; there is no "
          "hand, the drop is the last news, and a torque counts as a force at 30 "
          "mm." +
          ex::quiet_columns);
  std::vector<tool_row> jobs;
  for (const bool corner : {false, true}) {
    for (const bool rough : {false, true}) {
      jobs.push_back({.corner = corner, .rough = rough, .seed = s.chosen.seed});
    }
  }
  const auto rows = s.rows("tool.csv", "tool", jobs, [](const tool_row& r) { return judge(r); });
  ex::show_rows(s.out, "tool", rows);
  std::vector<std::string> found;
  for (const auto& r : rows) {
    const std::string name = std::string(r.corner ? "box corner" : "floor") +
                             (r.rough ? ", rough" : "") + ", eight points";
    expect(found, r.unsettled == 0, name + ": " + std::to_string(r.unsettled) + " do not settle");
    expect(found, r.least_energy >= -1e-12 - r.residual, name + ": loses energy");
  }
  return found;
}

}  // namespace contacts
