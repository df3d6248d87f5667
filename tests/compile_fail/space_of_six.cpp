// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: a space has one, two or three dimensions
//
// A wrench is no vector of a space: radians and metres do not add up.

#include <passive_haptics/device/joint_space.hpp>

namespace ph = passive_haptics;

#ifdef POSITIVE_CONTROL
using device = ph::joint_space<float, 6>;
#else
using device = ph::space<float, 6>;
#endif
int axes = device::dof;
