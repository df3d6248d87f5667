// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: encoder_steps needs one number for each axis of the port
//
// Two joints, three encoders.

#include <passive_haptics/device/encoder_steps.hpp>
#include <passive_haptics/device/joint_space.hpp>

namespace ph = passive_haptics;

using joints = ph::joint_space<float, 2>;

#ifdef POSITIVE_CONTROL
using part = ph::encoder_steps<2>;
#else
using part = ph::encoder_steps<3>;
#endif
ph::part_at<part, joints> at_joints(part{});
