// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: between_samples knows one acceleration
//
// The largest acceleration of a joint depends on the pose.

#include <passive_haptics/compliant/compositions.hpp>
#include <passive_haptics/device/joint_space.hpp>

namespace ph = passive_haptics;

using joints = ph::joint_space<float, 2>;
using dual = ph::basic_dual_ledger<ph::diagonal_damping<2>>;

#ifdef POSITIVE_CONTROL
using part = dual;
#else
using part = ph::between_samples<dual>;
#endif
ph::part_at<part, joints> at_joints(part{});
