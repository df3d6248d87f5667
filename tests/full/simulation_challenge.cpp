// SPDX-License-Identifier: BSD-3-Clause
// attacks/challenge.cpp at length.
#include "attacks/challenged.hpp"

using namespace simulated;

TEMPLATE_TEST_CASE("strict_bound in float loses no more than its ledger rounds",
                   "[adversaries][law]", f1, f3) {
  survives_all(strict<TestType>, {}, 10, 1e-7);
  for (const sim::verdict& v : sim::challenge_all(unbounded<TestType>, {}, 10)) {
    CAPTURE(to_string(v.by), v.least_energy);
    CHECK(v.least_energy < -1e-4);
  }
}

TEMPLATE_TEST_CASE("force-limited adversaries stay within what reachable_bound assumes",
                   "[adversaries][law]", d1, d3) {
  const auto told = [](double mass, double force) {
    return model_of<TestType>(ph::spring{}, ph::reachable_bound{.mass = mass, .hand_force = force});
  };
  for (const by adversary : sim::all_adversaries) {
    if (!is_force_limited(adversary)) continue;
    for (const sim::circumstances& world :
         {sim::circumstances{}, sim::circumstances{.mass = 0.02, .hand_force = 20.0}}) {
      CAPTURE(to_string(adversary), world.mass);
      const double m = world.mass, F = world.hand_force;
      CHECK(passes(sim::challenge(told(m, F), adversary, world, 60)));
      CHECK(sim::challenge(told(10 * m, 0.0), adversary, world, 60).least_energy < -1e-6);
      CHECK(sim::challenge(thesis<TestType>, adversary, world, 60).least_energy < -1e-6);
    }
  }
  CHECK(sim::challenge(told(0.1, 5.0), by::nyquist, {}, 10).least_energy < -1e-2);
}
