// SPDX-License-Identifier: BSD-3-Clause
// simulation/device.cpp: the limit of a sampled spring, found by bisection.
#include "simulation/reference.hpp"
#include "support/catch.hpp"
#include <passive_haptics/simulation/device.hpp>

namespace sim = ph::simulation;
using namespace simulated;
using Catch::Matchers::WithinRel;

namespace {

/// Does the swing on a sampled, delayed spring grow?
bool grows(double K, double b, int latency) {
  sim::device<line> device{{.damping = b, .start = 0.01, .latency = latency}};
  double force = 0.0;
  const double first = K * 0.01 * 0.01 / 2;
  double energy = first;
  for (int n = 0; n < 400000 && energy < 1e8 * first && energy > 1e-8 * first; ++n) {
    const double x = device.exchange(force).position;
    force = -K * x;
    energy = device.kinetic() + K * x * x / 2;
  }
  return energy > first;
}

}  // namespace

TEST_CASE("device is stable up to K = b/(T/2 + t_d), within 1 %", "[simulation][device][law]") {
  for (const double b : {0.03, 0.1, 0.3}) {
    for (const int latency : {0, 1, 2}) {
      const double theory = b / (0.5e-3 + latency * 1e-3);
      double low = 0.5 * theory, high = 2.0 * theory;
      REQUIRE_FALSE(grows(low, b, latency));
      REQUIRE(grows(high, b, latency));
      while (high - low > 1e-3 * theory) {
        const double middle = (low + high) / 2;
        (grows(middle, b, latency) ? high : low) = middle;
      }
      CAPTURE(b, latency);
      CHECK_THAT(low, WithinRel(theory, 0.01));
    }
  }
}
