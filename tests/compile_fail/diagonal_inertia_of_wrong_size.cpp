// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: diagonal_inertia needs one number for each axis of the port
//
// Two joints, three numbers.

#include <passive_haptics/device/inertia.hpp>
#include <passive_haptics/device/joint_space.hpp>

namespace ph = passive_haptics;

using joints = ph::joint_space<float, 2>;

#ifdef POSITIVE_CONTROL
using part = ph::diagonal_inertia<2>;
#else
using part = ph::diagonal_inertia<3>;
#endif
ph::part_at<part, joints> at_joints(part{});
