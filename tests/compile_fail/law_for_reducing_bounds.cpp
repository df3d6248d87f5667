// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: a law for bounds that only reduce
//
// per_axis_bound may turn a force, so it answers with another one and not with a share.

#include <passive_haptics/force_bound/strict_bound.hpp>
#include <passive_haptics/laws.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

#ifdef POSITIVE_CONTROL
using bound = ph::strict_bound;
#else
using bound = ph::per_axis_bound;
#endif
bool reduces = ph::laws::scales_down<scene>(bound{});
