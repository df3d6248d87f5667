// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: (incomplete type|undefined template).*space<float, 3>
//
// Two and more degrees of freedom are in a header of their own.

#include <passive_haptics/geometry.hpp>
#ifdef POSITIVE_CONTROL
#include <passive_haptics/eigen_space.hpp>
#endif

namespace ph = passive_haptics;

ph::half_space<ph::space<float, 3>> wall;
