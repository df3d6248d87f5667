// SPDX-License-Identifier: BSD-3-Clause
#include "scenes.hpp"

[[gnu::flatten]] composed::ph::tick_result<composed::line> composed::wall_strict_tick(
    wall_strict& model, real x, real dt) {
  return model.tick(x, ph::seconds{dt});
}
