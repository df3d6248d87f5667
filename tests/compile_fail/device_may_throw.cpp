// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: constraints not satisfied.*exchange
//
// exchange() is called in a loop that nothing may leave.

#include <passive_haptics/identification/measure_latency.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

#ifdef POSITIVE_CONTROL
constexpr bool quiet = true;
#else
constexpr bool quiet = false;
#endif

struct mine {
  ph::device_sample<scene> exchange(float /*force*/) noexcept(quiet) { return {}; }
};
mine device;
int ticks = ph::measure_latency<scene>(device).ticks;
