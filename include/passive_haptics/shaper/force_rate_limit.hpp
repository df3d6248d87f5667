// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A rate limit on the force changes that the environment causes.
//
//   force_rate_limit  |f − f_LM| ≤ rate·dt         an update causes no jump of the force

#include <passive_haptics/port/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

/// Keeps the force along the normal within f_LM ± rate·dt and ≥ 0, where f_LM [N] is the force at the depth in
/// the local model. A change by the hand's own motion passes at once. A change by the environment (an update, a
/// lost contact) is limited to `rate`, so the local surface moves at rate/K [m/s] at most (A23). While the surface
/// retreats the force may exceed the desired one, so the energy bound acts after this shaper, as after any.
struct force_rate_limit {
  static constexpr bool needs_local_model = true;
  static constexpr bool needs_ledger = false;

  double rate{};  ///< fastest change of the force by the environment [N/s]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (detail::positive(rate)) return {};
    return {"rate", rate, "finite and > 0 N/s"};
  }

  template <class Space>
  class on {
   public:
    using scalar = typename Space::scalar;
    using vector = typename Space::vector;

    constexpr explicit on(const force_rate_limit& p) noexcept
        : rate_(detail::number<scalar>(p.rate)) {}
    [[nodiscard]] constexpr force_rate_limit parameters() const noexcept {
      return {static_cast<double>(rate_)};
    }
    [[nodiscard]] constexpr vector shape(const vector& desired, const contact_state<Space>& contact,
                                         const auto& port) const noexcept {
      const scalar step = rate_ * port.dt;
      const scalar asked = Space::dot(desired, contact.normal);
      const scalar least = kernels::larger(contact.local_force - step, scalar(0));
      const scalar most = contact.local_force + step;
      return contact.normal * kernels::clamped(asked, least, most);
    }

   private:
    scalar rate_;
  };
};

static_assert(shaper_for<force_rate_limit, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
