// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: isotropic_damping has one number for all directions of a space
//
// A joint has a damping of its own [N·m·s].

#include <passive_haptics/device/damping.hpp>
#include <passive_haptics/device/joint_space.hpp>

namespace ph = passive_haptics;

using joints = ph::joint_space<float, 2>;

#ifdef POSITIVE_CONTROL
using part = ph::diagonal_damping<2>;
#else
using part = ph::isotropic_damping;
#endif
ph::part_at<part, joints> at_joints(part{});
