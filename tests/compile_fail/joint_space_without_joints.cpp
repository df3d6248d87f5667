// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: a joint_space has one joint or more
//
// A port has at least one degree of freedom.

#include <passive_haptics/device/joint_space.hpp>

namespace ph = passive_haptics;

#ifdef POSITIVE_CONTROL
constexpr int joints = 1;
#else
constexpr int joints = 0;
#endif
int axes = ph::joint_space<float, joints>::dof;
