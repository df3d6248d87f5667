// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: two_layer_tank drags with one damping in all directions of a space
//
// One number of N·s/m is no damping of joints.

#include <passive_haptics/device/joint_space.hpp>
#include <passive_haptics/force_bound/strict_bound.hpp>
#include <passive_haptics/published/energy_tank.hpp>

namespace ph = passive_haptics;

using joints = ph::joint_space<float, 2>;

#ifdef POSITIVE_CONTROL
using part = ph::strict_bound;
#else
using part = ph::two_layer_tank;
#endif
ph::part_at<part, joints> at_joints(part{});
