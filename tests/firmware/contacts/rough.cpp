// SPDX-License-Identifier: BSD-3-Clause
// A rough plane that the environment moves, in 3 degrees of freedom.
#include "scene.hpp"

using rough = with_source<ph::contact_set<ph::stick_slip, ph::slots<plane, 1>>>;

[[gnu::flatten]] ph::tick_result<solid> rough_tick(rough& model, const solid::vector& x, float dt) {
  return model.tick(x, ph::seconds{dt});
}
