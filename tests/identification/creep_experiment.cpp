// SPDX-License-Identifier: BSD-3-Clause
// Creep by itself: friction that comes back is stated, friction that drifts is not.
#include "support/catch.hpp"
#include "support/one_experiment.hpp"
#include <passive_haptics/identification/creep_experiment.hpp>

using identification::axis_found;
using identification::axis_record;
using identification::creep_experiment;
using identification::friction_ramp;
using identification::parking;

namespace {

/// What `count` ramps would tell of a spring of 75 µm/N that slips at 0.2 N, both ways, or at `least` in every other place.
friction_ramp ramps(int count = 8, double least = 0.2) {
  friction_ramp ramp;
  ramp.begin_all(0.2);
  for (int n = 0; n < count; ++n) {
    const int way = n % 2 == 0 ? 1 : -1;
    const double slips = n / 2 % 2 == 0 ? 0.2 : least;
    ramp.begin(way, 0.0);
    for (double g = 0.0; g < slips; g += 0.5e-3) (void)ramp.book(g, way * 75e-6 * g, 1e-3);
    ramp.conclude(slips, 0.25e-3, true, {.rate = 1e-6, .mass = 0.1, .damping = 0.3, .step = 10e-6});
  }
  return ramp;
}

/// The experiment on a device with that friction, from rest, for positions that are known to `step` [m].
axis_found crept(auto friction, double likely_presliding = 15e-6, double step = 0.0) {
  rubbing<decltype(friction)> device(grip, {}, friction);
  axis_record seen;
  parking it(0.1, 0.2, 8e-3);
  seen.book(device.exchange(0.0).position, 1e-3, false);
  it.begin(0.0);
  run(
      device, seen, it, [&] { return it.parked() || it.problem() != nullptr; }, 10000);
  REQUIRE(it.parked());
  creep_experiment creep({}, motion_of_grip(), ramps(), it, seen.step(), 20.0);
  CHECK(run(device, seen, creep) < 0.2 + 0.2);  // below break-away, beside the load
  REQUIRE(creep.done());
  CHECK(creep.problem() == nullptr);
  axis_found found;
  found.likely_presliding = likely_presliding;
  creep.state(found, step > 0.0 ? step : seen.step());
  return found;
}

}  // namespace

TEST_CASE("friction that comes back after every cycle is stated, below break-away",
          "[identification]") {
  const auto found = crept(rubs);
  CHECK(found.remark == nullptr);
  CHECK(found.creep >= 0.6);
  CHECK(found.friction <= 0.2);
  CHECK(found.friction > 0.6 * 0.95 * 0.19 * 0.99);
}

TEST_CASE("friction that drifts at every level is not stated", "[identification]") {
  const auto found = crept(sim::lugre_friction{0.2, 0.26, 5e-3, 30e-6, 0.0, 0.0});
  CHECK(found.friction == 0.0);
  CHECK(found.remark != nullptr);
}

TEST_CASE("friction that differs too much from place to place is refused before any cycle",
          "[identification]") {
  auto uneven = ramps();
  uneven.begin(1, 0.0);
  for (double g = 0.0; g < 0.015; g += 0.5e-3) (void)uneven.book(g, 75e-6 * g, 1e-3);
  uneven.conclude(0.015, 0.25e-3, true, {.rate = 1e-6, .mass = 0.1, .damping = 0.3, .step = 10e-6});
  const creep_experiment creep({}, motion_of_grip(), uneven, {}, 10e-6, 20.0);
  CHECK(creep.done());
  CHECK(creep.problem() != nullptr);
  const creep_experiment even({}, motion_of_grip(), ramps(), {}, 10e-6, 20.0);  // the control
  CHECK_FALSE(even.done());
}

TEST_CASE("of friction that differs from place to place less is stated where few ramps have met it",
          "[identification]") {
  const creep_experiment few({}, motion_of_grip(), ramps(8, 0.07), {}, 10e-6, 20.0);
  CHECK(few.done());
  CHECK(few.problem() != nullptr);
  const creep_experiment many({}, motion_of_grip(), ramps(24, 0.07), {}, 10e-6,
                              20.0);  // the control
  CHECK_FALSE(many.done());
}

TEST_CASE("steps that know a presliding badly tell nothing of creep", "[identification]") {
  const double step = 40e-6;
  CHECK(crept(rubs, 0.375 * step, step).creep == 0.6);
  CHECK(crept(rubs, 0.75 * step, step).creep == 1.0);  // the control
}
