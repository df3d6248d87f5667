// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the slots are those of the source of a port
//
// A touch is told its one surface, and a set has many, so what was touch.update(plane) is not corner.update(0, plane).

#include <passive_haptics/passive_haptics.hpp>

namespace ph = passive_haptics;
using scene = ph::space<double, 3>;
using plane = ph::half_space<scene>;
auto corner = ph::make_contacts<scene>(ph::exact_device{}, ph::known_hand{}, ph::slots<plane, 3>{});

void use() {
#ifdef POSITIVE_CONTROL
  corner.source().update(0, plane{{0, 0, 0}, {0, 0, 1}, 1000});
#else
  corner.update(0, plane{{0, 0, 0}, {0, 0, 1}, 1000});
#endif
}
