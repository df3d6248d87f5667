// SPDX-License-Identifier: BSD-3-Clause
// You have a force already, from a renderer of your own? Force in, force out: a passive port stands
// between it and the motors, and whatever the renderer asks for, the hand gains no energy and finds rest.
//
// The renderer here is the simplest there is, a spring of 3000 N/m below x = 0. That is more than the
// 2b/T = 400 N/m that the device's damping pays for, so by itself it rings. And one day it hangs: a
// force that nobody renews fades, instead of pushing for ever.

#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/simulation/device.hpp>

#include <cmath>
#include <cstdio>

namespace ph = passive_haptics;
namespace sim = ph::simulation;
using scene = ph::space<double, 1>;

constexpr double damping = 0.2;  // of the device, N·s/m; state less than it has

double renderer(double x) {
  return x < 0.0 ? -3000.0 * x : 0.0;
}

int main() {
  for (const bool guarded : {false, true}) {
    auto port = ph::make_guard<scene>(
        {.mass = 0.1, .damping = damping, .force_limit = 9.0, .longest_tick = 1e-3},
        {.force = 12.0});
    static_assert(decltype(port)::passivity == ph::guarantee::conditional);

    // A simulated device, and a hand that comes down from 30 mm and presses.
    sim::device<scene, sim::impedance_hand<scene>> device{
        {.mass = 0.1, .damping = damping, .start = 0.03}, {.stiffness = 300.0, .target = -0.003}};
    auto sample = device.exchange(0.0);
    for (int ms = 1; ms < 1000; ++ms) {
      const double wanted = renderer(sample.position);
      sample = device.exchange(guarded ? port.tick(sample, wanted).force : wanted);
    }
    std::printf("%s: port energy never below %.1f mJ, %.1f mm/s after a second\n",
                guarded ? "with the port" : "without", device.meter().minimum() * 1e3,
                std::abs(device.velocity()) * 1e3);

    for (int ms = 0; guarded && ms <= 160; ++ms) {
      const auto out = port.tick(sample);  // nothing wanted anew
      if (ms % 20 == 0) {
        std::printf("silent for %3d ms: %.2f N, %s\n", ms, out.force, ph::to_string(out.what));
      }
      sample = device.exchange(out.force);
    }
  }
}
