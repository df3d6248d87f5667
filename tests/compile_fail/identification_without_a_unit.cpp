// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: say what dt is
//
// An axis that is identified: a position and the length of its tick.

#include <passive_haptics/identification.hpp>

namespace ph = passive_haptics;

double force(ph::identification::axis_identification& axis, double x, double dt) {
#ifdef POSITIVE_CONTROL
  return axis.tick(x, ph::seconds{dt});
}
#else
  return axis.tick(dt, x);
}
#endif
