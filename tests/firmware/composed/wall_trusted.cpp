// SPDX-License-Identifier: BSD-3-Clause
#include "scenes.hpp"

[[gnu::flatten]] composed::ph::tick_result<composed::line> composed::wall_trusted_tick(
    wall_trusted& model, real x, real dt) {
  return model.tick(x, ph::seconds{dt});
}
