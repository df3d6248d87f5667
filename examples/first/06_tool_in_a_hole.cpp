// SPDX-License-Identifier: BSD-3-Clause
// A peg of 40 mm in a hole, six degrees of freedom: the hand leans on it. Each point has one wall, for a peg that keeps
// its heading; one that may turn round is told all that is near anew in each frame, by contact/manifold.hpp.
#include <passive_haptics/simulation/quiet.hpp>
#include <passive_haptics/simulation/rigid_device.hpp>
#include <passive_haptics/six_dof.hpp>

#include <algorithm>
#include <cstdio>

namespace ph = passive_haptics;
using body = ph::rigid_body<double>;
using plane = ph::half_space<ph::space<double, 3>>;

int main() {
  auto peg = ph::make_tool({.inertia = {.mass = 0.15, .least = 1e-4, .spread = 2e-4},
                            .damping = {.linear = 0.03, .angular = 1e-4},
                            .damping_most = {.linear = 0.06, .angular = 2e-4},
                            .force_limit = 9,
                            .torque_limit = 0.5},
                           {.force = 5, .torque = 0.1}, ph::slots<plane, 10>{});
  int slot = 0;
  for (const double z : {-0.04, 0.0})  // of its lower and its upper end, from the handle
    for (const double side : {-1.0, 1.0}) {
      peg.source().update(slot++, {0.01 * side, 0, z},
                          plane{{0.0102 * side, 0, 0}, {-side, 0, 0}, 2000});
      peg.source().update(slot++, {0, 0.01 * side, z},
                          plane{{0, 0.0102 * side, 0}, {0, -side, 0}, 2000});
    }
  peg.source().update(slot, {0, 0, -0.04}, plane{{0, 0, 0}, {0, 0, 1}, 2000});  // the floor

  ph::simulation::rigid_device device({}, {.position = {0, 0, 0.045}, .orientation = {}});
  ph::simulation::quiet_judge<body> judge;
  device.push(body::join({0.5, 0, -2}, {0, 0.02, 0}));  // N, N·m
  double least = 0;
  auto sample = device.exchange(body::zero());
  for (int ms = 0; ms < 6000; ++ms) {
    const auto wrench = peg.tick(sample).force;
    judge.add_at(wrench, sample.position, 1e-3, {});
    sample = device.exchange(wrench);
    least = std::min(least, device.energy());
  }
  const double deep = 0.04 - device.at().position.values[2];
  std::printf("created %.2f mJ, at rest after %.1f s, pressed with 2.0 N it shows %.0f N/m\n",
              -1e3 * least + 0.0, judge.settling(), 2.0 / deep);
  return least >= -1e-9 && judge.settling() < 3 && std::abs(2000 * deep / 2 - 1) < 0.05 ? 0 : 1;
}
