// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: this bound is not proved for a loop that is so late
//
// A chain holds as late as the least of its bounds: the one in front is proved for any latency, the
// one behind it, which makes the chain strict, for none.

#include <passive_haptics/constraint_geometry/fixed.hpp>
#include <passive_haptics/constraint_geometry/followed.hpp>
#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/contact/spring.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/force_bound/bound_chain.hpp>
#include <passive_haptics/force_bound/reachable_bound.hpp>
#include <passive_haptics/force_bound/strict_bound.hpp>
#include <passive_haptics/local_model.hpp>
#include <passive_haptics/normal_interpolation/turn_at_once.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

using wall = ph::half_space<scene>;

#ifdef POSITIVE_CONTROL
using last = ph::strict_bound;
#else
using last = ph::per_axis_bound;
#endif

ph::local_model model{scene{},
                      ph::followed<wall>{},
                      ph::turn_at_once{},
                      ph::spring{},
                      ph::reduced_energy{},
                      ph::bound_chain{ph::reachable_bound{}, last{}},
                      ph::late_loop_limits<1>{}};
