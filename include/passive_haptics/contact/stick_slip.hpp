// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Dry friction of a contact: an elastic bristle that bends while the device sticks, and slips at the friction limit.
//
//   stick_slip     |f_t| ≤ μ f_n,  μ falls from static to kinetic as it slips, and rises as it sticks
//   frictionless   f_t = 0, without any state
//
// Each contact has its own bristle and friction cone: one on the resultant of two walls would creep along their groove.

#include <passive_haptics/base/parameter.hpp>
#include <passive_haptics/normal_interpolation/carry.hpp>

namespace passive_haptics {
inline namespace v0 {

struct frictionless {
  [[nodiscard]] constexpr parameter_fault check() const noexcept { return {}; }
};

/// The elasto-plastic bristle of Hayward and Armstrong (2000) with a static and a kinetic coefficient:
///     z ← carry(z + Δx − (Δx·n₀) n₀;  n₀ → n)             Δx of the tick, n₀ and n the normal before and after
///     r = μ f_n/k_t;  |z| > r, slipping by s = |z| − r:   μ ← μ_d + (μ − μ_d)/(1 + s/D),  z ← r z/|z|
///                     else, sticking:                     μ ← μ + (μ_s − μ) dt/(dt + t_h)
///     f_t = −k_t z − B_t v_t,  shortened to μ f_n
/// z returns with the device, so a trembling device does not creep if the normal is constant. A normal that moves on
/// a closed path turns z by the solid angle of the path, and the device creeps. It is passive without a ledger on a
/// surface at rest for K, k_t ≤ 2b/T, and with the port's bound always.
struct stick_slip {
  double static_coefficient = 0.6;   ///< μ_s, static coefficient
  double kinetic_coefficient = 0.4;  ///< μ_d ≤ μ_s, kinetic coefficient
  double weakening = 2e-4;           ///< D, slip that halves μ − μ_d [m]
  double healing = 0.02;             ///< t_h, time constant of μ → μ_s while sticking [s]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!detail::not_negative(static_coefficient)) {
      return {"static_coefficient", static_coefficient, "finite and ≥ 0"};
    }
    if (!(kinetic_coefficient >= 0.0 && kinetic_coefficient <= static_coefficient)) {
      return {"kinetic_coefficient", kinetic_coefficient, "in [0, static_coefficient]"};
    }
    if (!detail::positive(weakening)) return {"weakening", weakening, "finite and > 0 m"};
    if (!detail::positive(healing)) return {"healing", healing, "finite and > 0 s"};
    return {};
  }
  template <class Space>
  class on;
  template <class Space>
  class bristle;
};

/// The parameters in the port's scalar.
template <class Space>
class stick_slip::on {
 public:
  using scalar = typename Space::scalar;
  constexpr explicit on(const stick_slip& p) noexcept
      : most(detail::number<scalar>(p.static_coefficient)),
        least(detail::number<scalar>(p.kinetic_coefficient)),
        weakening(detail::number<scalar>(p.weakening)),
        healing(detail::number<scalar>(p.healing)) {}
  [[nodiscard]] constexpr stick_slip parameters() const noexcept {
    return {.static_coefficient = static_cast<double>(most),
            .kinetic_coefficient = static_cast<double>(least),
            .weakening = static_cast<double>(weakening),
            .healing = static_cast<double>(healing)};
  }
  scalar most, least, weakening, healing;
};

/// The state of one contact.
template <class Space>
class stick_slip::bristle {
 public:
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;

  constexpr void reset() noexcept { *this = {}; }
  /// Ends the contact.
  constexpr void let_go() noexcept { touching_ = false; }

  /// f_t [N] after the device has moved by `travel` [m] in dt [s], at `velocity` [m/s], under a normal force
  /// f_n [N] along n. `stiffness` is k_t [N/m], `damping` B_t [N·s/m].
  [[nodiscard, gnu::always_inline]] constexpr vector rub(const on<Space>& rule, scalar f_n,
                                                         const vector& n, const vector& travel,
                                                         const vector& velocity, scalar stiffness,
                                                         scalar damping, scalar dt) noexcept {
    if (!(f_n > scalar(0))) {
      let_go();
      return Space::zero();
    }
    if (!touching_) {
      bend_ = Space::zero();
      coefficient_ = rule.most;
      touching_ = true;
    } else {
      const vector before = normal_;
      vector bend = bend_;
      bend = bend + travel;
      bend = bend - before * Space::dot(bend, before);
      if (!(before == n)) bend = carry<Space>(bend, before, n);
      bend_ = bend;
    }
    normal_ = n;

    vector bend = bend_;
    scalar most = coefficient_ * f_n;
    const scalar bent = Space::dot(bend, bend) * stiffness * stiffness;
    if (bent > most * most) {
      const scalar pulled = kernels::square_root(bent);  // k_t |z|
      const scalar above = coefficient_ - rule.least;
      coefficient_ = rule.least + above * rule.weakening * stiffness /
                                      (rule.weakening * stiffness + (pulled - most));
      most = coefficient_ * f_n;
      bend = bend * (most / pulled);
      bend_ = bend;
    } else if (coefficient_ < rule.most) {
      coefficient_ += (rule.most - coefficient_) * dt / (dt + rule.healing);
      most = coefficient_ * f_n;
    }

    const vector across = velocity - n * Space::dot(velocity, n);
    vector force = bend * -stiffness - across * damping;
    const scalar asked = Space::dot(force, force);
    if (asked <= most * most) return force;
    return force * (most / kernels::square_root(asked));
  }
  [[nodiscard]] constexpr scalar coefficient() const noexcept { return coefficient_; }  ///< μ

 private:
  typename Space::coordinates bend_{};    ///< z [m], across the normal
  typename Space::coordinates normal_{};  ///< n of the last tick
  scalar coefficient_{};
  bool touching_ = false;
};

}  // namespace v0
}  // namespace passive_haptics
