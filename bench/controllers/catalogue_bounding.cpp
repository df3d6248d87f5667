// SPDX-License-Identifier: BSD-3-Clause
// No bound, the force bounding family, the thesis and what knows the device's mass.
#include "compose.hpp"
#include <passive_haptics/published/published.hpp>

namespace controllers {

namespace {

/// The thesis's rule with a capped ledger: the credit is capped at what holds `times` the load.
auto thesis_safe(const std::string& name, double times) {
  return entry<3>({name, "shaped{spring, thesis_rule}, capped_energy, reachable_bound"},
                  [times](const premises& p) {
                    ph::capped_energy capped{.damping = p.damping};
                    if (p.load > 0.0)
                      capped.cap =
                          ph::kernels::bank_for_hold(times * p.load, p.damping, p.longest_tick);
                    return parts{ph::shaped{wall(p), ph::thesis_rule{}}, capped, reachable(p)};
                  });
}

}  // namespace

std::vector<controller> bounding_controllers() {
  const auto strict = [](const premises&) { return ph::strict_bound{}; };
  return {
      entry<3>({"none", "spring, no_observer, no_bound"},
               [](const premises& p) {
                 return parts{wall(p), ph::no_observer{}, ph::no_bound{}};
               }),
      over_ledger<3>("strict FBA", "strict_bound", strict),
      over_ledger<3, 2>("strict FBA, 2 ticks late", "strict_bound, late_loop_limits<2>", strict),
      entry<3>({"strict FBA + friction", "spring, dual_ledger, strict_bound"},
               [](const premises& p) {
                 const ph::dual_ledger rich{.damping = {p.damping, p.friction, 0.0},
                                            .quantum = p.quantum};
                 return parts{wall(p), rich, ph::strict_bound{}};
               }),
      over_ledger(
          {"force rate + strict FBA",
           "shaped{spring, force_rate_limit 100 N/s}, reduced_energy, strict_bound"},
          [](const premises&) { return ph::force_rate_limit{.rate = 100}; }, ph::strict_bound{}),
      over_ledger<3>("memoryless FBA", "memoryless_bound",
                     [](const premises&) { return ph::memoryless_bound{}; }),
      over_ledger<3>("per-axis FBA", "per_axis_bound",
                     [](const premises&) { return ph::per_axis_bound{}; }),
      over_ledger<3>("EBA", "energy_bounding c1 = c2 = b/T",
                     [](const premises& p) {
                       const double B = p.damping / p.longest_tick;
                       return ph::energy_bounding{.slope = B, .storage = B};
                     }),
      over_ledger<3>("EBA, tight", "tight_energy_bounding c2 = 2b/T",
                     [](const premises& p) {
                       return ph::tight_energy_bounding{.storage = 2 * p.damping / p.longest_tick};
                     }),
      over_ledger<1>(
          "sector", "sector_bound b/T",
          [](const premises& p) { return ph::sector_bound{.slope = p.damping / p.longest_tick}; }),
      over_ledger(
          {"thesis", "shaped{spring, thesis_rule}, reduced_energy, no_bound"},
          [](const premises&) { return ph::thesis_rule{}; }, ph::no_bound{}),
      over_ledger<3>("reachable", "reachable_bound", reachable),
      thesis_safe("thesis safe, holds 2 mg", 2.0),
      thesis_safe("thesis safe, holds 1.2 mg", 1.2),
      entry<3>(
          {"damped spring + reachable", "damped_spring, reduced_energy, reachable_bound", false},
          [](const premises& p) {
            return parts{ph::damped_spring{.mass = p.mass}, ledger(p), reachable(p)};
          }),
  };
}

}  // namespace controllers
