// SPDX-License-Identifier: BSD-3-Clause
// What it is all for: the wall of 01_wall as a spring and nothing else. This one ends with 1.
#include "judge.hpp"

using scene = ph::space<double, 1>;

int main() {
  session<scene> finger({.mass = 0.1, .damping = 0.2, .start = 0.02}, 5);
  const auto spring = [](double x) { return x < 0 ? -2000 * x : 0; };
  finger.hold(-0.01, 2, [&](const auto& sample) { return spring(sample.position); });
  const double x = finger.device().position();
  return finger.verdict(spring(x), -x, 2000);
}
