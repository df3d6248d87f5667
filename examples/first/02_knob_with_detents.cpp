// SPDX-License-Identifier: BSD-3-Clause
// A knob with a detent every 15 degrees and end stops at ±2 rad. For N and m in the verdict read N·m and rad.
#include "judge.hpp"
#include <passive_haptics/knob/detents.hpp>

using scene = ph::space<double, 1>;  // rad, N·m

int main() {
  auto knob = ph::make_detents<scene>(
      {.mass = 5e-5,  // kg·m²
       .damping = 1e-3,
       .force_limit = 0.2,  // N·m
       .longest_tick = 1e-3,
       .rotary = true},
      {.force = 0.15},
      {.pitch = 0.2618, .stiffness = 0.1, .first = -2, .last = 2, .stop_stiffness = 0.5});
  session<scene> finger({.mass = 5e-5, .damping = 2e-3}, 0.05, 0, 1e-6, 0.02);
  const auto tick = [&](const auto& sample) { return knob.tick(sample).force; };
  finger.hold(0.3, 2, tick);  // into the next detent
  std::printf("it rests at %.0f degrees\n", 57.3 * finger.device().position());
  finger.hold(4.0, 2, tick);  // into the stop
  return finger.verdict(knob.explain());
}
