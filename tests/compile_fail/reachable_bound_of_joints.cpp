// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: reachable_bound knows one mass for all directions of a space
//
// One number of kilograms says nothing of a joint's inertia.

#include <passive_haptics/device/joint_space.hpp>
#include <passive_haptics/force_bound/reachable_bound.hpp>

namespace ph = passive_haptics;

using joints = ph::joint_space<float, 2>;

#ifdef POSITIVE_CONTROL
using part = ph::reachable_work_bound<2>;
#else
using part = ph::reachable_bound;
#endif
ph::part_at<part, joints> at_joints(part{});
