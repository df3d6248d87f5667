// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: damping_and_friction has one number for all directions of a space
//
// A joint has a damping and a friction of its own.

#include <passive_haptics/device/dry_friction.hpp>
#include <passive_haptics/device/joint_space.hpp>

namespace ph = passive_haptics;

using joints = ph::joint_space<float, 2>;

#ifdef POSITIVE_CONTROL
using part = ph::diagonal_damping_and_friction<2>;
#else
using part = ph::damping_and_friction;
#endif
ph::part_at<part, joints> at_joints(part{});
