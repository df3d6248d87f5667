// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: a law for bounds that only reduce
//
// force_rate_limit may hold a force above the desired one, so it does not claim to reduce.

#include <passive_haptics/bounds.hpp>
#include <passive_haptics/laws.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

#ifdef POSITIVE_CONTROL
using bound = ph::strict_bound<scene>;
#else
using bound = ph::force_rate_limit<scene>;
#endif
bool reduces = ph::laws::scales_down<scene>(bound{});
