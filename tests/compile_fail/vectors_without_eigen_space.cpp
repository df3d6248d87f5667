// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: vectors are Eigen's: include <passive_haptics/device/eigen_space.hpp>
// ALONE: what it does not include is the mistake
//
// Two and more degrees of freedom are in a header of their own.

#include <passive_haptics/constraint_geometry/half_space.hpp>
#ifdef POSITIVE_CONTROL
#include <passive_haptics/device/eigen_space.hpp>
#endif

namespace ph = passive_haptics;

ph::half_space<ph::space<float, 3>> wall;
