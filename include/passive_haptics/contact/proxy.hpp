// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Several contacts at once, as one spring: the massless proxy that they leave in the free space, and the
// coupling that pulls the device to it.
//
//     λ ≥ 0 minimises ½ λᵀAλ − d'ᵀλ,   A_ii = c_i = 1/K_i,   f* = Σ λ_i n_i
//                                      A_ij = (1 − ε) n_i·n_j min(c_i, c_j)                            (S1)
//     d'_i = d_i + min(−τ_i n_i·v, max(2 d_i, ⅔ λ_i(n−1) c_i, 0)),   τ_i = B_i/K_i                     (S2)
//
// Every wall gives way by itself, and what two of them share is the coupling of the stiffer one, so a wall
// that does not press is not felt. One contact alone gives f* = K d − B v exactly. However many there are, and
// however they stand to each other, −f* of planes is the gradient of a convex potential, and it is no steeper
// than K/(1 − ε), K the stiffest that presses: 8 copies of one wall are that wall, where the sum of their
// springs would be 8 times as stiff, and shake. Moving out is damped always; moving in by twice what the spring
// does already at most, so that nothing steps at the touch. The damping dissipates whatever presses.
// Source and proofs: docs/design/contacts.md.

#include <passive_haptics/base/explanation.hpp>
#include <passive_haptics/contact/sampled_spring.hpp>

#include <array>
#include <cstddef>
#include <limits>

namespace passive_haptics {
inline namespace v0 {

/// How the contacts of a device press. K and B of each as damped_spring has them, K at most (1 − ε) κ m/T²; the
/// damping is two-sided, or shallow cones swing on.
struct proxy_spring {
  double mass{};                    ///< m, apparent mass of the device [kg], a lower bound
  double stiffness_fraction = 0.1;  ///< κ, of m/T²
  double damping_ratio = 1.0;       ///< ζ
  double damping_fraction = 0.5;    ///< β, of m/T
  double softness = 0.05;           ///< ε: 0 would be the god-object, 1 the sum of springs
  double force_limit = std::numeric_limits<double>::infinity();  ///< what the motors hold [N]
  double most = std::numeric_limits<double>::infinity();  ///< what encoder steps are paid for [N/m]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!(most > 0.0)) {
      return {"most", most, "> 0 N/m; a budget of 0 says that nothing is paid for"};
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

  /// From now on for ticks of T at most [s], and commands that are held `late` ticks after they were given.
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
  /// Why a surface of K is shown as no stiffer than that.
  [[nodiscard]] constexpr softened_by softener(Scalar K) const noexcept {
    const Scalar k = sampled(K).stiffness;
    if (!(k < K)) return softened_by::coupling;
    return k < most_ ? softened_by::mass_and_tick : softened_by::encoder_steps;
  }
  /// The same where the motors cannot give K d: the secant F/d, so that a heavy device is stopped all
  /// the way out.
  [[nodiscard]] constexpr bool saturates(const sampled_spring<Scalar>& s, Scalar d) const noexcept {
    return s.stiffness * d > rule_.force_limit();
  }
  [[nodiscard]] constexpr sampled_spring<Scalar> saturated(const sampled_spring<Scalar>& s,
                                                           Scalar d) const noexcept {
    const Scalar secant = rule_.force_limit() / d;
    const Scalar damping = rule_.critical(secant * rule_.mass());
    return sampled_spring<Scalar>::of(secant, kernels::smaller(s.settling * s.stiffness, damping));
  }
  /// Does a surface of K [N/m] come to rest under this spring? (settles() in sampled_spring.hpp)
  [[nodiscard]] constexpr bool settles(Scalar K) const noexcept {
    const Scalar least = rule_.mass() * (Scalar(1) - softness_);  // many are as steep as K/(1 − ε)
    return detail::comes_to_rest(sampled(K), least, sampled_every_, late_);
  }
  [[nodiscard]] constexpr Scalar softness() const noexcept { return softness_; }  ///< ε

 private:
  detail::damped_mass<Scalar> rule_;
  Scalar softness_, most_;
  Scalar sampled_every_{};  ///< T [s]
  int late_ = 0;            ///< [ticks]
};

/// d' ≤ 3d: on the way in the damper asks for twice what the spring does at most, so nothing steps at the
/// touch.
inline constexpr int inward_limit = 3;

/// d' of (S2): the depth that the spring is asked with, at an outward speed v [m/s], where the contact
/// pressed with λ [N] in the last tick. A contact that only the others press, d ≤ 0 < λ, is damped like any.
template <class Scalar>
[[nodiscard]] constexpr Scalar damped_depth(const sampled_spring<Scalar>& s, Scalar d, Scalar v,
                                            Scalar lambda) noexcept {
  if (!(v < Scalar(0))) return d - s.settling * v;
  constexpr Scalar more(inward_limit - 1), share = more / Scalar(inward_limit);
  const Scalar most = kernels::larger(more * d, share * lambda * s.compliance);
  return d + kernels::smaller(-s.settling * v, kernels::larger(most, Scalar(0)));
}

/// (S1) and (S2): a row is what a contact does to the device for each newton of λ, n_i or a wrench.
template <class Row, class Scalar, int Capacity>
struct proxy_problem {  // NOLINT(*-member-init): rows from `count` on are not read
  static constexpr auto capacity = static_cast<std::size_t>(Capacity);

  std::array<Row, capacity> row;            ///< n_i
  std::array<Scalar, capacity> wish;        ///< d'_i [m]
  std::array<Scalar, capacity> compliance;  ///< c_i = 1/K_i [m/N]
  std::array<Scalar, capacity> own;         ///< A_ii [m/N], c_i for a point
  std::array<Scalar, capacity> pressed;     ///< λ_i [N]; where iteration begins
  std::size_t count = 0;

  /// A contact more: A_ii [m/N], its depth d [m], its outward speed v [m/s], and λ of the last tick [N].
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
