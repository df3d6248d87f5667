// SPDX-License-Identifier: BSD-3-Clause
// SAYS: write make_touch<Space>\(\{.mass, .damping, .force_limit, .longest_tick\}, \{.force = hand_force\}\)
//
// 0.1's touch, which had one description for the device and the hand.

#include <passive_haptics/compositions.hpp>

namespace ph = passive_haptics;
using scene = ph::space<double, 1>;

class hand_loop {
  ph::touch<scene> touch_ = ph::make_touch<scene>(
      {.mass = 0.1, .damping = 0.03, .hand_force = 5.0, .force_limit = 9.0}, 0.0011);

 public:
  double force(double x, ph::seconds<double> dt) { return touch_.tick(x, dt).force; }
};
double used() {
  return hand_loop{}.force(0.0, ph::seconds{1e-3});
}
