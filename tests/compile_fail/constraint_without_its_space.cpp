// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: deduction (failed|guide)|no viable constructor or deduction guide
//
// Numbers do not tell their space: a constraint, which is data, is told it.

#include <passive_haptics/constraint_geometry/half_space.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

#ifdef POSITIVE_CONTROL
ph::half_space<scene> wall{0, 1, 1000};
#else
ph::half_space wall{0, 1, 1000};
#endif
