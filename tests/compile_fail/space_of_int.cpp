// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: constraints not satisfied.*is_integer
//
// Forces are real numbers.

#include <passive_haptics/device/space.hpp>

namespace ph = passive_haptics;

#ifdef POSITIVE_CONTROL
using number = float;
#else
using number = int;
#endif
ph::space<number, 1> port;
