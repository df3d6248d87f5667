// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: a scope keeps two ticks or more
//
// Half of them are before the event that freezes it.

#include <passive_haptics/runner/scope.hpp>

namespace ph = passive_haptics;

#ifdef POSITIVE_CONTROL
constexpr std::size_t ticks = 2;
#else
constexpr std::size_t ticks = 1;
#endif
ph::scope<ph::space<float, 1>, ticks> last_ticks;
