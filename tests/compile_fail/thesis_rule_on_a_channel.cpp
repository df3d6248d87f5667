// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: this is a shaper, not a bound
//
// The rule keeps what the local model held before; a channel brings forces, no surface.

#include <passive_haptics/force_bound/strict_bound.hpp>
#include <passive_haptics/shaper/thesis_rule.hpp>
#include <passive_haptics/two_port.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

#ifdef POSITIVE_CONTROL
using bound = ph::strict_bound;
#else
using bound = ph::thesis_rule;
#endif
ph::impedance_side device{scene{}, ph::two_port_energy{}, bound{}, ph::loop_limits{}};
