// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The wall of thesis section 3.2: a device is dropped from −61 mm onto a stiff spring and left alone.
//
//   S0   ideal device, static wall            S1   the wall gives way: surface = F/K, updates at
//   S2   9 N saturation, 0.2 N dry friction        20-50 Hz, one haptic tick late
//   S5   S1 with a hand that damps, 2 N·s/m
//
// docs/design/mathematics.md § 5 has the definitions: peak to peak after 2 s; settled within 0.5 mm
// of the final mean, the last 2 s calmer than 1 mm; minimum of the TRUE port energy.

#include "quiet.hpp"
#include "report.hpp"
#include "spring_wall.hpp"
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/loop.hpp>
#include <passive_haptics/simulation/schedule.hpp>

#include <algorithm>
#include <array>
#include <numeric>
#include <span>

namespace experiments {

namespace ph = passive_haptics;
namespace sim = passive_haptics::simulation;

using line = ph::space<double, 1>;

struct wall_scene {
  std::string name{};
  double mass = 0.1;       ///< [kg]
  double stiffness = 1e4;  ///< of the wall [N/m]
  bool yields = false;     ///< S1
  bool lags = false;       ///< the environment answers one update late
  double force_limit = sim::device_parameters<line>::infinity;
  double friction = 0.0;      ///< [N]
  double quantum = 0.0;       ///< of the encoders [m]
  double hand_damping = 0.0;  ///< S5: of a hand at rest that holds the device loosely [N·s/m]
};

struct wall_result {
  double peak_to_peak = 0;       ///< after 2 s [m]
  double settle = std::nan("");  ///< [s]; none: never
  double last_swing = 0;         ///< peak to peak of the last 2 s [m]
  double rest = 0;               ///< mean position of the last 2 s [m]
  double port_energy = 0;        ///< least [J]
  double rubbed_energy = 0;      ///< the same with what dry friction has taken [J]
  double ledger = 0;             ///< of the model, at the end [J]
  double force_error = 0;        ///< mean |f − K d| in contact [N]
  double quiet = std::nan("");   ///< from then on (simulation/quiet.hpp) [s]; none: not in time
  sim::quiet_bar missed{};       ///< by the last window that was not
  at_rest still{};               ///< the same in columns, with the stiffness of the last second
};

inline wall_result judge(const std::vector<double>& x, double period) {
  const auto swing = [&x](std::size_t from) {
    const auto [low, high] = std::minmax_element(x.begin() + static_cast<long>(from), x.end());
    return *high - *low;
  };
  const std::size_t two_seconds = static_cast<std::size_t>(2.0 / period + 0.5);
  wall_result result;
  result.peak_to_peak = swing(two_seconds);
  const std::size_t tail = x.size() - two_seconds;
  result.last_swing = swing(tail);
  result.rest = std::accumulate(x.begin() + static_cast<long>(tail), x.end(), 0.0) /
                static_cast<double>(two_seconds);
  if (result.last_swing < 1e-3) {
    std::size_t first = x.size();
    while (first > 0 && std::abs(x[first - 1] - result.rest) < 0.5e-3) --first;
    result.settle = static_cast<double>(first) * period;
  }
  return result;
}

inline sim::device_parameters<line> device_of(const wall_scene& scene) {
  return {.mass = scene.mass,
          .damping = 0.03,
          .friction = scene.friction,
          .force_limit = scene.force_limit,
          .quantum = scene.quantum,
          .lower = -0.061,
          .load = 9.81 * scene.mass,
          .start = -0.061};
}

/// Runs the wall with the device for so many ticks; watch(now, surface) is called in each.
template <class Model, class Device, class Watch>
sim::run_result<line> run_on_wall(Model& model, Device& device, const wall_scene& scene,
                                  std::uint64_t seed, int ticks, Watch watch) {
  const spring_wall springs({2 * scene.stiffness, 2 * scene.stiffness});
  sim::update_schedule schedule(seed);
  sim::one_update_late<double> late(0.0);
  double surface = 0.0;
  const auto answer = [&](const auto& now) {
    if (!schedule.due(now.time) || !(scene.yields || now.tick == 0)) return;
    const double moved = scene.yields ? springs.surface(std::abs(now.sample.held)) : 0.0;
    surface = scene.lags ? late(moved) : moved;
    model.update({surface, -1.0, scene.stiffness});
  };
  return sim::run(device, model, ticks, answer, sim::idle,
                  [&](const auto& now) { watch(now, surface); });
}

/// Lets the device fall onto the wall for 10 s of virtual time.
template <class Device>
wall_result drop(auto model, Device device, const wall_scene& scene, std::uint64_t seed,
                 csv_file* csv) {
  std::vector<double> positions;
  double error = 0.0;
  int in_contact = 0;
  sim::quiet_judge<line> judge_of_quiet(quiet_on(scene.stiffness, scene.quantum, scene.mass));
  constexpr std::array<double, 1> normal{-1.0};
  held_stiffness held;
  const auto note = [&](const auto& now, double surface) {
    const bool touches = now.position > surface;
    if (now.tick >= 9000) held.add(-now.force, now.position - surface);
    judge_of_quiet.add(now.force, device.velocity(), 1e-3,
                       std::span(normal).first(touches ? 1 : 0));
    if (touches) {
      error += std::abs(-now.sample.held - scene.stiffness * (now.position - surface));
      ++in_contact;
    }
    if (csv != nullptr) {
      csv->row(device.time(), now.position, model.local().point, surface, -now.sample.held,
               now.out.energy, device.meter().value());
    }
    positions.push_back(device.position());
  };
  const auto seen = run_on_wall(model, device, scene, seed, 10000, note);
  wall_result result = judge(positions, 1e-3);
  result.port_energy = device.meter().minimum();
  result.rubbed_energy = seen.least_energy;
  result.ledger = model.energy();
  result.quiet = quiet_in_time(judge_of_quiet);
  result.missed = judge_of_quiet.missed();
  result.still.add(judge_of_quiet, {scene.stiffness, held.shown()});
  result.still.on_floor(floor_on(scene.stiffness, scene.quantum, scene.mass));
  result.force_error = in_contact > 0 ? error / in_contact : 0.0;
  return result;
}

template <class Model>
wall_result drop(const Model& model, const wall_scene& scene, std::uint64_t seed,
                 csv_file* csv = nullptr) {
  const auto device = device_of(scene);
  if (!(scene.hand_damping > 0.0)) return drop(model, sim::device<line>(device), scene, seed, csv);
  const sim::impedance_hand<line> hand{.stiffness = 0.0, .damping = scene.hand_damping};
  return drop(model, sim::device<line, sim::impedance_hand<line>>(device, hand), scene, seed, csv);
}

}  // namespace experiments
