// SPDX-License-Identifier: BSD-3-Clause
// The tutorial's first step: a wall, a simulated device, and a hand that presses it in.

#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/simulation/device.hpp>

#include <cstdio>

namespace ph = passive_haptics;
namespace sim = ph::simulation;
using scene = ph::space<double, 1>;

int main() {
  auto touch = ph::make_touch<scene>({.mass = 0.1,       // kg, of the device
                                      .damping = 0.1,    // N·s/m, of the device: less than it has
                                      .force_limit = 9,  // N, the most that the motors hold
                                      .longest_tick = 1e-3},  // s, of the loop
                                     {.force = 5});           // N, the most that a hand pushes with
  if (!touch.update({.point = 0, .normal = 1, .stiffness = 2000})) return 1;

  sim::device<scene, sim::impedance_hand<scene>> device{
      {.mass = 0.1, .damping = 0.1, .start = 0.01},
      {.stiffness = 300, .limit = 5, .target = -0.01}};

  auto sample = device.exchange(0);
  for (int ms = 1; ms <= 1000; ++ms) {
    const auto out = touch.tick(sample);
    sample = device.exchange(out.force);
    if (ms % 200 == 0) {
      std::printf("%4d ms: %5.2f mm deep, %4.2f N\n", ms, 1e3 * out.depth, out.force);
    }
  }
  std::printf("the wall has created %.1f mJ\n", 0 - 1e3 * device.meter().minimum());
}
