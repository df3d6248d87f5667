// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A passivity controller (PO/PC) that dissipates during the whole release instead of in one late burst.
//
//   reference_energy                α = (E_thr + r K d²/2 − E) dt/‖Δx‖²     NOT passive
//   reference_energy_with_damping   the same, the device's damping credited

#include <passive_haptics/published/passivity_controller.hpp>

namespace passive_haptics {
inline namespace v0 {

/// A series_passivity_controller that acts as soon as E < E_thr + r K d²/2, the last term being the share r of
/// the energy [J] of the contact spring at the target's depth d. So it dissipates during the release the energy that
/// the release generates. Inspired by the reference energy of Ryu, Preusche, Hannaford and Hirzinger 2005. It is NOT
/// passive.
template <damping_credit Credit = damping_credit::none>
struct basic_reference_energy {
  static constexpr bool needs_local_model = false;
  static constexpr bool needs_ledger = Credit == damping_credit::counted;

  basic_series_controller<Credit> controller{};
  double part = 1.0;  ///< r, the share of the spring's energy, 0 to 1

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!(part >= 0.0 && part <= 1.0)) return {"part", part, "in [0, 1]"};
    return controller.check();
  }

  template <class Space>
  class on {
   public:
    using scalar = typename Space::scalar;
    using vector = typename Space::vector;

    constexpr explicit on(const basic_reference_energy& p) noexcept
        : controller_(p.controller), part_(detail::number<scalar>(p.part)) {}
    constexpr void set(const basic_reference_energy& p) noexcept {
      controller_.set(p.controller);
      part_ = detail::number<scalar>(p.part);
    }
    [[nodiscard]] constexpr basic_reference_energy parameters() const noexcept {
      return {.controller = controller_.parameters(), .part = static_cast<double>(part_)};
    }
    constexpr void reset() noexcept { controller_.reset(); }

    [[nodiscard]] constexpr vector shape(const vector& desired, const contact_state<Space>& contact,
                                         const auto& port) noexcept {
      const bool touching = Space::dot(desired, desired) > scalar(0);
      const scalar depth = touching ? kernels::larger(contact.target_depth, scalar(0)) : scalar(0);
      return controller_.repaid(desired, port,
                                part_ * contact.stiffness * depth * depth / scalar(2));
    }

   private:
    part_at<basic_series_controller<Credit>, Space> controller_;
    scalar part_;
  };
};

using reference_energy = basic_reference_energy<>;
using reference_energy_with_damping = basic_reference_energy<damping_credit::counted>;

static_assert(shaper_for<reference_energy, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
