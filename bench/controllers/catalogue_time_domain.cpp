// SPDX-License-Identifier: BSD-3-Clause
// Time-domain passivity, tanks, set-position modulation.
#include "compose.hpp"
#include <passive_haptics/published/published.hpp>

namespace controllers {

namespace {

/// The largest damper that a sampled mass settles with (§ 2(c)).
double most_damping(const premises& p) {
  return 0.5 * p.mass / p.longest_tick;
}

ph::two_layer_tank two_layers(const premises& p) {
  return {.wanted = 0.015, .refill = 3000, .max_damping = most_damping(p)};
}

}  // namespace

std::vector<controller> time_domain_controllers() {
  const auto gate = [](const premises&) { return ph::set_position_modulation{}; };
  return {
      entry<3>({"PO/PC", "spring, no_observer, series_passivity_controller 0.5 m/T"},
               [](const premises& p) {
                 return parts{wall(p), ph::no_observer{},
                              ph::series_passivity_controller{.max_damping = most_damping(p)}};
               }),
      over_ledger(
          {"PO/PC + reference energy",
           "shaped{spring, reference_energy{series_controller_with_damping 0.5 m/T}}, "
           "reduced_energy, no_bound"},
          [](const premises& p) {
            return ph::reference_energy_with_damping{{.max_damping = most_damping(p)}};
          },
          ph::no_bound{}),
      over_ledger<3>("energy tank, worst case", "energy_tank 1 µJ",
                     [](const premises&) { return ph::energy_tank{.reserve = 1e-6}; }),
      over_ledger<3>("energy tank, predicted", "predicting_tank 1 µJ",
                     [](const premises&) { return ph::predicting_tank{.reserve = 1e-6}; }),
      over_ledger<3>("tank + level controller", "two_layer_tank", two_layers),
      over_ledger<3>("tank + level controller + strict",
                     "bound_chain{two_layer_tank, strict_bound}",
                     [](const premises& p) {
                       return ph::bound_chain{two_layers(p), ph::strict_bound{}};
                     }),
      over_ledger(
          {"PSPM as published",
           "shaped{spring, published_set_position_modulation}, reduced_energy, no_bound"},
          [](const premises&) { return ph::published_set_position_modulation{}; }, ph::no_bound{}),
      // Its type promises nothing; paying for the hold it is passive up to 2b/T, here with the b and
      // the T of the premises' defaults.
      over_ledger(
          {.name = "PSPM",
           .composition = "shaped{spring, set_position_modulation}, reduced_energy, no_bound",
           .proved_up_to = 2.0 * 0.03 / 1e-3},
          gate, ph::no_bound{}),
      over_ledger({"PSPM + strict FBA",
                   "shaped{spring, set_position_modulation}, reduced_energy, strict_bound"},
                  gate, ph::strict_bound{}),
  };
}

}  // namespace controllers
