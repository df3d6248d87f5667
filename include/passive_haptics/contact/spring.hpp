// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Contact laws: the desired force f* [N] from depth d [m] and outward speed v_out [m/s]. The bound then limits it.
//
//   spring            f* = K d                         (2.18); exact stiffness, rings without a hand
//   damped_spring     f* = K_s d − D_s max(0, v_out)   (§ 9); settles; needs the device's mass
//   virtual_coupling  f* = max(0, K_f d − D_c v_out)   (§ 2(g)); 1/K_f = 1/K_c + 1/K: soft, and
//                                                      passive on a fixed wall without a ledger
//   capped            any of them, with K ≤ the device's budget (design/stiffness_budget.hpp)
//   eased             any of them, with a force that does not step at updates of the surface
//
// Damping on the way in raises the force, and virtual damping costs passivity: Colgate's condition
// is b > KT/2 + |D|. Only virtual_coupling has it. A law gives no guarantee; the bound does.

#include <passive_haptics/port/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

/// f* = K d [N] for d > 0, else 0. (2.18)
struct spring {
  [[nodiscard]] constexpr parameter_fault check() const noexcept { return {}; }

  template <class Space>
  class on {
   public:
    using scalar = typename Space::scalar;

    constexpr explicit on(const spring& /*p*/) noexcept {}
    constexpr void adopt(scalar K, scalar /*longest_tick*/) noexcept { stiffness_ = K; }
    [[nodiscard]] constexpr scalar stiffness() const noexcept { return stiffness_; }

    [[nodiscard]] constexpr scalar force(scalar depth, scalar /*outward_speed*/) const noexcept {
      return depth > scalar(0) ? stiffness_ * depth : scalar(0);
    }
    [[nodiscard]] constexpr scalar depth(scalar force, scalar /*outward_speed*/) const noexcept {
      return kernels::depth_bound(force, stiffness_);
    }

   private:
    scalar stiffness_{};  ///< K of the environment [N/m]
  };
};

static_assert(contact_law_for<spring, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
