// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: contact_manifold has more places than the source has slots for a surface of this kind
//
// What brings surfaces into slots has no more places than there are slots.

#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/contact/contact_set.hpp>
#include <passive_haptics/contact/manifold.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;
using wall = ph::half_space<scene>;
#ifdef POSITIVE_CONTROL
constexpr int places = 2;
#else
constexpr int places = 3;
#endif

ph::contact_set set{ph::proxy_spring{.mass = 0.1}, ph::pursuit{}, ph::slots<wall, 2>{}};
ph::part_at<decltype(set), scene> walls(set);
ph::contact_manifold<wall, places> seen;
int taken = seen.show(walls, {}, 0.0F).taken();
