// SPDX-License-Identifier: BSD-3-Clause
// SAYS: write make_touch<Space>\(encoder_device\{
//
// 0.2's touch on encoders while it had a name of its own.

#include <passive_haptics/passive_haptics.hpp>

namespace ph = passive_haptics;
using scene = ph::space<double, 3>;

double used() {
  ph::encoder_touch<scene> touch = ph::make_encoder_touch<scene>({.mass = 0.1,
                                                                  .damping = 0.3,
                                                                  .friction = 0.2,
                                                                  .presliding = 15e-6,
                                                                  .quantum = 60e-6,
                                                                  .force_limit = 9.0},
                                                                 5.0);
  return touch.tick({0.0, 0.0, 0.0}, ph::seconds{1e-3}).energy;
}
