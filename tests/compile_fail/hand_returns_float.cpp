// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the hand does not model hand_for
//
// A hand is simulated in double, whatever the scalar of the device.

#include <passive_haptics/simulation/device.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

#ifdef POSITIVE_CONTROL
using number = double;
#else
using number = float;
#endif

struct mine : ph::simulation::no_hand<scene> {
  constexpr number force(double /*t*/, double /*x*/, double /*v*/) const noexcept { return 0; }
};
ph::simulation::device<scene, mine> device;
