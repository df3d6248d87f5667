// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: modelled_reach knows one
//
// What is known of the transmission is known along directions.

#include <passive_haptics/compliant/compositions.hpp>
#include <passive_haptics/device/joint_space.hpp>

namespace ph = passive_haptics;

using joints = ph::joint_space<float, 2>;

#ifdef POSITIVE_CONTROL
using part = ph::strict_bound;
#else
using part = ph::modelled_reach<2>;
#endif
ph::part_at<part, joints> at_joints(part{});
