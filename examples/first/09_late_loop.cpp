// SPDX-License-Identifier: BSD-3-Clause
// A loop whose commands are held a tick late, as on every device that talks in packets: told, and softer for it.
#include "judge.hpp"

using scene = ph::space<double, 1>;
using plane = ph::half_space<scene>;

int main() {
  auto touch = ph::make_touch<scene, plane, ph::late_loop_limits<1>>(
      {.mass = 0.1, .damping = 0.1, .force_limit = 9, .longest_tick = 1e-3, .latency = 1},
      {.force = 5});
  const auto shown = touch.update({.point = 0, .normal = 1, .stiffness = 8000}).stiffness;
  std::printf("asked for 8000 N/m, shown %.0f\n%s\n", shown, touch.explain().because());

  session<scene> finger({.mass = 0.1, .damping = 0.2, .start = 0.02, .latency = 1}, 5);
  finger.hold(-0.01, 3, [&](const auto& sample) { return touch.tick(sample).force; });
  return finger.verdict(touch.explain());
}
