// SPDX-License-Identifier: BSD-3-Clause
// The swing by itself: what moves a device shows its mass, damping, friction, load and latency.
#include "support/catch.hpp"
#include "support/one_experiment.hpp"
#include <passive_haptics/identification/swing_experiment.hpp>

#include <string>

using identification::axis_found;
using identification::axis_record;
using identification::swing_experiment;

TEST_CASE("a swing alone finds the motion of a device, with no more force than stated",
          "[identification]") {
  rubbing<sim::slider_and_spring> device(grip, {}, rubs);
  axis_record seen;
  swing_experiment swing({.force = 2.0});
  CHECK(run(device, seen, swing) <= 2.0);
  REQUIRE(swing.done());
  REQUIRE(swing.problem() == nullptr);
  CHECK(swing.force() <= 2.0);
  CHECK(swing.force() > 3.0 * 0.2 + 2.0 * 0.2);  // beyond load and friction
  axis_found found;
  swing.state(found);
  CHECK(found.mass <= 0.1);
  CHECK(found.mass > 0.09);
  CHECK(found.damping <= 0.3);
  CHECK(found.damping_max >= 0.3);
  CHECK(std::abs(found.likely_friction - 0.2) < 0.02);
  CHECK(std::abs(found.load - 0.2) < 0.02);
  CHECK(found.latency == 1);
  CHECK(found.friction == 0.0);  // no part of a swing
}

TEST_CASE("a swing that does not come about ends with a sentence and no force",
          "[identification]") {
  auto stuck = rubs;
  stuck.level = {5.0};
  rubbing<sim::slider_and_spring> device(grip, {}, stuck);
  axis_record seen;
  swing_experiment swing({.force = 2.0});
  run(device, seen, swing);
  REQUIRE(swing.problem() != nullptr);
  CHECK(std::string(swing.problem()).find("hardly moves") != std::string::npos);
  CHECK(swing.tick(seen) == 0.0);
}

TEST_CASE("a swing that is stopped in any of its phases ends within seconds", "[identification]") {
  for (const double from : {2.0, 10.0}) {  // while it is shaken, and while it sweeps
    CAPTURE(from);
    rubbing<sim::slider_and_spring> device(grip, {}, rubs);
    axis_record seen;
    swing_experiment swing({});
    double force = 0.0, held = 0.0, time = 0.0;
    for (; !swing.done() && time < 60.0; time += 1e-3) {
      const auto sample = device.exchange(force);
      if (time < from) held = sample.position;
      seen.book(held, sample.dt, false);
      force = swing.tick(seen);
      seen.commanded(force);
    }
    CHECK(time > from);
    CHECK(time < 21.0);
    REQUIRE(swing.problem() != nullptr);
    CHECK(std::string(swing.problem()).find("stopped to swing") != std::string::npos);
    CHECK(force == 0.0);
  }
}

TEST_CASE("an eased relay takes off at most a fifth of its force at a turn", "[identification]") {
  sim::device<d1> device(grip);
  axis_record seen;
  identification::eased_relay relay(2.0, 8e-3);
  relay.expect(0.0, 0.2);
  double force = 0.0, before = 2.0;
  int turns = 0;
  for (int n = 0; n < 3000; ++n) {
    const auto sample = device.exchange(force);
    seen.book(sample.position, sample.dt, false);
    force = relay.tick(seen, 8e-3, 0.5);
    CHECK(std::abs(force) >= 0.8 * before);
    if (std::abs(force) != before) {
      CHECK(turns != relay.sweeps());
      turns = relay.sweeps();
    }
    before = std::abs(force);
  }
  CHECK(before == 0.5);
}
