// SPDX-License-Identifier: BSD-3-Clause
#include "attacks/challenged.hpp"
#include <passive_haptics/simulation/search.hpp>

#include <cmath>
#include <string>
#include <vector>

using namespace simulated;

namespace {

/// Commands a force that is no number, late.
struct no_number {
  using space_type = d1;
  using constraint_type = ph::half_space<d1>;
  int ticks = 0;
  bool update(const constraint_type& /*next*/) { return true; }
  auto tick(const ph::device_sample<d1>& /*sample*/) {
    return ph::tick_result<d1>{++ticks == 500 ? std::nan("") : 0.0, 0, 0};
  }
};

}  // namespace

TEST_CASE("circumstances that cannot be are no verdict in anyone's favour", "[adversaries]") {
  using world = sim::circumstances;
  CHECK_FALSE(world{}.check());
  for (const world& bad :
       {world{.damping = 0.0}, world{.mass = 0.0}, world{.friction = -1.0},
        world{.hand_force = -1.0}, world{.quantum = -1.0}, world{.longest_tick = 0.0},
        world{.latency = 9}, world{.softest = 0.0}, world{.stiffest = 1.0}, world{.jump = -1.0},
        world{.ticks = 0}, world{.noise = -1.0}, world{.presliding = -1.0},
        world{.noise = world::infinity}}) {
    CHECK(bad.check());
    const sim::verdict v = sim::challenge(strict<d1>, by::greedy, bad, 3);
    CHECK_FALSE(passes(v));
    CHECK(std::isnan(v.least_energy));
    CHECK(std::isnan(sim::worst_motion(strict<d1>, bad, 3).energy));
  }
  CHECK_FALSE(passes(sim::challenge(strict<d1>, by::greedy, {}, 0)));  // no run, no proof
  const sim::verdict lost = sim::challenge(no_number{}, by::random_walk, {}, 3);
  CHECK(std::isnan(lost.least_energy));  // the driver would hold zero, and draw nothing
  CHECK_FALSE(passes(lost));
  CHECK(sim::worst_motion(no_number{}, {}, 2).energy < -1e300);
}

TEST_CASE("every adversary has a name of its own and its place in a list", "[adversaries]") {
  std::vector<by> all(sim::all_adversaries.begin(), sim::all_adversaries.end());
  all.insert(all.end(), sim::encoder_adversaries.begin(), sim::encoder_adversaries.end());
  for (std::size_t i = 0; i < all.size(); ++i) {
    CHECK(static_cast<std::size_t>(all[i]) == i);
    CHECK(std::string(to_string(all[i])) != "unknown adversary");
    for (std::size_t j = 0; j < i; ++j) {
      CHECK(std::string(to_string(all[i])) != to_string(all[j]));
    }
  }
  CHECK(std::string(to_string(static_cast<by>(all.size()))) == "unknown adversary");
}
