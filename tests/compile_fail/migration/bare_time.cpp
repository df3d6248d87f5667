// SPDX-License-Identifier: BSD-3-Clause
// SAYS: passive_haptics: say what dt is
// GONE: such a number was a position, a force or a time
//
// A tick of 0.1, whose dt was a number.

#include <passive_haptics/compositions.hpp>

namespace ph = passive_haptics;
using scene = ph::space<double, 1>;

double used(double x, double dt) {
  auto touch =
      ph::make_touch<scene>({.mass = 0.1, .damping = 0.03, .force_limit = 9.0}, {.force = 5.0});
  return touch.tick(x, dt).force;
}
