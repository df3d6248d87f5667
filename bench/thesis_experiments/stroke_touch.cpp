// SPDX-License-Identifier: BSD-3-Clause
#include "follow_stroke.hpp"
#include <passive_haptics/compositions.hpp>
#include <passive_haptics/environment/contact_surface.hpp>

namespace experiments {

namespace {

constexpr double damping = 0.03;  // [N·s/m]

auto touch() {
  return ph::make_touch<volume>(
      {.mass = 0.1, .damping = damping, .force_limit = 9.0, .longest_tick = 1e-3}, {.force = 5.0});
}

}  // namespace

stroke_result touched_stroke(const stroke_scene& scene, double period) {
  return follow_stroke(touch(), scene, period);
}

stroke_result lent_stroke(const stroke_scene& scene, double period) {
  auto model = touch();
  (void)model.set(ph::reduced_energy{.damping = damping, .loan = loan});
  model.reset();
  return follow_stroke(
      model, scene, period,
      [where = env::ahead()](auto& body, const auto& finger, const auto& force) mutable {
        return env::yielding(body, where, finger, force);
      });
}

}  // namespace experiments
