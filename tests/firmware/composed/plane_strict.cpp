// SPDX-License-Identifier: BSD-3-Clause
#include "scenes_with_vectors.hpp"

[[gnu::flatten]] composed::ph::tick_result<composed::flat> composed::plane_strict_tick(
    plane_strict& model, const flat::vector& x, real dt) {
  return model.tick(x, ph::seconds{dt});
}
