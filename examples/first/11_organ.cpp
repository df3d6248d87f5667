// SPDX-License-Identifier: BSD-3-Clause
// An organ that breathes, told 30 times a second as the smooth surface through its nodes, and how fast it moves.
#include "organ.hpp"
#include <passive_haptics/environment/contact_surface.hpp>

int main() {
  auto touch = ph::make_touch<scene, ph::quadric<scene>>(
      {.mass = 0.1, .damping = 0.1, .force_limit = 9, .longest_tick = 1e-3}, {.force = 5});
  const auto surface_at = [](const organ& body, const env::surface_point& on) {
    return env::quadric_at(body.surface(), body.nodes(), on, 500, {.thickness = 0.02});
  };

  stroke hand;
  const int untrue = hand.over(
      {.error = 0.5, .step = 0.1},
      [&](const organ& body, const env::surface_point& on) {  // the slow thread
        touch.update(surface_at(body, on), {.velocity = body.velocity(on)});
      },
      [&](const auto& sample) { return touch.tick(sample).force; },  // the device's
      [&](const organ& now, const env::surface_point& on, const vector& x) {
        return force_of(surface_at(now, on), x);
      });
  return hand.verdict(touch.explain()) + untrue;
}
