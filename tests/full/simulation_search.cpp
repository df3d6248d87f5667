// SPDX-License-Identifier: BSD-3-Clause
#include "attacks/several_walls.hpp"
#include <passive_haptics/simulation/search.hpp>

#include <algorithm>

using namespace simulated;

TEST_CASE("the search finds the counterexample A5 on thesis_rule by itself",
          "[adversaries][search]") {
  const double at_random = std::min(sim::challenge(thesis<d1>, by::greedy, {}, 50).mean_energy,
                                    sim::challenge(thesis<d1>, by::nyquist, {}, 50).mean_energy);
  for (const std::uint64_t seed : {1U, 2U}) {
    const sim::search_result found = sim::worst_motion(thesis<d1>, {}, 600, seed);
    CHECK(found.energy < 5.0 * at_random);
    CHECK(found.parameters.press_ticks == 1);  // in by one tick, out at once
    CHECK(found.parameters.hold_ticks == 0);
    CHECK(found.parameters.rest_ticks == 0);
    CHECK(found.evaluations == 600);
    CHECK(sim::worst_motion(thesis<d1>, {}, 600, seed).energy == found.energy);  // repeatable
  }
}

TEST_CASE("the search empties reachable_bound as a velocity source, and strict_bound never",
          "[adversaries][search]") {
  const auto reachable =
      model_of<d1>(ph::spring{}, ph::reachable_bound{.mass = 0.1, .hand_force = 5.0});
  CHECK(sim::worst_motion(reachable, {}, 300).energy < -1.0);
  CHECK(sim::worst_motion(strict<d1>, {}, 1000).energy >= -1e-12);
  CHECK(sim::worst_motion(strict<d3>, {}, 500).energy >= -1e-12);
  CHECK(sim::worst_motion(strict<d1>, {.latency = 1}, 300).energy < -1e-6);  // it is not blind
}

TEST_CASE("the search with a limited force finds nothing in reachable_bound unless it was misled",
          "[adversaries][search]") {
  const auto told = [](double mass, double force) {
    return model_of<d1>(ph::spring{}, ph::reachable_bound{.mass = mass, .hand_force = force});
  };
  CHECK(sim::worst_push(told(0.1, 5.0), {}, 300).energy >= -1e-12);
  CHECK(sim::worst_push(told(0.3, 5.0), {}, 300).energy < -1e-3);
  CHECK(sim::worst_push(told(0.1, 5.0), {.hand_force = 20.0}, 300).energy < -1e-4);
  CHECK(sim::worst_push(thesis<d1>, {}, 300).energy < -1e-6);
  CHECK(sim::worst_push(strict<d1>, {}, 300).energy >= -1e-12);
}

TEST_CASE("the search takes several contacts, and what lays surfaces on them",
          "[adversaries][search]") {
  const lay_walls<d1, 2> lay{arrangement::facing};
  CHECK(sim::worst_motion(one_port<d1, 2>(), {}, 200, 1, lay).energy >= -1e-12);
  CHECK(sim::worst_motion(model_each<d1, 2>{0.03}, {}, 200, 1, lay).energy < -1e-3);
  CHECK(sim::worst_push(one_port<d1, 2>(), {}, 50, 1, lay).energy >= -1e-12);
}
