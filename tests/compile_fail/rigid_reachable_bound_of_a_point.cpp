// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: rigid_reachable_bound knows the inertia of a handle that moves and turns
//
// A point in space has one mass.

#include <passive_haptics/force_bound/rigid_reachable_bound.hpp>

namespace ph = passive_haptics;

#ifdef POSITIVE_CONTROL
using device = ph::rigid_body<float>;
#else
using device = ph::space<float, 3>;
#endif
ph::part_at<ph::rigid_reachable_bound, device> bound({});
