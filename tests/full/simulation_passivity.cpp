// SPDX-License-Identifier: BSD-3-Clause
// attacks/passivity.cpp at length. PASSIVE_HAPTICS_RUNS sets the number of adversarial runs (default
// 10 000).
#include "simulation/attacks.hpp"
#include "support/catch.hpp"

#include <cstdlib>

using namespace simulated;

namespace {

int adversarial_runs() {
  const char* asked = std::getenv("PASSIVE_HAPTICS_RUNS");
  return asked != nullptr ? std::atoi(asked) : 10000;
}

}  // namespace

TEST_CASE("strict_bound never loses energy to any adversary in 1, 2 and 3 dimensions (A6, A11)",
          "[passivity]") {
  const auto smooth = composed(ph::shaped{ph::spring{}, ph::force_rate_limit{.rate = 100}},
                               ph::bound_chain{ph::strict_bound{}, ph::actuator_limit{.most = 9}});
  CHECK(worst_of(composed(ph::spring{}, ph::strict_bound{}), adversarial_runs(), {}) >= -1e-12);
  CHECK(worst_of(smooth, adversarial_runs() / 10, {}) >= -1e-12);
}

TEST_CASE("strict_bound with latency survives it, without it does not (§ 3)", "[passivity]") {
  const int runs = std::max(adversarial_runs() / 10, 12);
  const auto strict = composed(ph::spring{}, ph::strict_bound{});
  const auto after_2 =
      composed(ph::spring{}, ph::strict_bound{},
               ph::late_loop_limits<2>{.longest_tick = 1e-3, .top_speed = 100.0, .watchdog = 1e-3});
  const auto after_5 =
      composed(ph::spring{}, ph::strict_bound{},
               ph::late_loop_limits<5>{.longest_tick = 1e-3, .top_speed = 100.0, .watchdog = 1e-3});
  CHECK(worst_of(after_2, runs, {.latency = 2}) >= -1e-12);
  CHECK(worst_of(after_5, runs, {.latency = 5}) >= -1e-12);
  CHECK(worst_of(strict, runs, {.latency = 2}) < -1e-6);  // the controls
  CHECK(worst_of(strict, runs, {.latency = 5}) < -1e-6);
}

TEST_CASE("reachable_bound and strict_bound stay passive through samples that are lost",
          "[passivity]") {
  const ph::late_loop_limits<2> late{.longest_tick = 1e-3, .top_speed = 100.0, .watchdog = 1e-3};
  const ph::reachable_bound reachable{.mass = 0.1, .hand_force = 5.0};
  CHECK(worst_with_lost_samples(ph::spring{}, reachable, thesis_loop, 200) >= -1e-12);
  CHECK(worst_with_lost_samples(ph::spring{}, ph::strict_bound{}, thesis_loop, 200) >= -1e-12);
  CHECK(worst_with_lost_samples(ph::spring{}, ph::strict_bound{}, late, 200) >= -1e-12);
  CHECK(worst_with_lost_samples(thesis_spring, ph::no_bound{}, thesis_loop, 200) <
        -1e-6);  // the control
}
