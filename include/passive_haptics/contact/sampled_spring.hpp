// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The stiffness and damping with which a contact of a sampled mass settles: the common part of damped_spring,
// proxy_spring and tool_spring. For a mass m [kg], sampled every T [s], on a wall K [N/m]:
//
//     K_s = min(K, κ m/T²)            stiffness [N/m], κ below the limit of sampling
//     D_s = min(2ζ√(K_s m), β m/T)    damping [N·s/m] of ratio ζ, below the limit of sampling
//     D_F = min(D_s, 2ζ√(F m/d))      damping deeper than F/K_s, where the spring is the secant F/d of the
//                                     motors' limit F [N], so that a heavy device is braked all the way out
//
// In a loop with latency κ and D_s have to be smaller, or the contact rings for ever (late_limits); settles() tests
// a contact. Several contacts share one coupling, so K_s of each is (1 − ε) κ m/T² at most (proxy.hpp).
// Source: docs/design/mathematics.md § 9, and docs/design/settling.md for D_F.

#include <passive_haptics/base/parameter.hpp>

namespace passive_haptics {
inline namespace v0 {

/// Spring and damper of a contact, in three numbers, so that a tick needs no division.
template <class Scalar>
struct sampled_spring {
  Scalar stiffness{};   ///< K [N/m]
  Scalar compliance{};  ///< 1/K [m/N]
  Scalar settling{};    ///< B/K [s]
  [[nodiscard]] static constexpr sampled_spring of(Scalar K, Scalar B) noexcept {
    return {K, Scalar(1) / K, B / K};
  }
};

/// True if a contact comes to rest, for an undamped device of mass ≥ m on planes at rest with the force
/// f(n) = −∇Φ(x(n) + σ Δx(n)), Φ convex with a stiffness of at most K = κ m/T² (contact_set is such a law, σ = B/(K T)),
/// in a loop k ticks late, with equal ticks, exact positions and no bound that cuts. The condition is
///     Re (1 − 1/z) z⁻ᵏ G(z) + |1 − 1/z|²/(2κ) > 0 on |z| = 1,   G = ½(z + 1)(1 + σ(1 − 1/z))/(z − 1)²
/// For k = 0 that is κ (2√σ − √(σ−1))² < 2, σ > 1; for k > 0 it is evaluated at 2000 points of the circle.
/// Source: ours; docs/design/mathematics.md § 9, Theorem 3.
[[nodiscard]] constexpr bool settles(double kappa, double sigma, int k = 0) noexcept {
  if (!(kappa > 0.0 && sigma > 1.0 && k >= 0)) return false;
  if (k == 0) {
    const double root = 2.0 * kernels::square_root(sigma) - kernels::square_root(sigma - 1.0);
    return kappa * root * root < 2.0;
  }
  constexpr int points = 2000;
  for (int i = 1; i < points; ++i) {  // z = c + js, t the tangent of half its angle
    const double u = static_cast<double>(i) / points, t = u / (1.0 - u);
    const double c = (1.0 - t * t) / (1.0 + t * t), s = 2.0 * t / (1.0 + t * t);
    // (1 − 1/z) G = −j (1 + σ(1 − 1/z))/(2 t z)
    double re = sigma * s / (2.0 * t), im = -(1.0 + sigma * (1.0 - c)) / (2.0 * t);
    for (int n = 0; n <= k; ++n) {
      const double turned = re * c + im * s;
      im = im * c - re * s;
      re = turned;
    }
    if (!(re + (1.0 - c) / kappa > 0.0)) return false;
  }
  return true;
}

namespace detail {

/// The same for a sampled_spring on a mass m [kg].
template <class Scalar>
[[nodiscard]] constexpr bool comes_to_rest(const sampled_spring<Scalar>& s, Scalar m, Scalar T,
                                           int late) noexcept {
  return v0::settles(static_cast<double>(s.stiffness * T * T / m),
                     static_cast<double>(s.settling / T), late);
}

/// The largest κ, σ and β = κ σ of a contact k > 0 ticks late, with which a device that falls onto it rebounds with at
/// most 0.85 of its speed; and the least σ with which it comes to rest at all. (§ 9, measured)
template <class Scalar>
struct late_limits {
  Scalar stiffness = kernels::largest<Scalar>(), damping = kernels::largest<Scalar>();
  Scalar ticks = Scalar(5), least_ticks = Scalar(0);
  /// `each` is the largest σ/(k + 1): 2.25, or 6 for a damper that acts on the way out only.
  constexpr explicit late_limits(int k, Scalar each = Scalar(2.25)) noexcept {
    if (k <= 0) return;
    const Scalar n = Scalar(1 + k);
    stiffness = kernels::smaller(Scalar(0.2), Scalar(0.9) / n) / (n * n);
    ticks = each * n;
    least_ticks = Scalar(1.5) * n;
    damping = ticks * stiffness;
  }
};

/// σ of a spring at its cap κ: min(2ζ/√κ, β/κ), or min(2/√κ, 5) for a spring without damping parameters.
template <class Spring>
[[nodiscard]] constexpr double ticks_to_settle(const Spring& p) noexcept {
  double ratio = 1.0, most = 5.0;
  if constexpr (requires { p.damping_ratio; }) {
    ratio = p.damping_ratio;
    most = p.damping_fraction / p.stiffness_fraction;
  }
  return kernels::smaller(2.0 * ratio / kernels::square_root(p.stiffness_fraction), most);
}

/// The first fault among the parameters that the springs have in common, as far as `Spring` has them.
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
  const double ticks = ticks_to_settle(p);  // 0: no damping, as the user has stated
  if (ticks > 0.0 && !settles(p.stiffness_fraction, ticks)) {
    return {"stiffness_fraction", p.stiffness_fraction,
            "smaller: with this damping such a contact rings for ever (settles() in "
            "sampled_spring.hpp)"};
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
  /// Writes its parameters into p.
  template <class Spring>
  constexpr void state(Spring& p) const noexcept {
    p.mass = static_cast<double>(mass_);
    p.stiffness_fraction = static_cast<double>(fraction_);
  }

  [[nodiscard]] constexpr Scalar mass() const noexcept { return mass_; }  ///< m [kg]
  /// K_s [N/m] in a loop `late` ticks late; `softness` is ε of a shared coupling, else 0.
  [[nodiscard]] constexpr Scalar stiffness(Scalar K, Scalar softness, Scalar T,
                                           int late) const noexcept {
    return kernels::sampled_stiffness(K, fraction(late) * (Scalar(1) - softness), mass_, T);
  }
  /// κ in a loop `late` ticks late.
  [[nodiscard]] constexpr Scalar fraction(int late) const noexcept {
    if (late <= 0) return fraction_;
    return kernels::smaller(fraction_, late_limits<Scalar>(late).stiffness);
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
  [[nodiscard]] constexpr Scalar damping(Scalar stiffness, Scalar T,
                                         const late_limits<Scalar>& late) const noexcept {
    const bool is_late = late.least_ticks > Scalar(0);  // else no limit of it is reached
    const Scalar most = is_late ? kernels::smaller(most_, late.damping) : most_;
    const Scalar damping = kernels::sampled_damping(stiffness, ratio_, most, this->mass(), T);
    if (!is_late || !(damping > Scalar(0))) return damping;
    return kernels::larger(damping, late.least_ticks * T * stiffness);
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
