// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: impedance_side has no local model for this bound to compare with
//
// The thesis bound keeps what the local model held before; a channel brings forces, no surface.

#include <passive_haptics/bounds.hpp>
#include <passive_haptics/two_port.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

#ifdef POSITIVE_CONTROL
using bound = ph::strict_bound<scene>;
#else
using bound = ph::thesis_bound<scene>;
#endif
ph::impedance_side device{scene{}, ph::two_port_energy<scene>{}, bound{}};
