// SPDX-License-Identifier: BSD-3-Clause
// A corner of two planes that the environment moves, in 3 degrees of freedom.
#include "scene.hpp"

using corner = with_source<ph::contact_set<ph::frictionless, ph::slots<plane, 2>>>;

[[gnu::flatten]] ph::tick_result<solid> corner_tick(corner& model, const solid::vector& x,
                                                    float dt) {
  return model.tick(x, ph::seconds{dt});
}
