// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/reference.hpp"
#include "support/catch.hpp"
#include <passive_haptics/simulation/prescribed_motion.hpp>
#include <passive_haptics/simulation/schedule.hpp>

#include <algorithm>

namespace sim = ph::simulation;
using namespace simulated;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

TEST_CASE("prescribed_motion books exactly b Δx²/T − f·Δx", "[simulation][adversary]") {
  sim::prescribed_motion<room> motion{{.force_limit = 9.0, .latency = 1}};
  sim::random_source random{3};
  double wanted = 0.0, least = 0.0;
  room::vector queued = room::zero();
  for (int n = 0; n < 1000; ++n) {
    const room::vector step = random.direction<room>() * random.uniform(0.0, 1e-3);
    const room::vector force = random.direction<room>() * random.uniform(0.0, 9.0);
    motion.move_to(motion.position() + step);
    const room::vector held = motion.exchange(force).held;
    CHECK(held == queued);
    wanted += 0.03 * step.squaredNorm() / 1e-3 - queued.dot(step);
    least = std::min(least, wanted);
    queued = force;
  }
  CHECK_THAT(motion.meter().value(), WithinAbs(wanted, 1e-14));
  CHECK_THAT(motion.meter().minimum(), WithinAbs(least, 1e-14));
  CHECK_THAT(motion.meter().residual(0.0), WithinAbs(0.0, 1e-14));
}

TEST_CASE("a watchdog drops the force of a prescribed motion part of the way", "[simulation]") {
  sim::prescribed_motion<d1> motion{{.friction = 0.5, .watchdog = 1e-3}};
  motion.move_to(2e-3);
  CHECK(motion.exchange(3.0).held == 3.0);  // a period equal to it does not trip it
  CHECK_THAT(motion.meter().value(), WithinRel(0.03 * 4e-6 / 1e-3 - 3.0 * 2e-3, 1e-12));
  CHECK_THAT(motion.meter().total().friction, WithinRel(0.5 * 2e-3, 1e-12));

  const double before = motion.meter().value();
  motion.set_period(4e-3);
  motion.move_to(6e-3);
  const auto sample = motion.exchange(3.0);
  CHECK(sample.held == 3.0);  // what was commanded
  CHECK(sample.dt == 4e-3);
  CHECK_THAT(motion.meter().value() - before,
             WithinRel(0.03 * 16e-6 / 4e-3 - 3.0 * 4e-3 / 4.0, 1e-9));

  const double halfway = motion.meter().value();
  motion.move_via(11e-3, 5e-3);  // out while the force lasts, and back
  motion.exchange(3.0);
  CHECK_THAT(motion.meter().value() - halfway,
             WithinRel(0.03 * 25e-6 / 1e-3 + 0.03 * 36e-6 / 3e-3 - 3.0 * 5e-3, 1e-9));
  CHECK(motion.position() == 5e-3);
  CHECK_THAT(motion.meter().residual(0.0), WithinAbs(0.0, 1e-15));

  const double there = motion.meter().value();
  motion.move_via(1.0, 6e-3);  // on time, the way round means nothing
  motion.set_period(1e-3);
  motion.exchange(3.0);
  CHECK_THAT(motion.meter().value() - there, WithinRel(0.03 * 1e-6 / 1e-3 - 3e-3, 1e-9));
  CHECK(sim::device_parameters<d1>{.watchdog = 0.0}.check());
}
