// SPDX-License-Identifier: BSD-3-Clause
// Two devices are two ports. A board of 2 kg floats between two hands, each of which feels it through its own.
#include "judge.hpp"

using scene = ph::space<double, 1>;

int main() {
  const ph::exact_device device{
      .mass = 0.1, .damping = 0.1, .force_limit = 9, .longest_tick = 1e-3};
  auto left = ph::make_touch<scene>(device, {.force = 5});
  auto right = ph::make_touch<scene>(device, {.force = 5});
  session<scene> one({.mass = 0.1, .damping = 0.2, .start = -0.05}, 3);
  session<scene> other({.mass = 0.1, .damping = 0.2, .start = 0.05}, 3);
  double board = 0.005, speed = 0, from_left = 0, from_right = 0;  // its middle [m], [m/s], [N]
  const auto tick = [&](auto& touch, double side, double& force, const auto& sample) {
    touch.update({.point = board + 0.02 * side, .normal = side, .stiffness = 1000});
    return force = touch.tick(sample).force;
  };
  for (int ms = 0; ms < 4000; ++ms) {  // the world, a thousand times a second
    one.hold(
        -0.01, 1e-3, [&](const auto& s) { return tick(left, -1, from_left, s); }, ms == 0);
    other.hold(
        0.01, 1e-3, [&](const auto& s) { return tick(right, 1, from_right, s); }, ms == 0);
    speed += 1e-3 * (-from_left - from_right - 40 * speed) / 2.0;
    board += 1e-3 * speed;
  }
  return one.verdict(left.explain()) + other.verdict(right.explain());
}
