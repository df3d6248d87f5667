// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: actuator_limit bounds the length of a force
//
// A torque and a force have no common length: each motor has its own limit.

#include <passive_haptics/device/joint_space.hpp>
#include <passive_haptics/force_bound/actuator_limit.hpp>

namespace ph = passive_haptics;

using joints = ph::joint_space<float, 2>;

#ifdef POSITIVE_CONTROL
using part = ph::motor_limits<2>;
#else
using part = ph::actuator_limit;
#endif
ph::part_at<part, joints> at_joints(part{});
