// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: energy_bounding measures lengths in a space
//
// Its ball has a radius in newtons.

#include <passive_haptics/device/joint_space.hpp>
#include <passive_haptics/force_bound/strict_bound.hpp>
#include <passive_haptics/published/energy_bounding.hpp>

namespace ph = passive_haptics;

using joints = ph::joint_space<float, 2>;

#ifdef POSITIVE_CONTROL
using part = ph::strict_bound;
#else
using part = ph::energy_bounding;
#endif
ph::part_at<part, joints> at_joints(part{});
