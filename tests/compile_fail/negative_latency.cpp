// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: late_loop_limits: Latency counts ticks and cannot be negative
//
// A command is held when it is given, or later.

#include <passive_haptics/port/loop_limits.hpp>

namespace ph = passive_haptics;

#ifdef POSITIVE_CONTROL
constexpr int latency = 1;
#else
constexpr int latency = -1;
#endif
ph::late_loop_limits<latency> limits;
