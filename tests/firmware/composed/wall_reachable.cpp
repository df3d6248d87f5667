// SPDX-License-Identifier: BSD-3-Clause
#include "scenes.hpp"

[[gnu::flatten]] composed::ph::tick_result<composed::line> composed::wall_reachable_tick(
    wall_reachable& model, real x, real dt) {
  return model.tick(x, ph::seconds{dt});
}
