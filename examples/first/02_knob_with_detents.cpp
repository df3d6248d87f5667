// SPDX-License-Identifier: BSD-3-Clause
// A knob with a detent every 15 degrees and end stops at ±2 rad: a torque of one's own through a guard.
#include "judge.hpp"

using knob = ph::space<double, 1>;  // rad, N·m

double detents_and_stops(double angle) {
  const double past = std::abs(angle) - 2.0;  // rad
  if (past > 0) return -std::copysign(0.5 * past, angle);
  return -0.004 * std::sin(24.0 * angle);
}

int main() {
  auto guard = ph::make_guard<knob>({.mass = 5e-5,  // kg·m²
                                     .damping = 1e-3,
                                     .force_limit = 0.2,  // N·m
                                     .longest_tick = 1e-3,
                                     .rotary = true},
                                    {.force = 0.15});
  session<knob> finger({.mass = 5e-5, .damping = 2e-3}, 0.05, 0, 1e-6, 0.02);
  const auto tick = [&](const auto& s) {
    return guard.tick(s, detents_and_stops(s.position)).force;
  };
  finger.hold(0.3, 2, tick);  // into the next detent
  std::printf("it rests at %.0f degrees\n", 57.3 * finger.device().position());
  finger.hold(4.0, 2, tick);  // into the stop
  return finger.verdict(guard.explain().force, finger.device().position() - 2.0, 0.5);
}
