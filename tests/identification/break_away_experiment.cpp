// SPDX-License-Identifier: BSD-3-Clause
// Break-away by itself, and the parking that it begins with.
#include "support/catch.hpp"
#include "support/one_experiment.hpp"
#include <passive_haptics/identification/break_away_experiment.hpp>

#include <string>

using identification::axis_found;
using identification::axis_record;
using identification::break_away_experiment;
using identification::eased_relay;
using identification::parking;

namespace {

break_away_experiment on_grip(const identification::identification_parameters& p) {
  return {p, motion_of_grip(), eased_relay(p.force, p.stroke), 0.5 * p.force};
}

}  // namespace

TEST_CASE("ramps alone find the break-away force from both sides, and presliding from above",
          "[identification]") {
  rubbing<sim::slider_and_spring> device(grip, {}, rubs);
  axis_record seen;
  auto ramps = on_grip({.places = 4});
  CHECK(run(device, seen, ramps) <= 3.0);
  REQUIRE(ramps.done());
  REQUIRE(ramps.problem() == nullptr);
  axis_found found;
  ramps.state(found, seen.step());
  for (const int way : {0, 1}) {
    CHECK(found.breakaway_least[way] <= 0.2);
    CHECK(found.breakaway_least[way] > 0.15);
    CHECK(found.breakaway_most[way] >= 0.2);
    CHECK(found.breakaway_most[way] < 0.3);
  }
  CHECK(found.presliding >= 15e-6);
  CHECK(found.presliding < 45e-6);
  CHECK(found.uneven < 0.1);
}

TEST_CASE("a device that does not break away with the force stated ends it", "[identification]") {
  auto stuck = rubs;
  stuck.level = {0.5};
  rubbing<sim::slider_and_spring> device(grip, {}, stuck);
  axis_record seen;
  auto ramps = on_grip({.force = 0.4});
  CHECK(run(device, seen, ramps) <= 0.4);
  REQUIRE(ramps.problem() != nullptr);
  CHECK(std::string(ramps.problem()).find("does not break away") != std::string::npos);
  CHECK(ramps.tick(seen) == 0.0);
}

TEST_CASE("friction that the swing shows too little of is not looked for", "[identification]") {
  auto motion = motion_of_grip();
  motion.friction = {0.02, 0.01};
  const break_away_experiment ramps({}, motion, eased_relay(3.0, 8e-3), 1.5);
  CHECK(ramps.done());
  CHECK(ramps.problem() != nullptr);
}

TEST_CASE("a device is parked where it shall be, and stays there by its friction",
          "[identification]") {
  rubbing<sim::slider_and_spring> device(grip, {}, rubs);
  axis_record seen;
  parking it(0.1, 0.2, 8e-3);
  seen.book(device.exchange(0.0).position, 1e-3, false);
  it.begin(2e-3);
  run(
      device, seen, it, [&] { return it.parked() || it.problem() != nullptr; }, 10000);
  REQUIRE(it.problem() == nullptr);
  REQUIRE(it.parked());
  CHECK(std::abs(seen.x() - 2e-3) < 0.2 / (0.1 * 37.0 * 37.0));  // friction over the spring, nearly
  CHECK(std::abs(it.place() - seen.x()) <= 10e-6);
}

TEST_CASE("a device that its friction does not hold is parked eight times, then given up",
          "[identification]") {
  auto light = rubs;
  light.level = {0.05};
  rubbing<sim::slider_and_spring> device(grip, {}, light);
  axis_record seen;
  parking it(0.1, 0.0, 8e-3);  // the load is not what it was
  seen.book(device.exchange(0.0).position, 1e-3, false);
  it.begin(0.0);
  run(
      device, seen, it, [&] { return it.parked() || it.problem() != nullptr; }, 60000);
  CHECK_FALSE(it.parked());
  REQUIRE(it.problem() != nullptr);
  CHECK(std::string(it.problem()).find("does not hold") != std::string::npos);
}
