// SPDX-License-Identifier: BSD-3-Clause
// For encoders whose steps matter: a ledger that is sure, a motion that is estimated.
#include "compose.hpp"

namespace controllers {

namespace {

ph::quantised_energy sure_ledger(const premises& p) {
  return {.damping = p.damping, .quantum = p.quantum};
}

}  // namespace

std::vector<controller> encoder_controllers() {
  return {
      entry<3>({"strict FBA, encoder steps", "spring, quantised_energy, strict_bound"},
               [](const premises& p) {
                 return parts{wall(p), sure_ledger(p), ph::strict_bound{}};
               }),
      entry<3>({"reachable, encoder steps", "spring, quantised_energy, reachable_bound"},
               [](const premises& p) {
                 return parts{wall(p), sure_ledger(p), reachable(p)};
               }),
      entry<3>({"damped spring + reachable, encoder steps",
                "damped_spring, quantised_energy, reachable_bound, mass_observer", false},
               [](const premises& p) {
                 return parts{ph::damped_spring{.mass = p.mass}, sure_ledger(p), reachable(p),
                              ph::mass_observer{.mass = p.mass, .quantum = p.quantum}};
               }),
  };
}

}  // namespace controllers
