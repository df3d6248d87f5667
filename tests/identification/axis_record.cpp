// SPDX-License-Identifier: BSD-3-Clause
// What is recorded of an axis: a velocity by the measured lengths of ticks, and the samples that are missing.
#include "support/catch.hpp"
#include <passive_haptics/identification/axis_record.hpp>

using Catch::Matchers::WithinRel;
using passive_haptics::identification::axis_found;
using passive_haptics::identification::axis_record;

TEST_CASE("a velocity is the way of the last ticks over their measured lengths",
          "[identification]") {
  axis_record seen;
  double x = 0.5;
  for (int n = 0; n < 40; ++n) {
    const double h = n % 2 == 0 ? 1e-3 : 0.4e-3;
    x += 0.1 * h;
    seen.book(x, h, false);
  }
  for (const int ticks : {1, 6, 24}) CHECK_THAT(seen.velocity(ticks), WithinRel(0.1, 1e-9));
  CHECK_THAT(seen.x() - seen.before(), WithinRel(0.1 * 0.4e-3, 1e-9));
  CHECK(seen.position() == x);
  CHECK(seen.dt() == 0.4e-3);
  axis_found found;
  seen.state(found);
  CHECK(found.longest_tick == 1e-3);
}

TEST_CASE("no velocity spans a sample that is missing", "[identification]") {
  axis_record seen;
  for (int n = 0; n < 20; ++n) seen.book(n * 1e-4, 1e-3, false);
  CHECK_THAT(seen.velocity(6), WithinRel(0.1, 1e-9));  // the control
  seen.interrupt();
  seen.book(1.0, 1e-3, false);
  CHECK(seen.velocity(6) == 0.0);
  seen.book(1.0002, 1e-3, false);
  CHECK_THAT(seen.velocity(6), WithinRel(0.2, 1e-9));
}

TEST_CASE("51 missing samples in a row are too few to go on, or one in twenty of thousands",
          "[identification]") {
  axis_record seen;
  for (int n = 0; n < 50; ++n) seen.interrupt();
  CHECK_FALSE(seen.too_few());
  seen.interrupt();
  CHECK(seen.too_few());
  const auto one_in = [](int every) {
    axis_record of;
    for (int n = 0; n < 10000; ++n) n % every == 0 ? of.interrupt() : of.book(0.0, 1e-3, false);
    return of.too_few();
  };
  CHECK(one_in(18));
  CHECK_FALSE(one_in(24));
}
