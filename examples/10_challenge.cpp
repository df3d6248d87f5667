// SPDX-License-Identifier: BSD-3-Clause
// A force bound of your own, thrown at every adversary there is.
//
// This one spends what the next tick would cost if it were like the last one: f·Δx ≤ E1, as many
// tanks do. It is a good guess, and no adversary is obliged to keep to it. strict_bound guesses
// nothing. What each one loses, in the worst of 50 runs of 0.6 s, is told to the nearest decade.

#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/simulation/challenge.hpp>

#include <cmath>
#include <cstdio>

namespace ph = passive_haptics;
namespace sim = ph::simulation;
using scene = ph::space<double, 1>;

struct trusting_bound {
  static constexpr ph::guarantee passivity = ph::guarantee::none;
  static constexpr ph::bound_traits traits{.needs_ledger = true};

  [[nodiscard]] constexpr ph::share<double> limit(double desired,
                                                  const auto& state) const noexcept {
    const double expected = desired * state.travel;  // f·Δx, if it moves on as it did
    if (expected <= state.credit()) return {1.0};
    return {expected > 0.0 && state.credit() > 0.0 ? state.credit() / expected : 0.0};
  }
};

auto wall_with(const auto& bound) {
  // By hand: any bound, to be attacked.
  return ph::local_model{
      scene{},
      ph::followed<ph::half_space<scene>>{},
      ph::turn_at_once{},
      ph::spring{},
      ph::reduced_energy{.damping = 0.03},
      bound,
      ph::loop_limits{.longest_tick = 1e-3, .watchdog = 1e-3}};  // the driver drops a force then
}

void tell(const sim::verdict& v) {
  if (passes(v)) return static_cast<void>(std::printf("%16s", "passive"));
  std::printf("    loses 1e%+.0f J", std::round(std::log10(-v.least_energy)) + 0.0);
}

int main() {
  const sim::circumstances truth{.damping = 0.03, .mass = 0.1, .hand_force = 5.0};
  const auto mine = sim::challenge_all(wall_with(trusting_bound{}), truth, 50);
  const auto strict = sim::challenge_all(wall_with(ph::strict_bound{}), truth, 50);
  std::printf("%-16s%16s%16s\n", "", "trusting_bound", "strict_bound");
  for (std::size_t i = 0; i < mine.size(); ++i) {
    std::printf("%-16s", to_string(mine[i].by));
    tell(mine[i]);
    tell(strict[i]);
    std::printf("\n");
  }
}
