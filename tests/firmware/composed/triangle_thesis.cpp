// SPDX-License-Identifier: BSD-3-Clause
#include "scenes_with_vectors.hpp"

[[gnu::flatten]] composed::ph::tick_result<composed::solid> composed::triangle_thesis_tick(
    triangle_thesis& model, const solid::vector& x, real dt) {
  return model.tick(x, ph::seconds{dt});
}
