// SPDX-License-Identifier: BSD-3-Clause
// What lies between a command and the motors, and between the truth and the encoders.
#include "simulation/reference.hpp"
#include "support/catch.hpp"
#include <passive_haptics/simulation/device.hpp>

#include <cmath>
#include <limits>

namespace sim = ph::simulation;
using namespace simulated;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

TEST_CASE("device holds the force of tick n in interval n + latency", "[simulation][device]") {
  const int latency = GENERATE(0, 1, 3, 8);
  sim::device<line> device{{.latency = latency}};
  for (int n = 0; n < 50; ++n) {
    const double wanted = n >= latency ? 0.1 * (n - latency + 1) : 0.0;
    const double speed = device.velocity();
    const ph::device_sample<line> sample = device.exchange(0.1 * (n + 1));
    CHECK(sample.held == wanted);
    CHECK(sample.dt == 1e-3);
    CHECK(sample.valid);
    const reference moved = solve(0.1, 0.03, wanted, speed, 1e-3);
    CHECK_THAT(device.velocity(), WithinAbs(double(moved.velocity), 1e-14));
  }
  CHECK_THAT(device.time(), WithinRel(0.05, 1e-15));
}

TEMPLATE_TEST_CASE("device holds the saturated force, and says so", "[simulation][device]",
                   (ph::space<float, 3>), room) {
  using vector = typename TestType::vector;
  using scalar = typename TestType::scalar;
  sim::device<TestType> device{{.force_limit = 9.0}};
  const vector asked(scalar(30), scalar(-40), scalar(120));
  const vector held = device.exchange(asked).held;
  CHECK_THAT(double(held.norm()), WithinRel(9.0, 1e-6));
  CHECK((held.normalized() - asked.normalized()).norm() < scalar(1e-6));
  const vector small(scalar(1), scalar(2), scalar(-3));
  CHECK(vector(device.exchange(small).held) == small);
  SECTION("a finite force whose norm overflows keeps its direction") {
    const scalar huge = std::numeric_limits<scalar>::max();
    const vector limited = device.exchange(vector(huge, huge, scalar(0))).held;
    CHECK_THAT(double(limited.norm()), WithinRel(9.0, 1e-6));
  }
}

TEST_CASE("device saturates one axis at exactly the limit", "[simulation][device]") {
  sim::device<line> device{{.force_limit = 9.0}};
  CHECK(device.exchange(10.0).held == 9.0);
  CHECK(device.exchange(-1e300).held == -9.0);
  CHECK(device.exchange(8.0).held == 8.0);
}

TEST_CASE("device holds zero instead of a command that is no number", "[simulation][device]") {
  sim::device<line> device{{.force_limit = 9.0}};
  for (const double bad : {not_a_number, infinity, -infinity}) {
    const ph::device_sample<line> sample = device.exchange(bad);
    CHECK(sample.held == 0.0);
    CHECK(sample.position == 0.0);
    CHECK(sample.valid);
  }
  CHECK(device.exchange(1.0).position > 0.0);  // control: a good one moves it
  sim::device<room> three;
  CHECK(room::vector(three.exchange({1.0, not_a_number, 0.0}).held) == room::zero());
}

TEST_CASE("device floors what it measures and meters what is true", "[simulation][device]") {
  sim::device<line> device{{.quantum = 60e-6, .start = -0.001, .start_velocity = 0.0377}};
  bool off_grid = false;
  for (int n = 0; n < 100; ++n) {
    const double seen = device.exchange(0.1).position;
    const double steps = seen / 60e-6;
    CHECK_THAT(steps, WithinAbs(std::round(steps), 1e-9));
    CHECK(seen <= device.position());
    CHECK(seen > device.position() - 60e-6 * (1 + 1e-12));
    off_grid = off_grid || device.position() - seen > 10e-6;
  }
  CHECK(off_grid);
  CHECK_THAT(device.meter().total().actuator, WithinRel(0.1 * (device.position() + 0.001), 1e-12));
}
