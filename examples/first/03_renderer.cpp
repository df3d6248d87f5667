// SPDX-License-Identifier: BSD-3-Clause
// A force that somebody's renderer makes, a ball of 3 kN/m, kept from ringing.
#include "judge.hpp"

using scene = ph::space<double, 3>;
using vector = scene::vector;

vector renderer(const vector& x) {
  const double deep = 0.05 - x.norm();  // m
  return deep > 0 ? vector(3000 * deep * x.normalized()) : vector::Zero();
}

int main() {
  auto guard = ph::make_guard<scene>(
      {.mass = 0.1, .damping = 0.1, .force_limit = 9, .longest_tick = 1e-3}, {.force = 5});
  session<scene> finger({.mass = 0.1, .damping = 0.2, .start = {0.01, 0.02, 0.07}}, 5);
  finger.hold({0, 0, 0.04}, 3, [&](const auto& sample) {
    return guard.tick(sample, renderer(sample.position)).force;
  });
  const vector x = finger.device().position();
  std::printf("settles renderers of up to %.0f N/m\n", guard.explain().shown);
  return finger.verdict(guard.explain().force, 0.05 - x.norm(), 3000);
}
