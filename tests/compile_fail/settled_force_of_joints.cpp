// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: settled_force damps along the directions of a space
//
// A force has a direction in a space. Torques of joints have none that a mass in kilograms goes with.

#include <passive_haptics/contact/settled_force.hpp>
#include <passive_haptics/device/joint_space.hpp>

namespace ph = passive_haptics;

using joints = ph::joint_space<float, 2>;

#ifdef POSITIVE_CONTROL
using part = ph::given_force;
#else
using part = ph::settled_force;
#endif
ph::part_at<part, joints> at_joints(part{});
