// SPDX-License-Identifier: BSD-3-Clause
// SAYS: write make_guard<Space>\(\{.mass, .damping, .force_limit, .longest_tick\}, \{.force = hand_force\}\)
//
// The guard of a given force, as 0.1 named it.

#include <passive_haptics/compositions.hpp>

namespace ph = passive_haptics;
using scene = ph::space<double, 1>;

double used(double x, double wanted) {
  static ph::force_guard<scene> guard = ph::make_force_guard<scene>(
      {.mass = 0.1, .damping = 0.03, .hand_force = 5.0, .force_limit = 9.0}, 0.0011);
  return guard.tick(x, ph::seconds{1e-3}, wanted).force;
}
