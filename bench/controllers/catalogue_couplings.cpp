// SPDX-License-Identifier: BSD-3-Clause
// Couplings and what grows stiff on spare energy.
#include "compose.hpp"
#include <passive_haptics/published/published.hpp>

namespace controllers {

namespace {

/// 2b/T [N/m]: the stiffest spring that the damping pays for by itself (L2).
double soft(const premises& p) {
  return 2 * p.damping / p.longest_tick;
}

/// A shaper of that softness, strictly bounded.
template <class Shape>
controller growing(const std::string& name, const std::string& shaper, Shape shape) {
  return over_ledger(
      {name, "shaped{spring, " + shaper + "}, reduced_energy, strict_bound"},
      [shape](const premises& p) { return shape(soft(p)); }, ph::strict_bound{});
}

}  // namespace

std::vector<controller> coupling_controllers() {
  return {
      entry<3>({"virtual coupling", "virtual_coupling Kc = 2b/T, no_observer, no_bound"},
               [](const premises& p) {
                 const ph::virtual_coupling law{.stiffness = soft(p), .damping = p.wall_damping};
                 return parts{law, ph::no_observer{}, ph::no_bound{}};
               }),
      growing("nonlinear coupling", "nonlinear_coupling from 2b/T",
              [](double K) { return ph::nonlinear_coupling{.initial = K, .rate = 10000}; }),
      growing("stiffness increment", "stiffness_increment 2b/T a press",
              [](double K) { return ph::stiffness_increment{.initial = K, .step = K}; }),
      growing("force augmentation", "force_augmentation 2b/T + 0.5 N",
              [](double K) { return ph::force_augmentation{.low = K, .step = 0.5}; }),
  };
}

}  // namespace controllers
