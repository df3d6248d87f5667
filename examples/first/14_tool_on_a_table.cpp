// SPDX-License-Identifier: BSD-3-Clause
// A tool on three feet, six degrees of freedom: the hand presses it onto a table, and off its middle.
#include <passive_haptics/simulation/rigid_device.hpp>
#include <passive_haptics/six_dof.hpp>

#include <cmath>
#include <cstdio>

namespace ph = passive_haptics;
using body = ph::rigid_body<double>;
using plane = ph::half_space<ph::space<double, 3>>;

int main() {
  auto tool = ph::make_tool({.inertia = {.mass = 0.15, .least = 1e-4, .spread = 2e-4},  // kg, kg·m²
                             .damping = {.linear = 0.03, .angular = 1e-4},  // N·s/m, N·m·s/rad
                             .damping_most = {.linear = 0.06, .angular = 2e-4},
                             .force_limit = 9,
                             .torque_limit = 0.5},
                            {.force = 5, .torque = 0.1}, ph::slots<plane, 3>{});
  const plane table{{0, 0, 0}, {0, 0, 1}, 2000};
  tool.source().update(0, {0.03, 0, -0.04}, table);  // each foot, from the handle, in metres
  tool.source().update(1, {-0.02, 0.03, -0.04}, table);
  tool.source().update(2, {-0.02, -0.03, -0.04}, table);

  ph::simulation::rigid_device device({}, {.position = {0, 0, 0.045}, .orientation = {}});
  device.push(body::join({0, 0, -2}, {0, 0.01, 0}));  // the hand: N, N·m
  auto sample = device.exchange(body::zero());
  for (int ms = 0; ms < 2000; ++ms) sample = device.exchange(tool.tick(sample).force);
  const double deep = 0.04 - device.at().position.values[2];
  std::printf("%.2f mm deep under 2 N, %.1f mJ paid in\n", 1e3 * deep, 1e3 * device.energy());
  return device.energy() >= 0 && std::fabs(deep - 0.001) < 5e-5 ? 0 : 1;
}
