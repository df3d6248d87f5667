// SPDX-License-Identifier: BSD-3-Clause
// make_guard of a knob: a torque of one's own.
#include "one.hpp"

using guard = ph::force_guard<line, ph::loop_limits, ph::exact_device, ph::trusted_hand>;

[[gnu::flatten]] float guard_tick(guard& model, float x, float dt, float wanted) {
  return model.tick(x, ph::seconds{dt}, wanted).force;
}
