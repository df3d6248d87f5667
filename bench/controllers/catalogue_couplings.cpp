// SPDX-License-Identifier: BSD-3-Clause
// Couplings and what grows stiff on spare energy.
#include "compose.hpp"
#include <passive_haptics/bounds/augmentation.hpp>

namespace controllers {

namespace {

/// 2b/T [N/m]: the stiffest spring that the damping pays for by itself (L2).
template <class Scalar>
Scalar soft(const premises_in<Scalar>& p) {
  return Scalar(2) * p.damping / p.longest_tick;
}

}  // namespace

std::vector<controller> coupling_controllers() {
  return {
      entry<3>({"virtual coupling", "virtual_coupling Kc = 2b/T, no_observer, no_bound"},
               []<class Space>(Space, const known_in<Space>& p) {
                 return touch<Space>(
                     p,
                     ph::virtual_coupling<Space>{.stiffness = soft(p), .damping = p.wall_damping},
                     ph::no_observer<Space>{}, ph::no_bound<Space>{});
               }),
      entry<3>({"nonlinear coupling", "spring, reduced_energy, nonlinear_coupling from 2b/T"},
               []<class Space>(Space, const known_in<Space>& p) {
                 return touch<Space>(
                     p, ledger<Space>(p),
                     ph::nonlinear_coupling<Space>{.initial = soft(p), .rate = 10000});
               }),
      entry<3>({"stiffness increment", "spring, reduced_energy, stiffness_increment 2b/T a press"},
               []<class Space>(Space, const known_in<Space>& p) {
                 return touch<Space>(
                     p, ledger<Space>(p),
                     ph::stiffness_increment<Space>{.initial = soft(p), .step = soft(p)});
               }),
      entry<3>({"force augmentation", "spring, reduced_energy, force_augmentation 2b/T + 0.5 N"},
               []<class Space>(Space, const known_in<Space>& p) {
                 return touch<Space>(p, ledger<Space>(p),
                                     ph::force_augmentation<Space>{
                                         .low = soft(p), .step = typename Space::scalar(0.5)});
               }),
  };
}

}  // namespace controllers
