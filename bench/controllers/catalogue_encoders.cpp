// SPDX-License-Identifier: BSD-3-Clause
// For encoders whose steps matter: a ledger that is sure, a motion that is estimated.
#include "compose.hpp"

namespace controllers {

namespace {

template <class Space>
ph::quantised_energy<Space> sure_ledger(const known_in<Space>& p) {
  return {.damping = p.damping, .quantum = p.quantum};
}

constexpr coverage any_step{.rounding = true};
constexpr coverage mass_known{.any_motion = false, .any_clock = false, .rounding = true};

}  // namespace

std::vector<controller> encoder_controllers() {
  return {
      entry<3>({"strict FBA, encoder steps", "spring, quantised_energy, strict_bound", any_step},
               []<class Space>(Space, const known_in<Space>& p) {
                 return touch<Space>(p, sure_ledger<Space>(p), ph::strict_bound<Space>{});
               }),
      entry<3>(
          {"reachable, encoder steps", "spring, quantised_energy, reachable_bound", mass_known},
          []<class Space>(Space, const known_in<Space>& p) {
            const ph::reachable_bound<Space> bound{.mass = p.mass, .hand_force = p.hand_force};
            return touch<Space>(p, sure_ledger<Space>(p), bound);
          }),
      entry<3>(
          {"damped spring + reachable, encoder steps",
           "damped_spring, quantised_energy, reachable_bound, mass_observer", mass_known, false},
          []<class Space>(Space, const known_in<Space>& p) {
            return touch<Space>(
                p, ph::damped_spring<Space>{.mass = p.mass}, sure_ledger<Space>(p),
                ph::reachable_bound<Space>{.mass = p.mass, .hand_force = p.hand_force},
                ph::mass_observer<Space>{.mass = p.mass, .quantum = p.quantum});
          }),
  };
}

}  // namespace controllers
