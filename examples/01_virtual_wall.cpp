// SPDX-License-Identifier: BSD-3-Clause
// A virtual wall for a slider: press 4 mm into it, and come back out.
//
// K = 2500 N/m is more than the 2b/T = 1000 N/m that the device's damping pays for, so a plain
// spring would return more energy than it took. The strict bound never lets that happen: on the way
// in the force is what the hand has paid for, √(4 B E1), and on the way out it cannot spend more
// than is left. 01_virtual_wall_by_hand.cpp is the same without the library.

#include <passive_haptics/passive_haptics.hpp>

#include <cstdio>

namespace ph = passive_haptics;
using scene = ph::space<double, 1>;

int main() {
  const double dt = 1e-3;  // s
  // The surface is at 0 m, the object below it: outward is +1.
  const ph::half_space<scene> surface{.point = 0.0, .normal = 1.0, .stiffness = 2500.0};
  // By hand: the strict bound alone, to see what it cuts.
  ph::local_model wall{scene{},
                       ph::fixed{surface},
                       ph::turn_at_once{},                    // a flat wall never turns
                       ph::spring{},                          // f* = K d
                       ph::reduced_energy{.damping = 0.5},    // of the device, N·s/m
                       ph::strict_bound{},                    // passive, always
                       ph::loop_limits{.longest_tick = dt}};  // the worst tick of YOUR loop
  static_assert(decltype(wall)::passivity == ph::guarantee::strict);

  std::puts("   x [mm]   force [N]  energy [mJ]");
  for (const double millimetres :
       {3., 2., 1., 0., -1., -2., -3., -4., -4., -3., -2., -1., 0., 1.}) {
    const auto out = wall.tick(millimetres * 1e-3, ph::seconds{dt});
    std::printf("%9.1f %11.3f %12.3f%s\n", millimetres, out.force, out.energy * 1e3,
                out.limited ? "  limited" : "");
  }
}
