// SPDX-License-Identifier: BSD-3-Clause
// make_touch of a knob: an end stop that the environment moves.
#include "one.hpp"

using touch =
    ph::touch<line, ph::half_space<line>, ph::loop_limits, ph::exact_device, ph::trusted_hand>;

[[gnu::flatten]] float touch_tick(touch& model, float x, float dt) {
  return model.tick(x, ph::seconds{dt}).force;
}
