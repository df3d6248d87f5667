// SPDX-License-Identifier: BSD-3-Clause
// The same organ with a fissure, 6 mm deep, told as the triangles around the finger: dents and edges are kept.
#include "organ.hpp"
#include <passive_haptics/environment/contact_surface.hpp>

int main() {
  auto touch = ph::make_contacts<scene>(
      {.mass = 0.1, .damping = 0.1, .force_limit = 9, .longest_tick = 1e-3}, {.force = 5},
      ph::slots<ph::patch<scene>, 1>{});
  const auto surface_at = [](const organ& body, const env::surface_point& on) {
    return env::patch_at(body.surface(), body.nodes(), on, 500);
  };

  stroke hand(0.006);
  const int untrue = hand.over(
      {.error = 1, .step = 0.1},
      [&](const organ& body, const env::surface_point& on) {  // the slow thread
        touch.source().update(0, surface_at(body, on));
      },
      [&](const auto& sample) { return touch.tick(sample).force; },  // the device's
      [&](const organ& now, const env::surface_point& on, const vector& x) {
        return force_of(surface_at(now, on), x);
      });
  return hand.verdict(touch.explain()) + untrue;
}
