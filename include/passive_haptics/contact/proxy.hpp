// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Several contacts at once, as one spring: a massless proxy in the free space, to which a coupling pulls the device.
//
//     λ ≥ 0 minimises ½ λᵀAλ − d'ᵀλ,   A_ii = c_i = 1/K_i,   f* = Σ λ_i n_i
//                                      A_ij = (1 − ε) n_i·n_j min(c_i, c_j)                            (S1)
//     d'_i = d_i + min(−τ_i n_i·v, max(2 d_i, ⅔ λ_i(n−1) c_i, 0)),   τ_i = B_i/K_i                     (S2)
//
// Each wall has its own compliance c_i [m/N], and A_ij couples two by that of the stiffer one, so a wall with λ_i = 0
// has no effect. A single contact gives f* = K d − B v exactly. For any number and arrangement of planes −f* is the
// gradient of a convex potential, whose stiffness is at most K/(1 − ε), K the stiffest with λ_i > 0. So 8 copies of
// one wall are that wall, while the sum of their springs would be 8 times as stiff, and shake. Moving out is always
// damped; moving in by at most twice the spring's force, so that the force does not step at the touch. The damping
// dissipates for every set of pressing contacts. Source (ours) and proofs: docs/design/contacts.md, mathematics.md § 9.

#include <passive_haptics/base/explanation.hpp>
#include <passive_haptics/contact/sampled_spring.hpp>

#include <array>
#include <cstddef>
#include <limits>

namespace passive_haptics {
inline namespace v0 {

/// The spring and damper of the contacts of a device. K and B of each are those of damped_spring, with K at most
/// (1 − ε) κ m/T²; the damping is two-sided, because shallow cones would swing on otherwise.
struct proxy_spring {
  double mass{};                    ///< m, apparent mass of the device [kg], a lower bound
  double stiffness_fraction = 0.1;  ///< κ, of m/T²
  double damping_ratio = 1.0;       ///< ζ
  double damping_fraction = 0.5;    ///< β, of m/T
  double softness = 0.05;           ///< ε: 0 would be the god-object, 1 the sum of springs
  double force_limit = std::numeric_limits<double>::infinity();  ///< limit of the motors [N]
  double most = std::numeric_limits<double>::infinity();         ///< budget for encoder steps [N/m]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!(most > 0.0)) {
      return {"most", most, "> 0 N/m; on encoders dry friction pays, stated as .friction"};
    }
    return detail::sampled_fault(*this);
  }
  template <class Scalar>
  class at;
};

template <class Scalar>
class proxy_spring::at {
 public:
  constexpr explicit at(const proxy_spring& p) noexcept
      : rule_(p),
        softness_(detail::number<Scalar>(p.softness)),
        most_(detail::number<Scalar>(p.most)) {}
  [[nodiscard]] constexpr proxy_spring parameters() const noexcept {
    proxy_spring p;
    rule_.state(p);
    p.softness = static_cast<double>(softness_);
    p.most = static_cast<double>(most_);
    return p;
  }

  /// Sets the longest tick T [s] and the latency of `late` ticks.
  constexpr void adopt(Scalar T, int late = 0) noexcept {
    sampled_every_ = T;
    late_ = late;
  }
  /// K = min(K, (1 − ε) κ m/T², most) and B = min(2ζ√(Km), β m/T).
  [[nodiscard]] constexpr sampled_spring<Scalar> sampled(Scalar K) const noexcept {
    const Scalar k = rule_.stiffness(kernels::smaller(K, most_), softness_, sampled_every_, late_);
    return sampled_spring<Scalar>::of(
        k, rule_.damping(k, sampled_every_, detail::late_limits<Scalar>(late_)));
  }
  /// The reason why a surface of K [N/m] is displayed softer.
  [[nodiscard]] constexpr softened_by softener(Scalar K) const noexcept {
    const Scalar k = sampled(K).stiffness;
    if (!(k < K)) return softened_by::coupling;
    return k < most_ ? softened_by::mass_and_tick : softened_by::encoder_steps;
  }
  /// saturated() is the spring if K d exceeds the motors' limit F: the secant F/d, with its critical damping, so that a
  /// heavy device is braked all the way out.
  [[nodiscard]] constexpr bool saturates(const sampled_spring<Scalar>& s, Scalar d) const noexcept {
    return s.stiffness * d > rule_.force_limit();
  }
  [[nodiscard]] constexpr sampled_spring<Scalar> saturated(const sampled_spring<Scalar>& s,
                                                           Scalar d) const noexcept {
    const Scalar secant = rule_.force_limit() / d;
    const Scalar damping = rule_.critical(secant * rule_.mass());
    return sampled_spring<Scalar>::of(secant, kernels::smaller(s.settling * s.stiffness, damping));
  }
  /// True if a surface of K [N/m] comes to rest with this spring (settles() in sampled_spring.hpp).
  [[nodiscard]] constexpr bool settles(Scalar K) const noexcept {
    const Scalar least =
        rule_.mass() * (Scalar(1) - softness_);  // several have a stiffness of up to K/(1 − ε)
    return detail::comes_to_rest(sampled(K), least, sampled_every_, late_);
  }
  /// τ of a bristle [s].
  [[nodiscard]] static constexpr Scalar sliding(const sampled_spring<Scalar>& s) noexcept {
    return s.settling;
  }
  [[nodiscard]] constexpr Scalar softness() const noexcept { return softness_; }  ///< ε

 private:
  detail::damped_mass<Scalar> rule_;
  Scalar softness_, most_;
  Scalar sampled_every_{};  ///< T [s]
  int late_ = 0;            ///< [ticks]
};

/// d' ≤ 3d: on the way in the damper adds at most twice the spring's force, so the force does not step at the touch.
inline constexpr int inward_limit = 3;

/// d' [m] of (S2), the depth with the damper's lead, at an outward speed v [m/s], if the contact pressed with λ [N] in
/// the last tick. A contact that presses only because of the others, d ≤ 0 < λ, is damped like any.
template <class Scalar>
[[nodiscard]] constexpr Scalar damped_depth(const sampled_spring<Scalar>& s, Scalar d, Scalar v,
                                            Scalar lambda) noexcept {
  if (!(v < Scalar(0))) return d - s.settling * v;
  constexpr Scalar more(inward_limit - 1), share = more / Scalar(inward_limit);
  const Scalar most = kernels::larger(more * d, share * lambda * s.compliance);
  return d + kernels::smaller(-s.settling * v, kernels::larger(most, Scalar(0)));
}

/// The problem (S1) with (S2). A row is the effort on the device per newton of λ: n_i or a wrench.
template <class Row, class Scalar, int Capacity>
struct proxy_problem {  // NOLINT(*-member-init): rows from `count` on are not read
  static constexpr auto capacity = static_cast<std::size_t>(Capacity);

  std::array<Row, capacity> row;            ///< n_i
  std::array<Scalar, capacity> wish;        ///< d'_i [m]
  std::array<Scalar, capacity> compliance;  ///< c_i = 1/K_i [m/N]
  std::array<Scalar, capacity> own;         ///< A_ii [m/N], c_i for a point
  std::array<Scalar, capacity> pressed;     ///< λ_i [N], also the start of the iteration
  std::size_t count = 0;

  /// Adds a contact: A_ii [m/N], its depth d [m], its outward speed v [m/s], and λ of the last tick [N].
  constexpr void add(const Row& n, Scalar yields, const sampled_spring<Scalar>& s, Scalar d,
                     Scalar v, Scalar lambda) noexcept {
    row[count] = n;
    wish[count] = damped_depth(s, d, v, lambda);
    compliance[count] = s.compliance;
    own[count] = yields;
    pressed[count] = lambda;
    ++count;
  }
};

}  // namespace v0
}  // namespace passive_haptics
