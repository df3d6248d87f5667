// SPDX-License-Identifier: BSD-3-Clause
// What a bound is told of the port.
#include "support/catch.hpp"
#include "support/scenes.hpp"

#include <limits>

using Catch::Matchers::WithinRel;

TEST_CASE("what is in flight is all that was commanded and is not yet held, rounded up (§ 3)",
          "[port]") {
  // f²/(4B) of 2 N and of 3 N, B = 30 N/m; the last one is held already
  const situation<d1, ph::isotropic_damping, 2> late{.energy = 1.0, .commanded = {2.0, -3.0, 50.0}};
  const auto port = late.port();
  CHECK_THAT(port.in_flight(), WithinRel(13.0 / 120.0, 1e-14));
  CHECK(port.in_flight() > 13.0 / 120.0);
  CHECK(port.credit() == 1.0 - port.in_flight());
  CHECK(port.fair_credit() == 1.0 / 3.0);  // as much is left to each of the two after it
  const situation<d1, ph::isotropic_damping, 2> more{.energy = 0.12,
                                                     .commanded = {2.0, -3.0, 50.0}};
  CHECK(more.port().fair_credit() == 0.12 - more.port().in_flight());
  const situation<d1, ph::isotropic_damping, 2> debt{.energy = -0.3, .commanded = {0.0, 0.0, 50.0}};
  CHECK(debt.port().fair_credit() <= -0.3);
  const situation<d1> at_once{.energy = 1.0, .commanded = {50.0}};
  CHECK(at_once.port().in_flight() == 0.0);
  CHECK(at_once.port().fair_credit() == 1.0);
}

TEST_CASE("a port tells what its last tick has brought", "[port]") {
  const situation<d1> pressed{.dt = 2e-3, .held = -1.0, .travel = 1e-3};
  CHECK_THAT(pressed.port().gain(), WithinRel(0.03 * 1e-6 / 2e-3 + 1e-3, 1e-12));
  const situation<d1> left{.dt = 2e-3, .held = -1.0, .travel = -1e-3};
  CHECK_THAT(left.port().gain(), WithinRel(0.03 * 1e-6 / 2e-3 - 1e-3, 1e-12));
}

TEST_CASE("a hand that rests is no leave for a surface to use up the end of the ledger at once",
          "[port]") {
  const auto way = [](double energy, double spent, double travel = 0.0) {
    const situation<d1> pressed{.energy = energy, .dt = 1e-3, .held = -5.0, .travel = travel};
    return pressed.port().paid_way(5.0, 1e-4, 0.05, spent);
  };
  constexpr double any = std::numeric_limits<double>::max();
  CHECK(way(1.0, 0.0) == any);
  CHECK(way(1.01e-3, 0.0) == any);  // 0.1 mm more than what is kept
  CHECK(way(1.01e-3, 1e-4) < any);  // the hand takes as much
  for (const double left : {0.99e-3, 0.6e-3, 0.501e-3, 0.5e-3 + 1e-15}) {
    CHECK_THAT(way(left, 0.0), WithinRel((left / 5.0 - 1e-4) / 50.0, 1e-6));
  }
  CHECK(way(0.5e-3, 0.0) == 0.0);
  CHECK(way(0.1e-3, -1e-6) == 0.0);  // even if it pays
  CHECK(way(-1e-3, 0.0) == 0.0);
  CHECK(way(1.11e-3, 0.0, 1e-5) == any);
  CHECK(way(1.01e-3, 0.0, 1e-5) < any);  // two ticks of the device's way are kept, too

  const auto calm = [](double travel, double spent) {
    const situation<d1> at_end{.energy = 0.6e-3, .dt = 1e-3, .held = -5.0, .travel = travel};
    return at_end.port().paid_way(5.0, 1e-4, 0.05, spent, 1e-4);
  };
  CHECK(calm(0.9e-7, 0.0) < any);
  CHECK(calm(1.1e-7, 0.0) == any);  // at more than 0.1 mm/s it does not rest
  CHECK(calm(-1e-6, 0.0) == any);
  CHECK(calm(1e-6, 1e-4) < any);  // but is limited by a hand that takes as much
}

TEST_CASE("of friction that is elastic 2 c p is put aside for each tick a loop is late (§ 6)",
          "[port]") {
  const ph::damping_and_friction rubs{.coefficient = 0.03, .coulomb = 0.25, .presliding = 1e-3};
  const double aside = 2 * 2 * 0.25 * 1e-3;
  const situation<d1, ph::damping_and_friction, 2> late{
      .damping = ph::part_at<ph::damping_and_friction, d1>(rubs), .energy = 1.0};
  CHECK_THAT(late.port().in_flight(), WithinRel(aside, 1e-12));
  CHECK(late.port().credit() == 1.0 - late.port().in_flight());
  CHECK_THAT(late.port().fair_credit(), WithinRel((1.0 - aside) / 3.0, 1e-12));
  const situation<d1, ph::damping_and_friction, 0> in_time{
      .damping = ph::part_at<ph::damping_and_friction, d1>(rubs), .energy = 1.0};
  CHECK(in_time.port().credit() == 1.0);
}

TEST_CASE("recent ticks are the longest up to T and the shortest from T/4 on", "[port]") {
  ph::recent_ticks<double, false> recent{};
  const auto saw = [&](double dt, double longest, double shortest) {
    recent.see(dt, 1.0);
    CHECK(recent.longest == longest);
    CHECK(recent.shortest == shortest);
  };
  saw(0.5, 0.5, 0.5);
  saw(0.75, 0.75, 0.5);
  saw(0.3, 0.75, 0.3);
  saw(0.1, 0.75, 0.25);
  saw(3.0, 1.0, 0.25);
  saw(0.6, 1.0, 0.25);
}

TEST_CASE("a tick is lost, late or on time", "[port]") {
  situation<d1> now;
  CHECK(now.port().fate() == ph::tick_fate::on_time);  // as long as the longest
  now.dt = 1.1e-3;
  CHECK(now.port().fate() == ph::tick_fate::late);
  now.motion_known = false;
  CHECK(now.port().fate() == ph::tick_fate::lost);
}
