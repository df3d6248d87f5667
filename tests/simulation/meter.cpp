// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/reference.hpp"
#include "support/catch.hpp"
#include <passive_haptics/simulation/meter.hpp>

#include <cmath>

namespace sim = ph::simulation;
using namespace simulated;
using Catch::Matchers::WithinAbs;

TEST_CASE("port_energy_meter keeps 1e-12 J after 1e7 bookings", "[simulation][meter]") {
  sim::port_energy_meter meter;
  double plain = 0.0;
  meter.book({.damping = 100.0});
  plain += 100.0;
  for (int n = 0; n < 10000000; ++n) {
    meter.book({.damping = 1e-10});
    plain += 1e-10;
  }
  CHECK_THAT(meter.value(), WithinAbs(100.001, 1e-13));
  CHECK(std::abs(plain - 100.001) > 1e-12);  // control: a plain sum does not
}

TEST_CASE("port_energy_meter remembers the least energy, and never hides NaN",
          "[simulation][meter]") {
  sim::port_energy_meter meter;
  meter.book({.actuator = 2.0});
  meter.book({.damping = 5.0});
  CHECK(meter.value() == 3.0);
  CHECK(meter.minimum() == -2.0);
  sim::port_energy_meter broken;
  broken.book({.damping = 1.0});
  CHECK(broken.minimum() >= -1e-12);
  broken.book({.damping = not_a_number});
  broken.book({.damping = 1.0});
  CHECK_FALSE(broken.minimum() >= -1e-12);
}
