// SPDX-License-Identifier: BSD-3-Clause
// A motor of 1 N against a hand of 3 N: it gives what it has, and shows the stiffness where that is enough.
#include "judge.hpp"

using scene = ph::space<double, 1>;

int main() {
  auto touch = ph::make_touch<scene>(
      {.mass = 0.1, .damping = 0.1, .force_limit = 1, .longest_tick = 1e-3}, {.force = 5});
  if (!touch.update({.point = 0, .normal = 1, .stiffness = 2000})) return 1;
  session<scene> finger({.mass = 0.1, .damping = 0.2, .force_limit = 1, .start = 0.02}, 3);
  const auto tick = [&](const auto& sample) { return touch.tick(sample).force; };
  finger.hold(-0.01, 2, tick);
  std::printf("%.1f N, held back by: %s\n", touch.explain().force, to_string(touch.explain().now));
  finger.hold(-0.002, 3, tick);
  return finger.verdict(touch.explain());
}
