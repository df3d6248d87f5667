// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The curvature κ [1/m] of a surface that is told by its tangent planes, so that it goes on between updates as it went:
//
//     n(x) = n + κ s,   depth d − κ |s|²/2,   s = x − p less its part along n
//     κ = a Σ Δn·Δp / Σ |Δp|²    of the updates so far, each with 7/8 of the weight of the next
//     a = (3R − 1)/2R ≥ 0,       1 − R² the share of Σ |Δn|² that the κ of their time, with a = 1, did not foresee
//
// n and p are the normal and the point of the newest plane, d [m] is the depth of x in it, and Δ the change between
// updates. p is the point that is touched: if it is farther off in the plane than the device can have moved since the
// surface was asked, |s| > (2 + age/P) times the larger of its last two ways, or twice as much if it was taken for it so
// far, the place of the device when the surface was asked stands for p, as its last two ways and the age tell it, and its
// way for Δp. P is the mean time of the last two ways. The place of the device stands for p also where the planes say
// that p strays from the surface: Δp·n is −s·Δn then, so Σ (Δp·n)² > Σ |s|²|Δn|²/2. Beyond |s| at the update and twice the larger way
// the surface goes straight on. So an edge, noise and a plane that turns by itself bend nothing. Source: ours;
// docs/design/contacts.md § 6.

#include <passive_haptics/base/foresight.hpp>

namespace passive_haptics {
inline namespace v0 {

template <class Space>
class bending {
 public:
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;

  [[nodiscard]] constexpr bool is_curved() const noexcept { return curvature_ != scalar(0); }
  /// What the surface has fallen away by at x from the plane of that normal [m]; below 0 in a hollow.
  [[nodiscard]] constexpr scalar sag(const vector& normal, const vector& x) const noexcept {
    if (!is_curved()) return scalar(0);
    const scalar s = Space::norm(beside(normal, from_base(x)));
    const scalar bent = kernels::smaller(s, most_);
    return curvature_ * bent * (s - bent / scalar(2));
  }
  /// The normal at x.
  [[nodiscard]] constexpr vector turned(const vector& normal, const vector& x) const noexcept {
    if (!is_curved()) return normal;
    const vector s = beside(normal, from_base(x));
    const scalar size = Space::norm(s);
    return tilted(normal, size > most_ ? vector(s * (most_ / size)) : s);
  }
  /// A normal after a way of the device [m].
  [[nodiscard]] constexpr vector onwards(const vector& normal, const vector& way) const noexcept {
    return is_curved() ? tilted(normal, beside(normal, way)) : normal;
  }

  /// An update of a contact: the planes before and now, the device at x after its way [m] since the one before, the time
  /// that it took, and the age of the news [s].
  constexpr void hear(const auto& before, const auto& now, const vector& x, const vector& way,
                      scalar took, scalar age) noexcept {
    const vector normal = now.normal, turn = normal - vector(before.normal);
    const vector old = way_;
    const scalar moved = Space::norm(way), before_moved = Space::norm(old);
    const scalar usual = kernels::larger(moved, before_moved);
    const scalar ages = scalar(2) * age / (took + took_);
    const vector since_asked = (way + old) * (kernels::smaller(ages, scalar(4)) / scalar(2));
    const scalar off = Space::norm(beside(normal, Space::difference(x, now.point)));
    is_touched_ = off <= (scalar(2) + ages) * usual * scalar(is_touched_ ? 2 : 1);
    const vector further = is_touched_ ? Space::difference(now.point, before.point) : way;
    const scalar keeps = scalar(7) / scalar(8), square = Space::dot(further, further),
                 both = Space::dot(turn, further), turns = Space::dot(turn, turn);
    missed_ = keeps * missed_ + turns + fits_ * (fits_ * square - scalar(2) * both);
    turns_ = keeps * turns_ + turns;
    squares_ = keeps * squares_ + square;
    both_ = keeps * both_ + both;
    fits_ = squares_ > scalar(0) ? both_ / squares_ : scalar(0);
    curvature_ = turns_ > scalar(0) ? fits_ * foreseeable(scalar(1) - missed_ / turns_) : scalar(0);
    if (!kernels::is_finite(missed_ + squares_ + curvature_ + strays_ + may_stray_)) *this = {};
    const scalar beyond = Space::dot(Space::difference(now.point, before.point),
                                     vector(normal + vector(before.normal))) / scalar(2);
    strays_ = keeps * strays_ + beyond * beyond;
    may_stray_ = keeps * may_stray_ + off * off * turns;
    const bool is_on = is_touched_ && scalar(2) * strays_ <= may_stray_;
    most_ = scalar(2) * usual + (is_on ? off : Space::norm(since_asked));
    if (is_on) {
      base_ = now.point;
    } else {
      base_ = vector(x - since_asked);
    }
    way_ = way;
    took_ = took;
  }

 private:
  [[nodiscard]] constexpr vector from_base(const vector& x) const noexcept {
    return Space::difference(x, base_);
  }
  [[nodiscard]] static constexpr vector beside(const vector& normal, const vector& way) noexcept {
    return way - normal * Space::dot(way, normal);
  }
  [[nodiscard]] constexpr vector tilted(const vector& normal, const vector& s) const noexcept {
    const vector further = normal + s * curvature_;
    return further / Space::norm(further);
  }

  typename Space::coordinates base_ = Space::zero();  ///< p [m]
  scalar most_{};                ///< the largest |s| up to which the surface bends [m]
  typename Space::coordinates way_ = Space::zero();  ///< of the device before the last update [m]
  scalar took_{};                ///< and the time of it [s]
  scalar turns_{}, missed_{};    ///< Σ |Δn|², and Σ |Δn − κ Δp|² by the κ of the time
  scalar strays_{}, may_stray_{};  ///< Σ (Δp·n)² [m²], and Σ |s|²|Δn|², which it is if p is not the point touched
  scalar squares_{}, both_{};    ///< Σ |Δp|² [m²], Σ Δn·Δp [m]
  scalar fits_{}, curvature_{};  ///< κ with a = 1, κ [1/m]
  bool is_touched_ = true;       ///< p is the point that is touched
};

}  // namespace v0
}  // namespace passive_haptics
