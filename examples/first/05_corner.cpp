// SPDX-License-Identifier: BSD-3-Clause
// A corner of three walls, 1 kN/m each: as stiff as one, however many press.
#include "judge.hpp"

using scene = ph::space<double, 3>;
using plane = ph::half_space<scene>;

int main() {
  auto corner = ph::make_contacts<scene>(
      {.mass = 0.1, .damping = 0.1, .force_limit = 9, .longest_tick = 1e-3}, {.force = 5},
      ph::slots<plane, 3>{});
  corner.source().update(0, plane{{0, 0, 0}, {1, 0, 0}, 1000});
  corner.source().update(1, plane{{0, 0, 0}, {0, 1, 0}, 1000});
  corner.source().update(2, plane{{0, 0, 0}, {0, 0, 1}, 1000});

  session<scene> finger({.mass = 0.1, .damping = 0.2, .start = {0.01, 0.01, 0.01}}, 5);
  finger.hold({-0.003, -0.003, -0.01}, 3, [&](const auto& s) { return corner.tick(s).force; });
  const auto said = corner.explain();
  return finger.verdict(corner.source().slot(2).pressed(), said.depth, said.shown);
}
