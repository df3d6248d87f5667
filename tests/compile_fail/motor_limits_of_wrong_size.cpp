// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: motor_limits needs one number for each axis of the port
//
// Two joints, three numbers.

#include <passive_haptics/device/joint_space.hpp>
#include <passive_haptics/force_bound/actuator_limit.hpp>

namespace ph = passive_haptics;

using joints = ph::joint_space<float, 2>;

#ifdef POSITIVE_CONTROL
using part = ph::motor_limits<2>;
#else
using part = ph::motor_limits<3>;
#endif
ph::part_at<part, joints> at_joints(part{});
