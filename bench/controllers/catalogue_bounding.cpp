// SPDX-License-Identifier: BSD-3-Clause
// No bound, the force bounding family, the thesis and what knows the device's mass.
#include "compose.hpp"
#include <passive_haptics/bounds/energy_bounding.hpp>
#include <passive_haptics/bounds/sector.hpp>

namespace controllers {

namespace {

/// The reachable set of a hand that pushes with no more than the scene says.
template <class Space>
ph::reachable_bound<Space> reachable(const known_in<Space>& p) {
  return {.mass = p.mass, .hand_force = p.hand_force};
}

/// thesis_safe of § 2(a'): the credit is capped at what holds `times` the load.
template <class Space>
auto thesis_safe(const known_in<Space>& p, typename Space::scalar times) {
  using scalar = typename Space::scalar;
  auto capped = ledger<Space>(p);
  if (p.load > scalar(0))
    capped.cap = ph::kernels::bank_for_hold(times * p.load, p.damping, p.longest_tick);
  return touch<Space>(p, capped, ph::bound_chain{ph::thesis_bound<Space>{}, reachable<Space>(p)});
}

constexpr coverage mass_known{.any_motion = false, .any_clock = false};

}  // namespace

std::vector<controller> bounding_controllers() {
  return {
      entry<3>({"none", "spring, no_observer, no_bound"},
               []<class Space>(Space, const known_in<Space>& p) {
                 return touch<Space>(p, ph::no_observer<Space>{}, ph::no_bound<Space>{});
               }),
      entry<3>({"strict FBA", "spring, reduced_energy, strict_bound"},
               []<class Space>(Space, const known_in<Space>& p) {
                 return touch<Space>(p, ledger<Space>(p), ph::strict_bound<Space>{});
               }),
      entry<3>(
          {"strict FBA, 2 ticks late", "spring, reduced_energy, strict_bound<2>", {.latency = 2}},
          []<class Space>(Space, const known_in<Space>& p) {
            return touch<Space>(p, ledger<Space>(p), ph::strict_bound<Space, 2>{});
          }),
      entry<3>({"strict FBA + friction",
                "spring, reduced_energy<damping_and_friction>, strict_bound",
                {},
                true,
                true},
               []<class Space>(Space, const known_in<Space>& p) {
                 using rich = ph::damping_and_friction<Space>;
                 return touch<Space>(
                     p, ph::reduced_energy<Space, rich>{.damping = rich{p.damping, p.friction}},
                     ph::strict_bound<Space>{});
               }),
      entry<3>({"force rate + strict FBA",
                "spring, reduced_energy, bound_chain{force_rate_limit 100 N/s, strict_bound}"},
               []<class Space>(Space, const known_in<Space>& p) {
                 return touch<Space>(p, ledger<Space>(p),
                                     ph::bound_chain{ph::force_rate_limit<Space>{.rate = 100},
                                                     ph::strict_bound<Space>{}});
               }),
      entry<3>({"memoryless FBA", "spring, reduced_energy, memoryless_bound"},
               []<class Space>(Space, const known_in<Space>& p) {
                 return touch<Space>(p, ledger<Space>(p), ph::memoryless_bound<Space>{});
               }),
      entry<3>({"per-axis FBA", "spring, reduced_energy, per_axis_bound"},
               []<class Space>(Space, const known_in<Space>& p) {
                 return touch<Space>(p, ledger<Space>(p), ph::per_axis_bound<Space>{});
               }),
      entry<3>({"EBA", "spring, reduced_energy, energy_bounding c1 = c2 = b/T"},
               []<class Space>(Space, const known_in<Space>& p) {
                 const auto B = p.damping / p.longest_tick;
                 return touch<Space>(p, ledger<Space>(p),
                                     ph::energy_bounding<Space>{.slope = B, .storage = B});
               }),
      entry<3>({"EBA, tight", "spring, reduced_energy, tight_energy_bounding c2 = 2b/T"},
               []<class Space>(Space, const known_in<Space>& p) {
                 return touch<Space>(
                     p, ledger<Space>(p),
                     ph::tight_energy_bounding<Space>{.storage = 2 * p.damping / p.longest_tick});
               }),
      entry<1>({"sector", "spring, reduced_energy, sector_bound b/T"},
               []<class Space>(Space, const known_in<Space>& p) {
                 return touch<Space>(p, ledger<Space>(p),
                                     ph::sector_bound<Space>{.slope = p.damping / p.longest_tick});
               }),
      entry<3>({"thesis", "spring, reduced_energy, thesis_bound"},
               []<class Space>(Space, const known_in<Space>& p) {
                 return touch<Space>(p, ledger<Space>(p), ph::thesis_bound<Space>{});
               }),
      entry<3>({"reachable", "spring, reduced_energy, reachable_bound", mass_known},
               []<class Space>(Space, const known_in<Space>& p) {
                 return touch<Space>(p, ledger<Space>(p), reachable<Space>(p));
               }),
      entry<3>(
          {"thesis safe, holds 2 mg",
           "spring, reduced_energy{cap}, bound_chain{thesis_bound, reachable_bound}", mass_known},
          []<class Space>(Space, const known_in<Space>& p) { return thesis_safe<Space>(p, 2); }),
      entry<3>(
          {"thesis safe, holds 1.2 mg",
           "spring, reduced_energy{cap}, bound_chain{thesis_bound, reachable_bound}", mass_known},
          []<class Space>(Space, const known_in<Space>& p) {
            return thesis_safe<Space>(p, typename Space::scalar(1.2));
          }),
      entry<3>({"damped spring + reachable", "damped_spring, reduced_energy, reachable_bound",
                mass_known, false},
               []<class Space>(Space, const known_in<Space>& p) {
                 return touch<Space>(p, ph::damped_spring<Space>{.mass = p.mass}, ledger<Space>(p),
                                     reachable<Space>(p));
               }),
  };
}

}  // namespace controllers
