// SPDX-License-Identifier: BSD-3-Clause
// A square peg in a square hole 0.5 mm wider: six degrees of freedom, one port for force and torque.
//
// rigid_tool knows points of the tool and what each may touch: here the corners of the peg, two walls for
// each and the floor for the lower ones. Its lever is a length of the tool, 30 mm unless stated:
// told 20 mm this peg of 40 mm settles, too, and tilts by 2.7 degrees where it tilts by 1.2 told 40.

#include <passive_haptics/simulation/rigid_device.hpp>
#include <passive_haptics/six_dof.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace ph = passive_haptics;
using body = ph::rigid_body<double>;
using vector = body::triple;
using plane = ph::half_space<ph::space<double, 3>>;

int main() {
  auto peg = ph::make_tool({.inertia = {.mass = 0.15, .least = 1e-4, .spread = 2e-4},  // kg, kg·m²
                            .damping = {.linear = 0.03, .angular = 1e-4},  // N·s/m, N·m·s/rad
                            .damping_most = {.linear = 0.06, .angular = 2e-4},
                            .force_limit = 9,     // N
                            .torque_limit = 0.5,  // N·m
                            .longest_tick = 1e-3},
                           {.force = 5, .torque = 0.1}, ph::slots<plane, 20>{});

  const double half = 0.01, length = 0.04, room = half + 0.00025;  // m
  int slot = 0;
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      for (const double z : {-length, 0.0}) {
        const vector corner(half * x, half * y, z);  // from the handle, which is on top of the peg
        peg.source().update(slot++, corner, plane{{room * x, 0, 0}, {-x, 0, 0}, 2000});  // N/m
        peg.source().update(slot++, corner, plane{{0, room * y, 0}, {0, -y, 0}, 2000});
        if (z < 0) peg.source().update(slot++, corner, plane{{0, 0, 0}, {0, 0, 1}, 2000});
      }

  ph::simulation::rigid_device device({}, {.position = {0, 0, 0.05}, .orientation = {}});
  auto sample = device.exchange(body::zero());
  double least = 0;
  const auto push = [&](const char* what, const vector& force, const vector& torque) {
    device.push(body::join(force, torque));
    for (int ms = 0; ms < 3000; ++ms) {
      sample = device.exchange(peg.tick(sample).force);
      least = std::min(least, device.energy());
    }
    const auto [place, turn] = device.at();
    std::printf("%-9s %3.1f mm aside, %4.1f mm up, turned by %3.1f deg, moves %3.1f mm/s\n", what,
                1e3 * std::hypot(place.values[0], place.values[1]), 1e3 * place.values[2],
                57.3 * ph::rotation::log(turn).norm(), 1e3 * device.velocity().norm());
  };
  push("pressed", {0, 0, -2}, {0, 0, 0});  // N, N·m
  push("sideways", {1, 0, -2}, {0, 0, 0});
  push("tilted", {0, 0, -2}, {0, 0.03, 0});
  push("twisted", {0, 0, -2}, {0, 0, 0.03});
  std::printf("the port has created %.1f mJ\n", -1e3 * least + 0.0);
}
