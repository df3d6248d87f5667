// SPDX-License-Identifier: BSD-3-Clause
// Time-domain passivity, tanks, set-position modulation.
#include "compose.hpp"
#include <passive_haptics/bounds/energy_tank.hpp>
#include <passive_haptics/bounds/passivity_controller.hpp>
#include <passive_haptics/bounds/set_position.hpp>

namespace controllers {

namespace {

/// The largest damper that a sampled mass settles with (§ 2(c)).
template <class Scalar>
Scalar most_damping(const premises_in<Scalar>& p) {
  return Scalar(0.5) * p.mass / p.longest_tick;
}

template <class Space>
ph::two_layer_tank<Space> two_layers(const known_in<Space>& p) {
  return {.wanted = typename Space::scalar(0.015), .refill = 3000, .max_damping = most_damping(p)};
}

/// PSPM that pays for the hold is passive for walls no stiffer than 2b/T, here with b = 0.03 N·s/m
/// and T = 1 ms.
constexpr coverage soft_walls{.stiffest = 2.0 * 0.03 / 1e-3};

}  // namespace

std::vector<controller> time_domain_controllers() {
  using ph::damping_credit, ph::hold_leak, ph::tank_outflow;
  return {
      entry<3>({"PO/PC", "spring, no_observer, series_passivity_controller 0.5 m/T"},
               []<class Space>(Space, const known_in<Space>& p) {
                 return touch<Space>(
                     p, ph::no_observer<Space>{},
                     ph::series_passivity_controller<Space>{.max_damping = most_damping(p)});
               }),
      entry<3>(
          {"PO/PC + reference energy",
           "spring, reduced_energy, series_passivity_controller{0.5 m/T, reference 1, counted}"},
          []<class Space>(Space, const known_in<Space>& p) {
            return touch<Space>(p, ledger<Space>(p),
                                ph::series_passivity_controller<Space, damping_credit::counted>{
                                    .max_damping = most_damping(p), .reference = 1.0});
          }),
      entry<3>({"energy tank, worst case", "spring, reduced_energy, energy_tank 1 µJ"},
               []<class Space>(Space, const known_in<Space>& p) {
                 return touch<Space>(
                     p, ledger<Space>(p),
                     ph::energy_tank<Space>{.reserve = typename Space::scalar(1e-6)});
               }),
      entry<3>({"energy tank, predicted", "spring, reduced_energy, energy_tank<predicted> 1 µJ"},
               []<class Space>(Space, const known_in<Space>& p) {
                 return touch<Space>(p, ledger<Space>(p),
                                     ph::energy_tank<Space, tank_outflow::predicted>{
                                         .reserve = typename Space::scalar(1e-6)});
               }),
      entry<3>({"tank + level controller", "spring, reduced_energy, two_layer_tank"},
               []<class Space>(Space, const known_in<Space>& p) {
                 return touch<Space>(p, ledger<Space>(p), two_layers<Space>(p));
               }),
      entry<3>({"tank + level controller + strict",
                "spring, reduced_energy, bound_chain{two_layer_tank, strict_bound}"},
               []<class Space>(Space, const known_in<Space>& p) {
                 return touch<Space>(
                     p, ledger<Space>(p),
                     ph::bound_chain{two_layers<Space>(p), ph::strict_bound<Space>{}});
               }),
      entry<3>({"PSPM as published", "spring, reduced_energy, set_position_modulation<ignored>"},
               []<class Space>(Space, const known_in<Space>& p) {
                 return touch<Space>(p, ledger<Space>(p),
                                     ph::set_position_modulation<Space, hold_leak::ignored>{});
               }),
      entry<3>({"PSPM", "spring, reduced_energy, set_position_modulation", soft_walls},
               []<class Space>(Space, const known_in<Space>& p) {
                 return touch<Space>(p, ledger<Space>(p), ph::set_position_modulation<Space>{});
               }),
      entry<3>({"PSPM + strict FBA",
                "spring, reduced_energy, bound_chain{set_position_modulation, strict_bound}"},
               []<class Space>(Space, const known_in<Space>& p) {
                 return touch<Space>(p, ledger<Space>(p),
                                     ph::bound_chain{ph::set_position_modulation<Space>{},
                                                     ph::strict_bound<Space>{}});
               }),
  };
}

}  // namespace controllers
