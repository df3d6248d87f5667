// SPDX-License-Identifier: BSD-3-Clause
// A consumer's program that takes two companions: a simulated device, in a thread of the runner's.

#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/runner.hpp>
#include <passive_haptics/simulation/device.hpp>

namespace ph = passive_haptics;
using scene = ph::space<double, 1>;

int main() {
  ph::simulation::device<scene> grip{{.mass = 0.1, .damping = 0.03}};
  ph::runner loop{grip, [](const auto& /*sample*/) { return 0.0; }};
  if (!loop.start()) return 1;
  loop.stop();
  return 0;
}
