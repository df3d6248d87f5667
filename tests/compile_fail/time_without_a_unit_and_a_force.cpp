// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: say what dt is
//
// A number that does not say that it is a time, in front of a wanted force.

#include <passive_haptics/passive_haptics.hpp>

namespace ph = passive_haptics;
using joint = ph::space<double, 1>;

double force(double x, double dt, double wanted) {
  ph::passive_port port{joint{}, ph::given_force{}, ph::reduced_energy{.damping = 0.1},
                        ph::strict_bound{}, ph::loop_limits{.longest_tick = 1e-3}};
#ifdef POSITIVE_CONTROL
  return port.tick(x, ph::seconds{dt}, wanted).force;
}
#else
  return port.tick(x, dt, wanted).force;
}
#endif
