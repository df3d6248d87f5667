// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: say what dt is
//
// The other side of a channel: one step of an environment under a force.

#include <passive_haptics/two_port.hpp>

namespace ph = passive_haptics;
using joint = ph::space<double, 1>;

double moved(ph::admittance_side<joint>& side, double force, double dt) {
#ifdef POSITIVE_CONTROL
  return side.step(force, ph::seconds{dt}).displacement;
}
#else
  return side.step(force, dt).displacement;
}
#endif
