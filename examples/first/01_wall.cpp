// SPDX-License-Identifier: BSD-3-Clause
// A wall of 2 kN/m under a finger.
#include "judge.hpp"

using scene = ph::space<double, 1>;

int main() {
  auto touch = ph::make_touch<scene>(
      {.mass = 0.1, .damping = 0.1, .force_limit = 9, .longest_tick = 1e-3}, {.force = 5});
  if (!touch.update({.point = 0, .normal = 1, .stiffness = 2000})) return 1;

  session<scene> finger({.mass = 0.1, .damping = 0.2, .start = 0.02}, 5);
  finger.hold(-0.01, 2, [&](const auto& sample) { return touch.tick(sample).force; });
  return finger.verdict(touch.explain());
}
