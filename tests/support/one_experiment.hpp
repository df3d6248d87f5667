// SPDX-License-Identifier: BSD-3-Clause
// Runs one experiment of the identification alone, on a simulated device whose true numbers are known.
#pragma once

#include <passive_haptics/identification/axis_record.hpp>
#include <passive_haptics/identification/motion_regression.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/friction.hpp>

namespace ph = passive_haptics;
namespace sim = ph::simulation;
namespace identification = ph::identification;
using d1 = ph::space<double, 1>;
template <class Friction>
using rubbing = sim::device<d1, sim::no_hand<d1>, Friction>;

inline const sim::device_parameters<d1> grip{
    .mass = 0.1, .damping = 0.3, .quantum = 10e-6, .load = 0.2, .latency = 1};
inline const sim::slider_and_spring rubs{.level = {0.2}, .presliding = {15e-6}};

/// The true numbers of `grip`, as a swing would find them.
inline identification::motion_found motion_of_grip() {
  const auto known = [](double value) { return identification::estimate{value, 0.01 * value}; };
  return {.mass = known(0.1),
          .damping = {known(0.3), known(0.3)},
          .friction = known(0.2),
          .load = known(0.2),
          .latency = 1,
          .explained = 1.0,
          .windows = 1000};
}

/// Ticks the experiment `it` until done() or for `ticks` ticks of 1 ms. Returns the largest force [N].
double run(auto& device, identification::axis_record& seen, auto& it, auto done, int ticks) {
  double force = 0.0, largest = 0.0;
  for (int n = 0; n < ticks && !done(); ++n) {
    const auto sample = device.exchange(force);
    seen.book(sample.position, sample.dt, false);
    force = it.tick(seen);
    seen.commanded(force);
    largest = std::max(largest, std::abs(force));
  }
  return largest;
}
double run(auto& device, identification::axis_record& seen, auto& it, int ticks = 200000) {
  return run(
      device, seen, it, [&] { return it.done(); }, ticks);
}
