// SPDX-License-Identifier: BSD-3-Clause
// A corner of three walls, one of which heaves: the world tells of it 30 times a second.
//
// contact_set is ONE spring between the device and the place that the walls leave free, and what the world
// tells is made up for at a limited speed. Beside it: by how much a force would step that is the sum of a
// spring for each wall as it was told last. A floor that lifts the hand works on it, and the ledger pays;
// where it has less, the floor rises slower, so that the bound has nothing to cut.

#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/simulation/device.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace ph = passive_haptics;
namespace sim = ph::simulation;
using scene = ph::space<double, 3>;
using vector = scene::vector;
using plane = ph::half_space<scene>;

int main() {
  const double mass = 0.1, damping = 0.1;  // of the device, kg and N·s/m
  auto corner = ph::make_contacts<scene>(
      {.mass = mass, .damping = damping, .force_limit = 9, .longest_tick = 1e-3}, {.force = 5},
      ph::slots<plane, 3>{});
  plane floor{{0, 0, 0}, {0, 0, 1}, 800};  // N/m
  const plane side{{0, 0, 0}, {1, 0, 0}, 800}, back{{0, 0, 0}, {0, 1, 0}, 800};
  corner.source().update(1, side);
  corner.source().update(2, back);

  sim::device<scene, sim::impedance_hand<scene>> device{{.mass = mass, .damping = damping},
                                                        {.stiffness = 200, .limit = 5}};
  auto sample = device.exchange(vector::Zero());
  vector last = vector::Zero(), last_sum = vector::Zero();
  double step = 0, step_of_sum = 0;
  for (int tick = 1; tick <= 3000; ++tick) {
    device.hand().target = vector::Constant(-0.01 * std::min(1e-3 * tick, 1.0));
    if (tick % 33 == 1) {
      floor.point = {0, 0, 0.003 * std::sin(7e-3 * tick)};
      corner.source().update(0, floor);
    }
    const vector force = corner.tick(sample).force;
    vector sum = vector::Zero();
    for (const plane& wall : {floor, side, back}) {
      sum += wall.stiffness * std::max(wall.at(sample.position).depth, 0.0) * vector(wall.normal);
    }
    step = std::max(step, (force - std::exchange(last, force)).norm());
    step_of_sum = std::max(step_of_sum, (sum - std::exchange(last_sum, sum)).norm());
    sample = device.exchange(force);
    if (tick % 500 != 0) continue;
    std::printf("t %4.2f s  force %3.1f %3.1f %3.1f N  largest step %4.2f N, of the sum %4.2f N\n",
                1e-3 * tick, force(0), force(1), force(2), step, step_of_sum);
    step = step_of_sum = 0;
  }
  std::printf("the port has created %.1f mJ\n", -1e3 * device.meter().minimum() + 0.0);
}
