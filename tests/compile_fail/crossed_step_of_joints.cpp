// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: crossed_step has one mass
//
// The largest acceleration of a joint depends on the pose; one that turns alone has one inertia.

#include <passive_haptics/device/joint_space.hpp>
#include <passive_haptics/identification/crossed_step.hpp>

namespace ph = passive_haptics;

#ifdef POSITIVE_CONTROL
using joints = ph::joint_space<float, 1>;
#else
using joints = ph::joint_space<float, 2>;
#endif
using ledger =
    ph::basic_dual_ledger<ph::diagonal_damping_and_friction<joints::dof>, ph::crossed_step>;
ph::part_at<ledger, joints> at_joints(ledger{});
