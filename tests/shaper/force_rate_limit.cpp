// SPDX-License-Identifier: BSD-3-Clause
// force_rate_limit: what passes at once, what passes slowly, and the strict bound behind it.
#include "force_bound/attacks.hpp"
#include "force_bound/upkeep.hpp"
#include <passive_haptics/shaper/force_rate_limit.hpp>

using Catch::Matchers::WithinAbs;

TEST_CASE("force_rate_limit passes the hand's motion and slows the surface's", "[shaper]") {
  const auto shaper = at<d1>(ph::force_rate_limit{.rate = 100.0});  // 0.1 N a tick
  const auto limit = [&](double desired, double local_force) {
    const ph::contact_state<d1> contact{.normal = -1,
                                        .stiffness = 1e4,
                                        .depth = 0,
                                        .target_depth = 1e-3,
                                        .local_force = local_force,
                                        .target_changed = false};
    return allowed(shaper, desired, contact, situation<d1>{.energy = 1.0});
  };
  // the hand took it to 2 N: at once
  CHECK_THAT(limit(-3.0, 2.0), WithinAbs(-2.1, 1e-15));
  CHECK_THAT(limit(-2.05, 2.0), WithinAbs(-2.05, 1e-15));
  CHECK_THAT(limit(0.0, 2.0), WithinAbs(-1.9, 1e-15));
  CHECK(limit(0.0, 0.05) == 0.0);
}

TEST_CASE("a bound behind force_rate_limit keeps its promise, without one there is none",
          "[shaper][passivity]") {
  const ph::shaped slow{ph::spring{}, ph::force_rate_limit{.rate = 100.0}};
  const auto least = [&](const auto& bound) {
    return attacks::worst_of<d1>(attacks::model_of<d1>(bound, thesis_loop, slow), {}, 4).least;
  };
  CHECK(least(ph::strict_bound{}) >= -1e-12);
  CHECK(least(ph::no_bound{}) < -1e-6);
}

TEST_CASE("force_rate_limit takes a new rate and refuses a bad one", "[shaper]") {
  const ph::force_rate_limit first{.rate = 100.0}, faster{.rate = 1000.0}, none{.rate = 0.0};
  check_upkeep(following_half_space<d1>(ph::shaped{ph::spring{}, first}, thesis_ledger(),
                                        ph::strict_bound{}),
               first, faster, none);
}
