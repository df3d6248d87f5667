// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Several contacts at once, as one spring: the massless proxy that they leave in the free space, and the
// coupling that pulls the device to it.
//
//     λ ≥ 0 minimises ½ λᵀAλ − d'ᵀλ,   A_ij = n_i·n_j/K_c,  A_ii = 1/K_i,   f* = Σ λ_i n_i              (S1)
//     d' = min(d − (B/K) n·v, 3d) where d > 0,  d elsewhere                                           (S2)
//
// with K_c = max K_i/(1 − ε): every wall gives way by itself, and all of them pull at one coupling K_c. One
// contact alone gives f* = K d − B v exactly. However many there are, and however they stand to each other,
// −f* of planes is the gradient of a convex potential and |f*(x) − f*(y)| ≤ K_c |x − y|: 8 copies of one
// wall are that wall, where the sum of their springs would be 8 times as stiff, and shake.
// Source and proofs: docs/design/contacts.md.

#include <passive_haptics/contact/sampled_spring.hpp>

#include <array>
#include <cstddef>
#include <limits>

namespace passive_haptics {
inline namespace v0 {

/// How the contacts of a device press. K and B of each as damped_spring has them, K at most (1 − ε) κ m/T²;
/// the damping is two-sided, or shallow cones swing on; on the way in it adds no more than the spring has, so that nothing
/// steps at the touch.
struct proxy_spring {
  double mass{};                    ///< m, apparent mass of the device [kg], a lower bound
  double stiffness_fraction = 0.1;  ///< κ, of m/T²
  double damping_ratio = 1.0;       ///< ζ
  double damping_fraction = 0.5;    ///< β, of m/T
  double softness = 0.05;           ///< ε: 0 would be the god-object, 1 the sum of springs
  double force_limit = std::numeric_limits<double>::infinity();  ///< what the motors hold [N]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    return detail::sampled_fault(*this);
  }
  template <class Scalar>
  class at;
};

template <class Scalar>
class proxy_spring::at {
 public:
  constexpr explicit at(const proxy_spring& p) noexcept
      : rule_(p), softness_(detail::number<Scalar>(p.softness)) {}
  [[nodiscard]] constexpr proxy_spring parameters() const noexcept {
    proxy_spring p;
    rule_.state(p);
    p.softness = static_cast<double>(softness_);
    return p;
  }

  /// From now on for ticks of T at most [s].
  constexpr void adopt(Scalar T) noexcept { sampled_every_ = T; }
  /// K = min(K, (1 − ε) κ m/T²) and B = min(2ζ√(Km), β m/T).
  [[nodiscard]] constexpr sampled_spring<Scalar> sampled(Scalar K) const noexcept {
    const Scalar k = rule_.stiffness(K, softness_, sampled_every_);
    return sampled_spring<Scalar>::of(k, rule_.damping(k, sampled_every_));
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
  [[nodiscard]] constexpr Scalar softness() const noexcept { return softness_; }  ///< ε

 private:
  detail::damped_mass<Scalar> rule_;
  Scalar softness_;
  Scalar sampled_every_{};  ///< T [s]
};

/// d' ≤ 3d: on the way in the damper asks for twice what the spring does at most, so nothing steps at the
/// touch. With 2d a heavy device swings in a shallow cone for 9.4 s, with 3d for 7.7 (docs/design/contacts.md).
inline constexpr int inward_limit = 3;

/// d' of (S2): the depth that the spring is asked with, at an outward speed v [m/s].
template <class Scalar>
[[nodiscard]] constexpr Scalar damped_depth(const sampled_spring<Scalar>& s, Scalar d,
                                            Scalar v) noexcept {
  if (!(d > Scalar(0))) return d;
  return kernels::smaller(d - s.settling * v, Scalar(inward_limit) * d);
}

/// (S1) times the largest stiffness K. A row is what a contact does to the device: n_i, or a wrench.
template <class Row, class Scalar, int Capacity>
struct proxy_problem {
  static constexpr auto capacity = static_cast<std::size_t>(Capacity);

  std::array<Row, capacity> row;           ///< n_i
  std::array<Scalar, capacity> wish{};     ///< K d'_i [N]
  std::array<Scalar, capacity> own{};      ///< K A_ii, K/K_i for a point
  std::array<Scalar, capacity> pressed{};  ///< λ_i [N]; where iteration begins
  std::size_t count = 0;

  /// A contact more, by its depth d' [m] and its compliance [m/N].
  constexpr void add(const Row& n, Scalar depth, Scalar compliance, Scalar lambda) noexcept {
    row[count] = n;
    wish[count] = depth;
    own[count] = compliance;
    pressed[count] = lambda;
    ++count;
  }
  /// When all are there: from depths and compliances to `wish` and `own`, K [N/m] the scale.
  constexpr void couple(Scalar K) noexcept {
    for (std::size_t i = 0; i < count; ++i) {
      wish[i] *= K;
      own[i] *= K;
    }
  }
};

namespace detail {

/// (S1) in closed form for up to three rows: of the seven sets of contacts that may press, strict
/// convexity lets one fit. `dot` is the inner product of rows.
template <class Row, class Scalar, int Capacity>
constexpr void solve_exactly(proxy_problem<Row, Scalar, Capacity>& p, auto dot) noexcept {
  constexpr Scalar none(0);
  const std::size_t n = p.count;
  const auto& b = p.wish;
  const auto& own = p.own;
  if constexpr (Capacity == 1) {
    if (n == 1) p.pressed[0] = b[0] > none ? Scalar(b[0] / own[0]) : none;
    return;
  }
  std::array<Scalar, 3> opposite{};  // A_jk at the index of the third
  const auto between = [&opposite](std::size_t i, std::size_t j) { return opposite[3 - i - j]; };
  bool any = false;
  for (std::size_t i = 0; i < n; ++i) {
    p.pressed[i] = none;
    any = any || b[i] > none;
    for (std::size_t j = i + 1; j < n; ++j) opposite[3 - i - j] = dot(p.row[i], p.row[j]);
  }
  if (!any) return;

  for (std::size_t i = 0; i < n; ++i) {  // one of them
    if (!(b[i] > none)) continue;
    const Scalar alone = b[i] / own[i];
    bool fits = true;
    for (std::size_t j = 0; j < n; ++j) fits = fits && (j == i || b[j] <= between(i, j) * alone);
    if (fits) {
      p.pressed[i] = alone;
      return;
    }
  }
  for (std::size_t i = 0; i < n; ++i) {  // two of them
    for (std::size_t j = i + 1; j < n; ++j) {
      const std::size_t k = 3 - i - j;
      const Scalar a = between(i, j);
      const Scalar one = b[i] * own[j] - a * b[j];
      const Scalar other = b[j] * own[i] - a * b[i];
      if (!(one >= none && other >= none)) continue;
      const Scalar det = own[i] * own[j] - a * a;
      if (n < 3 || b[k] * det <= between(i, k) * one + between(j, k) * other) {
        p.pressed[i] = one / det;
        p.pressed[j] = other / det;
        return;
      }
    }
  }
  if (n < 3) return;
  const Scalar a12 = opposite[0], a02 = opposite[1], a01 = opposite[2];  // all: Cramer's rule
  const Scalar c00 = own[1] * own[2] - a12 * a12;
  const Scalar c11 = own[0] * own[2] - a02 * a02;
  const Scalar c22 = own[0] * own[1] - a01 * a01;
  const Scalar c01 = a12 * a02 - a01 * own[2];
  const Scalar c02 = a01 * a12 - a02 * own[1];
  const Scalar c12 = a01 * a02 - a12 * own[0];
  const Scalar scale = Scalar(1) / (own[0] * c00 + a01 * c01 + a02 * c02);
  p.pressed[0] = kernels::larger((c00 * b[0] + c01 * b[1] + c02 * b[2]) * scale, none);
  p.pressed[1] = kernels::larger((c01 * b[0] + c11 * b[1] + c12 * b[2]) * scale, none);
  p.pressed[2] = kernels::larger((c02 * b[0] + c12 * b[1] + c22 * b[2]) * scale, none);
}

/// (S1) by at most `sweeps` of projected Gauss-Seidel from the λ that are there. Any λ ≥ 0 is safe, because
/// the bound meets any force: what has not converged is felt, never paid for. What is missing,
/// d' − Aλ, is kept up to date row by row, so a contact that does not press costs a comparison.
template <class Row, class Scalar, int Capacity>
constexpr void solve_by_sweeps(proxy_problem<Row, Scalar, Capacity>& p, auto dot,
                               int sweeps) noexcept {
  constexpr auto capacity = proxy_problem<Row, Scalar, Capacity>::capacity;
  const std::size_t n = p.count;
  std::array<std::array<Scalar, capacity>, capacity> shared{};  // A, row by row
  std::array<Scalar, capacity> missing{}, inverse{};
  for (std::size_t i = 0; i < n; ++i) {
    shared[i][i] = p.own[i];
    inverse[i] = Scalar(1) / p.own[i];
    missing[i] = p.wish[i];
    for (std::size_t j = 0; j < i; ++j) shared[i][j] = shared[j][i] = dot(p.row[i], p.row[j]);
  }
  const auto press = [&](std::size_t i, Scalar change) {
    for (std::size_t k = 0; k < capacity; ++k) missing[k] -= shared[i][k] * change;
  };
  for (std::size_t i = 0; i < n; ++i) {
    if (p.pressed[i] > Scalar(0)) press(i, p.pressed[i]);
  }
  bool settled = false;
  for (int s = 0; s < sweeps && !settled; ++s) {
    settled = true;
    for (std::size_t i = 0; i < n; ++i) {
      const Scalar was = p.pressed[i];
      const Scalar now = kernels::larger(was + missing[i] * inverse[i], Scalar(0));
      const Scalar change = now - was;
      if (change == Scalar(0)) continue;
      settled = settled && kernels::magnitude(change) <= kernels::rounding<Scalar>() * now;
      press(i, change);
      p.pressed[i] = now;
    }
  }
}

}  // namespace detail

/// λ of (S1) into `pressed`.
template <class Row, class Scalar, int Capacity>
constexpr void solve(proxy_problem<Row, Scalar, Capacity>& p, auto dot, int sweeps) noexcept {
  if constexpr (Capacity > 3) {
    if (p.count > 3) {
      detail::solve_by_sweeps(p, dot, sweeps);
      return;
    }
  }
  detail::solve_exactly(p, dot);
}

}  // namespace v0
}  // namespace passive_haptics
