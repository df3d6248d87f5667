// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: rigid_damping has one number for travel and one for turns
//
// A point in space does not turn.

#include <passive_haptics/device/rigid_damping.hpp>

namespace ph = passive_haptics;

#ifdef POSITIVE_CONTROL
using device = ph::rigid_body<float>;
#else
using device = ph::space<float, 3>;
#endif
ph::part_at<ph::rigid_damping, device> damping({});
