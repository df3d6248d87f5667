// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How stiff a contact may be for a mass that is sampled, and how it settles: what damped_spring, proxy_spring
// and tool_spring have in common. For a mass m [kg], sampled every T [s], on a wall K [N/m]:
//
//     K_s = min(K, κ m/T²)            the stiffness that it can be held with [N/m]
//     D_s = min(2ζ√(K_s m), β m/T)    damping ratio ζ, below what sampling allows [N·s/m]
//     D_F = min(D_s, 2ζ√(F m/d))      deeper than F/K_s, where the motors give F [N] and no more, and the
//                                     spring is the secant F/d: a heavy device is stopped all the way out
//
// Several contacts share one coupling, so K_s of each is (1 − ε) κ m/T² at most (proxy.hpp). Source:
// docs/design/mathematics.md § 9, and docs/design/settling.md for D_F.

#include <passive_haptics/base/parameter.hpp>

namespace passive_haptics {
inline namespace v0 {

/// What a sampled mass can take of a contact, each number at hand without a division.
template <class Scalar>
struct sampled_spring {
  Scalar stiffness{};   ///< K [N/m]
  Scalar compliance{};  ///< 1/K [m/N]
  Scalar settling{};    ///< B/K [s]
  [[nodiscard]] static constexpr sampled_spring of(Scalar K, Scalar B) noexcept {
    return {K, Scalar(1) / K, B / K};
  }
};

namespace detail {

/// What is wrong with the parameters that a spring shares with the others; one that it has not is not asked.
template <class Spring>
[[nodiscard]] constexpr parameter_fault sampled_fault(const Spring& p) noexcept {
  if (!positive(p.mass)) return {"mass", p.mass, "finite and > 0 kg"};
  if (!(p.stiffness_fraction > 0.0 && p.stiffness_fraction <= 1.0)) {
    return {"stiffness_fraction", p.stiffness_fraction, "in (0, 1]"};
  }
  if constexpr (requires { p.damping_ratio; }) {
    if (!not_negative(p.damping_ratio)) {
      return {"damping_ratio", p.damping_ratio, "finite and ≥ 0"};
    }
    if (!(p.damping_fraction >= 0.0 && p.damping_fraction <= 1.0)) {
      return {"damping_fraction", p.damping_fraction, "in [0, 1]"};
    }
  }
  if constexpr (requires { p.softness; }) {
    if (!(p.softness >= 0.001 && p.softness < 1.0)) {
      return {"softness", p.softness, "in [0.001, 1)"};
    }
  }
  if constexpr (requires { p.force_limit; }) {
    if (!(p.force_limit > 0.0)) return {"force_limit", p.force_limit, "> 0 N"};
  }
  return {};
}

/// K_s of a mass.
template <class Scalar>
class sampled_mass {
 public:
  constexpr sampled_mass() noexcept = default;
  template <class Spring>
  constexpr explicit sampled_mass(const Spring& p) noexcept
      : mass_(number<Scalar>(p.mass)), fraction_(number<Scalar>(p.stiffness_fraction)) {}
  /// Writes the parameters that it was made of.
  template <class Spring>
  constexpr void state(Spring& p) const noexcept {
    p.mass = static_cast<double>(mass_);
    p.stiffness_fraction = static_cast<double>(fraction_);
  }

  [[nodiscard]] constexpr Scalar mass() const noexcept { return mass_; }          ///< m [kg]
  [[nodiscard]] constexpr Scalar fraction() const noexcept { return fraction_; }  ///< κ
  [[nodiscard]] constexpr Scalar stiffness(Scalar K, Scalar T) const noexcept {
    return kernels::sampled_stiffness(K, fraction_, mass_, T);
  }
  /// Of one of several contacts, ε the softness of their coupling.
  [[nodiscard]] constexpr Scalar stiffness(Scalar K, Scalar softness, Scalar T) const noexcept {
    return kernels::sampled_stiffness(K, fraction_ * (Scalar(1) - softness), mass_, T);
  }

 private:
  Scalar mass_{}, fraction_{};
};

/// K_s, D_s and D_F of a mass.
template <class Scalar>
class damped_mass : public sampled_mass<Scalar> {
 public:
  constexpr damped_mass() noexcept = default;
  template <class Spring>
  constexpr explicit damped_mass(const Spring& p) noexcept
      : sampled_mass<Scalar>(p),
        ratio_(number<Scalar>(p.damping_ratio)),
        most_(number<Scalar>(p.damping_fraction)),
        force_limit_(number<Scalar>(p.force_limit)) {}
  template <class Spring>
  constexpr void state(Spring& p) const noexcept {
    sampled_mass<Scalar>::state(p);
    p.damping_ratio = static_cast<double>(ratio_);
    p.damping_fraction = static_cast<double>(most_);
    p.force_limit = static_cast<double>(force_limit_);
  }

  [[nodiscard]] constexpr Scalar force_limit() const noexcept { return force_limit_; }  ///< F [N]
  [[nodiscard]] constexpr Scalar damping(Scalar stiffness, Scalar T) const noexcept {
    return kernels::sampled_damping(stiffness, ratio_, most_, this->mass(), T);
  }
  /// 2ζ√(K m) [N·s/m], of K m [kg·N/m].
  [[nodiscard]] constexpr Scalar critical(Scalar Km) const noexcept {
    return Scalar(2) * ratio_ * kernels::square_root(Km);
  }

 private:
  Scalar ratio_{}, most_{}, force_limit_{};  // ζ, β, F
};

}  // namespace detail
}  // namespace v0
}  // namespace passive_haptics
