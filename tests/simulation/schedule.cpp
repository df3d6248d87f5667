// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/reference.hpp"
#include "support/catch.hpp"
#include <passive_haptics/simulation/schedule.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace sim = ph::simulation;
using namespace simulated;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

TEST_CASE("update_schedule keeps 20-50 ms, and repeats with its seed", "[simulation][schedule]") {
  sim::update_schedule schedule{42}, twin{42}, other{43};
  std::vector<double> periods;
  double last = 0.0, shortest_polled = infinity, longest_polled = 0.0;
  bool again = false, same = true, differs = false;
  for (int n = 0; n < 2000000; ++n) {
    const double time = n * 1e-3, due = schedule.next();
    const bool now = schedule.due(time);
    again = schedule.due(time) || again;
    same = now == twin.due(time) && same;
    differs = now != other.due(time) || differs;
    if (!now) continue;
    periods.push_back(schedule.next() - due);
    if (n > 0) {
      shortest_polled = std::min(shortest_polled, time - last);
      longest_polled = std::max(longest_polled, time - last);
    }
    last = time;
  }
  CHECK_FALSE(again);  // once per update
  CHECK(same);
  CHECK(differs);
  const auto [least, most] = std::minmax_element(periods.begin(), periods.end());
  CHECK(*least >= 0.020 - 1e-9);
  CHECK(*most <= 0.050 + 1e-9);
  CHECK(*least < 0.0201);
  CHECK(*most > 0.0499);
  CHECK_THAT(2000.0 / double(periods.size()), WithinRel(0.035, 0.01));
  CHECK(shortest_polled >= 0.019 - 1e-9);
  CHECK(longest_polled <= 0.051 + 1e-9);

  SECTION("equal bounds are a fixed period, and a late caller is not flooded") {
    sim::update_schedule fixed{1, 0.02, 0.02};
    CHECK(fixed.due(0.0));
    CHECK_FALSE(fixed.due(0.0199));
    CHECK(fixed.due(0.02));
    CHECK(fixed.due(1.0));
    CHECK_FALSE(fixed.due(1.01));
    CHECK_FALSE(fixed.due(not_a_number));
  }
  CHECK_FALSE(schedule.check());
  CHECK(sim::update_schedule(1, 0.0, 1.0).check());
  CHECK(sim::update_schedule(1, 0.05, 0.02).check());
}

TEST_CASE("one_update_late answers with the update before", "[simulation][schedule]") {
  sim::one_update_late<double> late{7.0};
  CHECK(late(1.0) == 7.0);
  CHECK(late(2.0) == 1.0);
}

TEST_CASE("random_source is the published splitmix64, uniform in every direction",
          "[simulation][schedule]") {
  sim::random_source known{1234567};  // reference values of the authors' C code
  CHECK(known.bits() == 6457827717110365317U);
  CHECK(known.bits() == 3203168211198807973U);
  static_assert(sim::random_source{1}.uniform() >= 0.0 && sim::random_source{1}.uniform() < 1.0);
  sim::random_source random{1};
  room::vector mean = room::zero();
  double squares = 0.0, longest_error = 0.0;
  for (int n = 0; n < 100000; ++n) {
    const room::vector u = random.direction<room>();
    longest_error = std::max(longest_error, std::abs(u.norm() - 1.0));
    mean += u / 100000.0;
    squares += u(2) * u(2) / 100000.0;
  }
  CHECK(longest_error < 1e-15);
  CHECK(mean.norm() < 0.01);
  CHECK_THAT(squares, WithinAbs(1.0 / 3.0, 0.01));
  CHECK(std::abs(random.direction<line>()) == 1.0);
}
