// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: say what dt is
//
// A controller of a channel: a force, a displacement, and the time it took.

#include <passive_haptics/two_port.hpp>

namespace ph = passive_haptics;
using joint = ph::space<double, 1>;

double damped(ph::two_port_series_controller<joint>& side, double force, double step, double dt) {
#ifdef POSITIVE_CONTROL
  return side.force(force, step, ph::seconds{dt});
}
#else
  return side.force(force, step, dt);
}
#endif
