// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: diagonal_damping needs one number for each axis of the port
//
// Two joints, three numbers.

#include <passive_haptics/device/damping.hpp>
#include <passive_haptics/device/joint_space.hpp>

namespace ph = passive_haptics;

using joints = ph::joint_space<float, 2>;

#ifdef POSITIVE_CONTROL
using part = ph::diagonal_damping<2>;
#else
using part = ph::diagonal_damping<3>;
#endif
ph::part_at<part, joints> at_joints(part{});
