// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: contact_set has no slots<Surface, Count> for a surface of this kind, or two of them
//
// A set is told surfaces of the kinds that it has room for.

#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/contact/contact_set.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

struct other_wall : ph::half_space<scene> {};
#ifdef POSITIVE_CONTROL
using told = ph::half_space<scene>;
#else
using told = other_wall;
#endif

ph::contact_set set{ph::proxy_spring{.mass = 0.1}, ph::pursuit{},
                    ph::slots<ph::half_space<scene>, 2>{}};
ph::part_at<decltype(set), scene> walls(set);
bool taken = walls.update(0, told{});
