// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The rule of the thesis, which bounds the force when the device leaves and when the environment moves.

#include <passive_haptics/port/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

/// The rule of the thesis (2.24-2.27, Fig. 3.2), in force form. With f_max = √(4 B E1):
///     leaving (Δx·n > 0):   |f| ≤ f_max
///     otherwise:            |f| ≤ max(f_LM, f_max)
/// where f_LM [N] is the force at the depth in the local model. While the device moves in, f_LM is allowed, and an
/// update may raise the force to f_max only. The rule reads the contact, so it is a shaper:
///     ph::shaped{ph::spring{}, ph::thesis_rule{}}
///
/// It is NOT passive, because the force of the way in is fixed before the motion is known. A device that enters a
/// wall by δ [m] in one tick and leaves in the next lowers E1 by (K − 2B)δ² [J] each time (A5; a test shows it). The
/// rule settles a contact by hysteresis, and works well in practice. A guarantee needs reachable_bound or strict_bound,
/// with or without this rule.
struct thesis_rule {
  static constexpr bool needs_local_model = true;
  static constexpr bool needs_ledger = true;

  [[nodiscard]] constexpr parameter_fault check() const noexcept { return {}; }

  template <class Space>
  struct on {
    using scalar = typename Space::scalar;
    constexpr explicit on(const thesis_rule& /*p*/) noexcept {}
    [[nodiscard]] constexpr share<scalar> shape(const typename Space::vector& desired,
                                                const contact_state<Space>& contact,
                                                const auto& port) const noexcept {
      scalar left = port.damping.affordable(desired, port.credit(), port.longest_tick);
      if (left < scalar(1) && !(Space::dot(port.travel, contact.normal) > scalar(0))) {
        const scalar asked = Space::dot(desired, contact.normal);
        if (asked > scalar(0)) {
          left = kernels::larger(left, kernels::smaller(contact.local_force / asked, scalar(1)));
        }
      }
      return {left};
    }
  };
};

static_assert(shaper_for<thesis_rule, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
