// SPDX-License-Identifier: BSD-3-Clause
#include "scenes_with_vectors.hpp"

[[gnu::flatten]] composed::ph::tick_result<composed::solid> composed::plane_reachable_tick(
    plane_reachable& model, const solid::vector& x, real dt) {
  return model.tick(x, ph::seconds{dt});
}
