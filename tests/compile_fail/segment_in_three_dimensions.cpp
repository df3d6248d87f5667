// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: constraints not satisfied.*dof.? == 2.*evaluated to
//
// A segment has two dimensions; in three there is triangle.

#include <passive_haptics/constraint_geometry/segment.hpp>

namespace ph = passive_haptics;

#ifdef POSITIVE_CONTROL
constexpr int dof = 2;
#else
constexpr int dof = 3;
#endif
ph::segment<ph::space<float, dof>> edge;
