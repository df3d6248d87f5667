// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/reference.hpp"
#include "support/catch.hpp"
#include <passive_haptics/simulation/adversary_worlds.hpp>

#include <algorithm>
#include <cmath>

namespace sim = ph::simulation;
using namespace simulated;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

TEST_CASE("jumping_surface and switching_stiffness change every 20-50 ms",
          "[simulation][adversary]") {
  sim::jumping_surface surface{2e-3, 9};
  sim::switching_stiffness stiffness{100.0, 5000.0, 9};
  int jumps = 0, switches = 0;
  double offset = 0.0, K = 0.0, farthest = 0.0;
  bool other = false;
  for (int n = 0; n < 100000; ++n) {
    const double next = surface.offset(n * 1e-3), next_K = stiffness.stiffness(n * 1e-3);
    farthest = std::max(farthest, std::abs(next));
    other = other || (next_K != 100.0 && next_K != 5000.0);
    jumps += next != offset ? 1 : 0;
    switches += next_K != K ? 1 : 0;
    offset = next;
    K = next_K;
  }
  CHECK(farthest <= 2e-3);
  CHECK(farthest > 1.9e-3);
  CHECK_FALSE(other);
  CHECK_THAT(100.0 / jumps, WithinRel(0.035, 0.05));
  CHECK_THAT(100.0 / switches, WithinRel(0.035, 0.05));
}

TEST_CASE("erratic worlds do what they say", "[adversaries]") {
  sim::random_source random{3};
  const sim::erratic_clock clock{1e-3, true, true};
  sim::erratic_sensor sensor{true};
  int late = 0, lost = 0, in_a_row = 0, longest_gap = 0;
  double shortest = 1.0, longest = 0.0;
  for (int n = 0; n < 20000; ++n) {
    const double period = clock.next(random);
    late += period > 1e-3 ? 1 : 0;
    CHECK_FALSE((period > 1e-3 && period < 2e-3));
    shortest = std::min(shortest, period);
    longest = std::max(longest, period);
    const bool gone = sensor.loses_one(random);
    lost += gone ? 1 : 0;
    in_a_row = gone ? in_a_row + 1 : 0;
    longest_gap = std::max(longest_gap, in_a_row);
  }
  CHECK(shortest >= 0.5e-3);
  CHECK(shortest < 0.501e-3);
  CHECK(longest < 20e-3);
  CHECK(longest > 19e-3);
  CHECK_THAT(late / 20000.0, WithinAbs(0.02, 0.004));
  CHECK_THAT(lost / 20000.0, WithinAbs(0.107, 0.02));
  CHECK(longest_gap >= 5);

  const d3::vector x(0.1, 0.2, 0.3);
  sim::erratic_surface<d3> surface({x, {0, 0, 1}, 5e3}, {.flips = true, .switches = true}, 2e-3,
                                   2e3, 2e4, 1);
  int updates = 0, opposite = 0;
  double deepest = 0.0;
  for (int n = 0; n < 20000; ++n) {
    const d3::vector was = surface.now().normal;
    if (!surface.update(n * 1e-3, x)) continue;
    ++updates;
    opposite += was == -surface.now().normal ? 1 : 0;
    deepest = std::max(deepest, std::abs(surface.now().depth(x)));
    CHECK(surface.now().stiffness >= 2e3);
    CHECK(surface.now().stiffness <= 2e4);
  }
  CHECK_THAT(20.0 / updates, WithinRel(0.011, 0.05));
  CHECK_THAT(double(opposite) / updates, WithinAbs(0.3, 0.05));
  CHECK(deepest <= 2e-3);
  CHECK(deepest > 1.9e-3);
}
