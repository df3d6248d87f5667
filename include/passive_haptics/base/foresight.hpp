// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Foresees the next way d of news (of a number, of what is at a finger, of all nodes of a mesh) from the last ones:
//
//     d̂ₙ₊₁ = a (α d'ₙ + β d'ₙ₋₁),   |d̂ₙ₊₁|² ≤ max(|d'ₙ|², |d'ₙ₋₁|², Σ |d'|²/4)
//     d'ₙ      dₙ, shortened to 2 max(|d'ₙ₋₁|, |d'ₙ₋₂|, |dₙ₋₁| if dₙ·dₙ₋₁ > 0)
//     α, β     least squares Σ |d'ₙ − α d'ₙ₋₁ − β d'ₙ₋₂|² of the news so far, each with 7/8 of the weight of the next;
//              besides (Σ |d'ₙ₋₁|² + Σ |d'ₙ₋₂|²) ((α − 1)² + β²)/50, which keeps them apart
//     a = (3R − 1)/2R ≥ 0,   R² the share of Σ |d'|² that they explain, times 2 (1 + α) where α < −1/2
//
// A steady motion is foreseen, α = 1 and β = 0, and nearly so a sine of the phase θ between news, α = 2 cos θ, β = −1. For
// what jumps and for what begins a is 0, for noise it is small, and it is 0 for a sine that is told less than three times
// a period. By d' one bad update costs no truth later, and nothing is foreseen faster than it went: Σ |d'|²/4 is twice
// the mean. Source: autoregression of second order (Yule 1927), a and d' ours; docs/design/contacts.md § 6.

#include <passive_haptics/base/kernels.hpp>

#include <utility>

namespace passive_haptics {
inline namespace v0 {

/// a of an R² [1]: 1 of what is explained, 0 up to R = 1/3.
template <class Scalar>
[[nodiscard]] constexpr Scalar foreseeable(Scalar explained) noexcept {
  if (!(explained > Scalar(1) / Scalar(9))) return Scalar(0);
  const Scalar R = kernels::smaller(kernels::square_root(explained), Scalar(1));
  return (Scalar(3) * R - Scalar(1)) / (Scalar(2) * R);
}

template <class Scalar>
class foresight {
 public:
  /// Takes dₙ by its products dₙ·dₙ, dₙ·dₙ₋₁ and dₙ·dₙ₋₂.
  constexpr void hear(Scalar own, Scalar next, Scalar second) noexcept {
    const Scalar soon = Scalar(7) / Scalar(10), keeps = Scalar(7) / Scalar(8);
    const way now = shortened(own, next);
    back_ = soon * back_ + next;
    gone_ = soon * gone_ + last_.size * last_.size;
    oldest_ = std::exchange(older_, squares_);
    next_before_ = next_;
    squares_ = keeps * squares_ + now.felt() * now.felt();
    next_ = keeps * next_ + now.part * last_.part * next;
    second_ = keeps * second_ + now.part * before_.part * second;
    before_ = std::exchange(last_, now);
    solve(next);
  }
  /// d̂ₙ₊₁ = last() dₙ + before() dₙ₋₁.
  [[nodiscard]] constexpr Scalar last() const noexcept { return alpha_; }
  [[nodiscard]] constexpr Scalar before() const noexcept { return beta_; }
  /// a, 0 if nothing is foreseen; −1 where goes_back() advises against it.
  [[nodiscard]] constexpr Scalar share() const noexcept {
    return goes_back() ? Scalar(-1) : share_;
  }
  /// True if most of dₙ₋₁ is gone back again, as what yields to a force that it was told late may swing: Σ dₙ·dₙ₋₁ is
  /// below −Σ |dₙ₋₁|²/10, where news count for 0.7 of the next.
  [[nodiscard]] constexpr bool goes_back() const noexcept { return back_ < gone_ / Scalar(-10); }
  /// True if Σ d'ₙ·d'ₙ₋₁ is more than half of Σ |d'ₙ₋₁|², and of |dₙ|².
  [[nodiscard]] constexpr bool is_steady() const noexcept {
    return Scalar(2) * next_ > kernels::larger(older_, last_.size * last_.size);
  }

 private:
  struct way {
    Scalar size{}, part{1};  ///< |d|, |d'|/|d|
    [[nodiscard]] constexpr Scalar felt() const noexcept { return size * part; }
  };
  [[nodiscard]] constexpr Scalar usual() const noexcept {
    return kernels::larger(last_.felt(), before_.felt());
  }
  [[nodiscard]] constexpr way shortened(Scalar own, Scalar next) const noexcept {
    const Scalar size = kernels::square_root(own),
                 onwards = next > Scalar(0) ? last_.size : Scalar(0);
    const Scalar most = Scalar(2) * kernels::larger(usual(), onwards);
    return {size, size > most ? most / size : Scalar(1)};
  }
  constexpr void solve(Scalar next) noexcept {
    share_ = alpha_ = beta_ = Scalar(0);
    const Scalar one = Scalar(1), close = (older_ + oldest_) / Scalar(50);
    const Scalar p = older_ + close, q = oldest_ + close, r = next_ + close;
    const Scalar det = p * q - next_before_ * next_before_;
    if (!kernels::is_finite(det)) return void(*this = {});
    if (!(det > Scalar(0)) || !(squares_ > Scalar(0))) return;
    const Scalar alpha = (r * q - second_ * next_before_) / det;
    const Scalar beta = (second_ * p - r * next_before_) / det;
    const Scalar missed = squares_ + alpha * (alpha * older_ - Scalar(2) * next_) +
                          beta * (beta * oldest_ - Scalar(2) * second_) +
                          Scalar(2) * alpha * beta * next_before_;
    const Scalar often = kernels::clamped(Scalar(2) * (one + alpha), Scalar(0), one);
    const Scalar share = often * foreseeable(one - missed / squares_);
    if (!(share > Scalar(0))) return;
    share_ = share;
    alpha_ = share * alpha * last_.part;
    beta_ = share * beta * before_.part;
    const Scalar a = alpha_ * last_.size, b = beta_ * before_.size;
    const Scalar square = a * a + b * b + Scalar(2) * alpha_ * beta_ * next;
    const Scalar most = kernels::larger(usual() * usual(), squares_ / Scalar(4));
    if (square > most) {
      const Scalar part = kernels::square_root(most / square);
      alpha_ *= part;
      beta_ *= part;
    }
  }

  way last_{}, before_{};
  Scalar squares_{}, older_{}, oldest_{};  ///< Σ |d'ₙ|², and as it was one and two news ago
  Scalar next_{}, next_before_{};          ///< Σ d'ₙ·d'ₙ₋₁, and as it was
  Scalar second_{};                        ///< Σ d'ₙ·d'ₙ₋₂
  Scalar back_{}, gone_{};             ///< Σ dₙ·dₙ₋₁, Σ |dₙ₋₁|², of the last few
  Scalar alpha_{}, beta_{}, share_{};  ///< of dₙ and dₙ₋₁, a
};

}  // namespace v0
}  // namespace passive_haptics
