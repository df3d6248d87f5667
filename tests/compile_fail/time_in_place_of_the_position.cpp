// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: say what dt is
//
// The position and the time are swapped.

#include <passive_haptics/passive_haptics.hpp>

namespace ph = passive_haptics;
using joint = ph::space<double, 1>;

double force(double x, double dt) {
  ph::passive_port port{joint{}, ph::given_force{}, ph::reduced_energy{.damping = 0.1},
                        ph::strict_bound{}, ph::loop_limits{.longest_tick = 1e-3}};
#ifdef POSITIVE_CONTROL
  return port.tick(x, ph::seconds{dt}).force;
}
#else
  return port.tick(dt, x).force;
}
#endif
