// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: constraints not satisfied.*dof.? == 3.*evaluated to
//
// A triangle has three dimensions; in two there is segment.

#include <passive_haptics/constraint_geometry/triangle.hpp>

namespace ph = passive_haptics;

#ifdef POSITIVE_CONTROL
constexpr int dof = 3;
#else
constexpr int dof = 2;
#endif
ph::triangle<ph::space<float, dof>> facet;
