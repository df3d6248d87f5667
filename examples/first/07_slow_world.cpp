// SPDX-License-Identifier: BSD-3-Clause
// A world that answers 30 times a second, and whose surface heaves by 3 mm until it stands still. One that knows its
// velocity and how late it is tells them: touch.update({...}, {.velocity = v, .age = 0.02}), in m/s and s.
#include "judge.hpp"

using scene = ph::space<double, 1>;

int main() {
  auto touch = ph::make_touch<scene>(
      {.mass = 0.1, .damping = 0.1, .force_limit = 9, .longest_tick = 1e-3}, {.force = 5});
  session<scene> finger({.mass = 0.1, .damping = 0.2, .start = 0.02}, 5);
  int ms = 0;
  double step = 0, last = 0;
  const auto tick = [&](const auto& sample) {
    const double heave = ms < 3000 ? 0.003 * std::sin(0.005 * ms) : 0.0;
    if (ms++ % 33 == 0) touch.update({.point = heave, .normal = 1, .stiffness = 1000});
    const double force = touch.tick(sample).force;
    if (ms > 1000) step = std::max(step, std::abs(force - last));
    return last = force;
  };
  finger.hold(-0.01, 3, tick);
  const double heaving = step;
  std::printf("largest step of the force, while it heaves: %.3f N\n", heaving);
  finger.hold(-0.01, 3, tick);
  return finger.verdict(touch.explain()) + (heaving < 0.02 ? 0 : 1);
}
