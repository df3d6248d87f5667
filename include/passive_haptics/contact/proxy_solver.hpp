// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Finds the λ ≥ 0 that minimises ½ λᵀAλ − d'ᵀλ, A positive definite: λ ≥ 0 and Aλ ≥ d', with equality in one of
// the two in each row. (S1 of proxy.hpp)
//
//   up to three rows   in closed form: one of the seven sets of pressing contacts is the solution
//   more               by active sets, from those that pressed in the last tick. The objective falls with
//                      each change, so it ends. If it is stopped before, λ ≥ 0 still, and the bound limits the force.

#include <passive_haptics/contact/proxy.hpp>

namespace passive_haptics {
inline namespace v0 {

namespace detail {

/// Solves up to three rows. `between`(i, j) is A_ij, i ≠ j [m/N].
template <class Row, class Scalar, int Capacity>
constexpr void solve_exactly(proxy_problem<Row, Scalar, Capacity>& p, auto between_rows) noexcept {
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
  }
  if (!any) return;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) opposite[3 - i - j] = between_rows(i, j);
  }

  for (std::size_t i = 0; i < n; ++i) {  // one of them
    if (!(b[i] > none)) continue;
    bool fits = true;  // by the products of `other` below: one of them or two, however they round
    for (std::size_t j = 0; j < n; ++j)
      fits = fits && (j == i || b[j] * own[i] <= between(i, j) * b[i]);
    if (fits) {
      p.pressed[i] = b[i] / own[i];
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

/// The contacts S that press, and A_SS = L Lᵀ of them.
template <class Row, class Scalar, int Capacity>
class active_set {
  static constexpr auto capacity = static_cast<std::size_t>(Capacity);

 public:
  using problem = proxy_problem<Row, Scalar, Capacity>;
  constexpr explicit active_set(problem& p) noexcept : p_(p) {
    for (std::size_t i = 0; i < p_.count; ++i) {
      if (p_.pressed[i] > Scalar(0)) join(i);
    }
  }
  constexpr void join(std::size_t i) noexcept {
    in_[count_++] = i;
    is_in_[i] = true;
  }

  /// Moves λ of S towards the solution of A_SS λ = d' until one of them is zero, which then leaves S. Returns true if
  /// it reached the solution.
  constexpr bool step(auto between) noexcept {
    for (; factored_ < count_; ++factored_) append(between);
    std::array<Scalar, capacity> goal{};  // of A_SS λ = d', by Lᵀ
    Scalar share(1);
    for (std::size_t k = count_; k-- > 0;) {
      Scalar rest = half_[k];
      for (std::size_t m = k + 1; m < count_; ++m) rest -= root_[m][k] * goal[m];
      goal[k] = rest * inverse_[k];
      const Scalar now = p_.pressed[in_[k]];
      if (!(goal[k] > Scalar(0))) share = kernels::smaller(share, Scalar(now / (now - goal[k])));
    }
    std::size_t kept = 0;
    for (std::size_t k = 0; k < count_; ++k) {
      const std::size_t i = in_[k];
      const Scalar now = p_.pressed[i];
      const bool stops = !(goal[k] > Scalar(0)) && !(now > share * (now - goal[k]));
      p_.pressed[i] = stops ? Scalar(0) : Scalar(now + share * (goal[k] - now));
      if (stops) {
        is_in_[i] = false;
        factored_ = k < factored_ ? k : factored_;
      } else {
        in_[kept++] = i;
      }
    }
    const bool stuck = kept == count_ && share < Scalar(1);
    count_ = kept;
    if (stuck) [[unlikely]]
      leave(goal);
    return share == Scalar(1);
  }
  /// d' − Aλ of a contact outside of S [m]; > 0 if it has to press, too.
  [[nodiscard]] constexpr Scalar missing(std::size_t i, auto between) const noexcept {
    Scalar rest = p_.wish[i];
    for (std::size_t k = 0; k < count_; ++k) rest -= between(i, in_[k]) * p_.pressed[in_[k]];
    return rest;
  }
  [[nodiscard]] constexpr bool has(std::size_t i) const noexcept { return is_in_[i]; }

 private:
  /// Takes the least λ whose `goal` is ≤ 0 out of S. What rounding left of it, 4e-323 N, would stop all others for ever.
  [[gnu::cold, gnu::noinline]] constexpr void leave(
      const std::array<Scalar, capacity>& goal) noexcept {
    std::size_t least = count_;
    for (std::size_t k = 0; k < count_; ++k) {
      if (goal[k] > Scalar(0)) continue;
      if (least == count_ || p_.pressed[in_[k]] < p_.pressed[in_[least]]) least = k;
    }
    p_.pressed[in_[least]] = Scalar(0);
    is_in_[in_[least]] = false;
    factored_ = least;
    for (--count_; least < count_; ++least) in_[least] = in_[least + 1];
  }
  /// Appends a row to L and to L⁻¹d'.
  constexpr void append(auto between) noexcept {
    const std::size_t k = factored_, i = in_[k];
    Scalar square = p_.own[i], half = p_.wish[i];
    for (std::size_t m = 0; m < k; ++m) {
      Scalar entry = between(i, in_[m]);
      for (std::size_t l = 0; l < m; ++l) entry -= root_[k][l] * root_[m][l];
      entry *= inverse_[m];
      root_[k][m] = entry;
      square -= entry * entry;
      half -= entry * half_[m];
    }
    inverse_[k] = Scalar(1) / kernels::square_root(square);
    half_[k] = half * inverse_[k];
  }

  problem& p_;
  std::array<std::size_t, capacity> in_;  // S, in the order of the rows of L
  std::array<bool, capacity> is_in_{};
  std::array<std::array<Scalar, capacity>, capacity> root_;  // L, below its diagonal
  std::array<Scalar, capacity> inverse_, half_;              // 1/L_kk, L⁻¹d'
  std::size_t count_ = 0, factored_ = 0;
};

/// Solves any number of rows by active sets.
template <class Row, class Scalar, int Capacity>
constexpr void solve_by_sets(proxy_problem<Row, Scalar, Capacity>& p, auto between) noexcept {
  active_set<Row, Scalar, Capacity> set(p);
  Scalar widest(0);
  for (std::size_t i = 0; i < p.count; ++i) {
    widest = kernels::larger(widest, p.wish[i]);  // what is far away presses nothing
  }
  const Scalar slack = kernels::rounding<Scalar>() * widest;
  for (int change = 0; change < 4 * Capacity; ++change) {
    if (!set.step(between)) continue;
    std::size_t worst = 0;
    Scalar most = slack;
    for (std::size_t i = 0; i < p.count; ++i) {
      if (set.has(i)) continue;
      const Scalar missing = set.missing(i, between);
      if (missing > most) {
        most = missing;
        worst = i;
      }
    }
    if (!(most > slack)) return;
    set.join(worst);
  }
}

}  // namespace detail

/// Writes λ of (S1) into `pressed`. `between`(i, j) is A_ij [m/N] of two rows, i ≠ j.
template <class Row, class Scalar, int Capacity>
constexpr void solve(proxy_problem<Row, Scalar, Capacity>& p, auto between) noexcept {
  if constexpr (Capacity > 3) {
    if (p.count > 3) {
      detail::solve_by_sets(p, between);
      return;
    }
  }
  detail::solve_exactly(p, between);
}

}  // namespace v0
}  // namespace passive_haptics
