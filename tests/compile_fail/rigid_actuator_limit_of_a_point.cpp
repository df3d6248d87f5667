// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: rigid_actuator_limit bounds a force and a torque
//
// A point in space is held by no torque.

#include <passive_haptics/force_bound/rigid_reachable_bound.hpp>

namespace ph = passive_haptics;

#ifdef POSITIVE_CONTROL
using device = ph::rigid_body<float>;
#else
using device = ph::space<float, 3>;
#endif
ph::part_at<ph::rigid_actuator_limit, device> limit({});
