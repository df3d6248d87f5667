// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: strict_bound: Latency counts ticks and cannot be negative

#include <passive_haptics/bounds.hpp>

namespace ph = passive_haptics;

#ifdef POSITIVE_CONTROL
constexpr int latency = 1;
#else
constexpr int latency = -1;
#endif
ph::strict_bound<ph::space<float, 1>, latency> bound;
