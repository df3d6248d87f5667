// SPDX-License-Identifier: BSD-3-Clause
// A finger is pulled along a rough plane by a soft spring, sticks, slips, and sticks again; then it trembles.
//
// stick_slip bends a bristle while the surface holds, up to μ_s times the pressure, and lets it slip at
// μ_d. In stick the bristle knows nothing but travel, so it returns when the finger does.

#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/simulation/device.hpp>

#include <cmath>
#include <cstdio>

namespace ph = passive_haptics;
namespace sim = ph::simulation;
using scene = ph::space<double, 3>;
using vector = scene::vector;

int main() {
  const double mass = 0.1, damping = 0.03;  // of the device, kg and N·s/m
  auto port = ph::make_contacts<scene>(
      {.mass = mass, .damping = damping, .force_limit = 9, .longest_tick = 1e-3}, {.force = 5},
      ph::stick_slip{.static_coefficient = 0.6, .kinetic_coefficient = 0.4},
      ph::slots<ph::half_space<scene>, 1>{});
  port.source().update(0, ph::half_space<scene>{{0, 0, 0}, {0, 0, 1}, 1000});  // N/m

  sim::device<scene, sim::impedance_hand<scene>> device{
      {.mass = mass, .damping = damping, .start = {0, 0, 0.001}},
      {.stiffness = 100, .damping = 1, .limit = 5}};
  auto sample = device.exchange(vector::Zero());
  const auto tick_towards = [&](const vector& hand) -> vector {
    device.hand().target = hand;
    const vector force = port.tick(sample).force;
    sample = device.exchange(force);
    return force;
  };
  const vector pressing(0, 0, -0.02), along(1, 0, 0);  // m
  for (int ms = 0; ms < 300; ++ms) tick_towards(pressing);
  for (int ms = 1; ms <= 1600; ++ms) {
    const vector force = tick_towards(pressing + along * (15e-6 * ms));
    if (ms % 100 != 0) continue;
    const char* does = std::abs(device.velocity()(0)) > 2e-3 ? "slips" : "sticks";
    std::printf("hand %4.1f mm  finger %4.1f mm  %-6s  friction %4.2f of the pressure\n",
                15e-3 * ms, 1e3 * device.position()(0), does,
                std::hypot(force(0), force(1)) / force(2));
  }

  double start = 0, swing = 0;
  for (int ms = 0; ms <= 20000; ++ms) {  // 9 Hz, 0.3 mm
    const double tremor = 3e-4 * std::sin(2 * 3.14159265358979 * 9e-3 * ms);
    tick_towards(pressing + along * 0.024 + vector(tremor, tremor, tremor));
    if (ms == 1000) start = device.position()(0);
    if (ms > 1000) swing = std::fmax(swing, std::abs(device.position()(0) - start));
  }
  std::printf("trembling by %.0f µm for 19 s it crept %.1f µm; the port has created %.1f mJ\n",
              1e6 * swing, 1e6 * std::abs(device.position()(0) - start),
              -1e3 * device.meter().minimum() + 0.0);
}
