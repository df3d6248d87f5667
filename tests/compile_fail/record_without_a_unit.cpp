// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: say what dt is
//
// What the scope keeps of a tick: a position, its length and its result.

#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/runner/scope.hpp>

namespace ph = passive_haptics;
using joint = ph::space<double, 1>;

void keep(ph::scope<joint, 100>& seen, double x, double dt, const ph::port_result<joint>& out) {
#ifdef POSITIVE_CONTROL
  seen.record(x, ph::seconds{dt}, out);
}
#else
  seen.record(x, dt, out);
}
#endif
