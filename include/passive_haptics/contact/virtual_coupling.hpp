// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A contact law that is passive on a fixed wall without a ledger (the menu is in spring.hpp).

#include <passive_haptics/port/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

/// f* = max(0, K_f d − D_c v_out) [N] for d > 0, with 1/K_f = 1/K_c + 1/K: a spring K_c and a damper
/// D_c in parallel between the device and a massless proxy on the wall's spring K. With K_c
/// infinite it is the Kelvin-Voigt wall K, D_c.
///
/// It is a simplification. The proxy's own equation gives f/d = K (K_c + D_c s)/(K + K_c + D_c s), with the
/// same static stiffness, but a damping that falls from D_c (K/(K + K_c))² at low frequencies to zero at high
/// ones. Here the damping is D_c for any K, which is exact on a rigid wall (K → ∞) only.
///
/// Without a ledger it is passive on a fixed surface, sampled every T and held, with any passive hand, if
///     K_f ≤ 2 (b − D_c)/T,      for which K_c ≤ 2 (b − D_c)/T is sufficient for any K
/// (§ 2(g); Colgate's condition). The condition does not cover ticks that vary, delay and moving surfaces, for
/// which the port needs a bound.
struct virtual_coupling {
  double stiffness = std::numeric_limits<double>::infinity();  ///< K_c [N/m], may be infinite
  double damping{};                                            ///< D_c [N·s/m]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!(stiffness > 0.0)) return {"stiffness", stiffness, "> 0 N/m"};
    if (!detail::not_negative(damping)) return {"damping", damping, "finite and ≥ 0 N·s/m"};
    return {};
  }

  template <class Space>
  class on {
   public:
    using scalar = typename Space::scalar;

    constexpr explicit on(const virtual_coupling& p) noexcept { set(p); }
    /// A new stiffness takes effect at the next adopt().
    constexpr void set(const virtual_coupling& p) noexcept {
      stiffness_ = detail::number<scalar>(p.stiffness);
      damping_ = detail::number<scalar>(p.damping);
    }
    [[nodiscard]] constexpr virtual_coupling parameters() const noexcept {
      return {.stiffness = static_cast<double>(stiffness_),
              .damping = static_cast<double>(damping_)};
    }

    constexpr void adopt(scalar K, scalar /*longest_tick*/) noexcept {
      felt_ = K / (scalar(1) + K / stiffness_);
    }
    static constexpr softened_by softener = softened_by::coupling;
    [[nodiscard]] constexpr scalar stiffness() const noexcept { return felt_; }  ///< K_f [N/m]

    [[nodiscard]] constexpr scalar force(scalar depth, scalar outward_speed) const noexcept {
      if (!(depth > scalar(0))) return scalar(0);
      return kernels::larger(felt_ * depth - damping_ * outward_speed, scalar(0));
    }
    /// It is zero for a force that the damper alone would give.
    [[nodiscard]] constexpr scalar depth(scalar force, scalar outward_speed) const noexcept {
      if (!(force > scalar(0))) return scalar(0);
      return kernels::larger(kernels::depth_bound(force + damping_ * outward_speed, felt_),
                             scalar(0));
    }

   private:
    scalar stiffness_{}, damping_{};
    scalar felt_{};
  };
};

static_assert(contact_law_for<virtual_coupling, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
