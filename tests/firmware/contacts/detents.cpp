// SPDX-License-Identifier: BSD-3-Clause
// make_detents of a knob: detents and end stops.
#include "one.hpp"

using knob = ph::knob<line, ph::loop_limits, ph::exact_device, ph::trusted_hand>;

// Composed as a constant, the parameters are floats before the program runs.
constexpr knob with_24_detents = ph::make_detents<line>(
    motor, fingers,
    {.pitch = 0.2618, .stiffness = 0.1, .first = -2, .last = 2, .stop_stiffness = 0.5});
static_assert(!with_24_detents.check());

[[gnu::flatten]] float knob_tick(knob& model, float x, float dt) {
  return model.tick(x, ph::seconds{dt}).force;
}
