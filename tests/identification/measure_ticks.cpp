// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/identification/measure_ticks.hpp>

using Catch::Matchers::WithinRel;

TEST_CASE("the longest tick that was measured is one that a loop can be told", "[loop_limits]") {
  ph::tick_lengths ticks;
  CHECK(ticks.count() == 0);
  CHECK(ticks.longest() == 0.0);
  CHECK(ticks.mean() == 0.0);
  CHECK(ph::loop_limits{.longest_tick = ticks.longest()}.check());  // nothing was measured
  for (const double dt : {1e-3, 0.9e-3, 1.4e-3, 1.1e-3}) ticks.book(dt);
  CHECK(ticks.count() == 4);
  CHECK(ticks.longest() == 1.4e-3);
  CHECK(ticks.shortest() == 0.9e-3);
  CHECK_THAT(ticks.mean(), WithinRel(1.1e-3, 1e-12));
  CHECK_FALSE(ph::loop_limits{.longest_tick = ticks.longest()}.check());
}

TEST_CASE("what a clock says that is no length of a tick is counted and left out",
          "[loop_limits]") {
  ph::tick_lengths ticks;
  ticks.book(1e-3);
  for (const double bad : {0.0, -1e-3, std::nan(""), HUGE_VAL}) ticks.book(bad);
  CHECK(ticks.count() == 1);
  CHECK(ticks.refused() == 4);
  CHECK(ticks.longest() == 1e-3);
  CHECK(ticks.shortest() == 1e-3);
}
