// SPDX-License-Identifier: BSD-3-Clause
// Bounds on quantised_energy: motions within the steps of the encoders, a tapping hand, a loan.
#include "energy_observer/stepped.hpp"
#include "support/catch.hpp"

namespace {

/// Taps with 5 N on a device whose encoders have steps, the surface jumping; least port energy.
template <class Observer, class Bound>
double tapped(const Observer& observer, const Bound& bound, std::uint64_t seed) {
  auto model = following_half_space<d1>(ph::spring{}, observer, bound);
  (void)model.update(wall<d1>(1e4));
  sim::device<d1, sim::tapping_hand<d1>> device(
      {.mass = 0.1, .quantum = step, .start = -1e-5 * static_cast<double>(seed)},
      {.surface = 0.0, .normal = -1.0, .limit = 5.0});
  sim::random_source random(seed);
  auto sample = device.exchange(0.0);
  for (int n = 0; n < 3000; ++n) {
    if (seed > 10 && n % 40 == 0) (void)model.update({random.uniform(-1e-3, 1e-3), -1.0, 1e4});
    sample = device.exchange(model.tick(sample).force);
  }
  return device.meter().minimum();
}

}  // namespace

TEST_CASE("quantised_energy never exceeds the true port energy in two dimensions either",
          "[quantised]") {
  const auto [worst, plain] = overstatements<d2>();
  CHECK(worst <= 1e-12);
  CHECK(plain > 1e-4);  // the control: the ledger that takes the positions for exact
}

TEST_CASE("strict_bound on quantised_energy never loses, on the plain ledger it does (§ 3)",
          "[quantised]") {
  CHECK(worst_attack<d1>(sure(), 60) >= -1e-12);
  CHECK(worst_attack<d2>(sure(), 60) >= -1e-12);
  CHECK(worst_attack<d3>(sure(), 60) >= -1e-12);
  CHECK(worst_attack<d1>(thesis_ledger(), 60) < -1e-5);  // the controls
  CHECK(worst_attack<d1>(sure(step / 3), 60) < -1e-7);   // a step stated too fine
}

TEST_CASE("reachable_bound on quantised_energy survives a tapping hand, not on the plain ledger",
          "[quantised]") {
  const ph::reachable_bound bound{.mass = 0.1, .hand_force = 5.0};
  double control = 0.0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    CHECK(tapped(sure(), bound, seed) >= -1e-12);
    control = std::min(control, tapped(thesis_ledger(), bound, seed));
  }
  CHECK(control < -1e-6);
}

TEST_CASE("the loan of quantised_energy is what it may lose, and no more", "[quantised]") {
  auto lent = sure();
  lent.loan = 2e-3;
  double worst = 0.0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    worst = std::min(worst, attacked<d1>(lent, sim::greedy_motion<d1>{.speed = 0.5}, seed));
  }
  CHECK(worst >= -2e-3 - 1e-12);
  CHECK(worst < -1e-3);
}
