// SPDX-License-Identifier: BSD-3-Clause
// Several walls on one device: in one port they spend its damping once, in a port each they spend it
// as often as there are walls. More runs, and numbers, are in full/simulation_several_walls.cpp.
#include "attacks/several_walls.hpp"

using namespace simulated;

TEMPLATE_TEST_CASE("two walls in one port lose nothing, in a local model each they do",
                   "[adversaries][law]", d1, d3) {
  for (const auto how : two_walls) {
    CAPTURE(static_cast<int>(how));
    survives(attacked<TestType, 2>(one_port<TestType, 2>(), how, 4));
    const losses control = lost(model_each<TestType, 2>{0.03}, how, 4);
    CHECK(control.worst < -1e-4);
    CHECK(control.adversaries >= 4);
  }
}
