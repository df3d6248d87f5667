// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The curvature κ [1/m] of a surface that is told by its tangent planes, so that it goes on between updates as it went:
//
//     n(x) = n + κ s,   depth d − κ |s|²/2,   s = x − p less its part along n
//     κ = a Σ Δn·Δp / Σ |Δp|²    of the updates so far, each with 7/8 of the weight of the next
//     a = (3R − 1)/2R ≥ 0,       1 − R² the share of Σ |Δn|² that the κ of their time, with a = 1, did not foresee
//
// n and p are the normal and the point of the newest plane, d [m] is the depth of x in it, and Δ the change between
// updates. p is the point that is touched, unless
//
//     |s| > (2 + age/P) times the larger of the device's last two ways, or twice that if p was taken for it so far
//     Σ (Δp·n − s·Δn)² < Σ (s·Δn)²/64,   as a point goes that lies beside the one touched
//
// Then the place of the device when the surface was asked stands for p, as its last two ways and the age tell it, and in
// the first case its way for Δp. P [s] is the mean time of those ways. The surface goes straight on beyond the |s| of the
// update and twice the larger way. So an edge, noise and a plane that turns by itself bend nothing.
// Source: ours; docs/design/contacts.md § 6.

#include <passive_haptics/base/foresight.hpp>

namespace passive_haptics {
inline namespace v0 {

/// The bend of the surface of one contact. Normals are unit vectors; what is no finite number makes it flat, once.
template <class Space>
class bending {
 public:
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;

  [[nodiscard]] constexpr bool is_curved() const noexcept { return curvature_ != scalar(0); }
  /// What the surface has fallen away by from the plane of that normal at x [m], below 0 in a hollow, and its normal there.
  struct bent {
    scalar sag;
    vector normal;
  };
  [[nodiscard]] constexpr bent at(const vector& normal, const vector& x) const noexcept {
    if (!is_curved()) return {scalar(0), normal};
    const vector s = beside(normal, Space::difference(x, base_));
    const scalar size = Space::norm(s), part = size > most_ ? most_ / size : scalar(1);
    return {curvature_ * part * size * (size - part * size / scalar(2)),
            tilted(normal, s, part * curvature_)};
  }
  /// A normal after a way of the device [m].
  [[nodiscard]] constexpr vector onwards(const vector& normal, const vector& way) const noexcept {
    return is_curved() ? tilted(normal, beside(normal, way), curvature_) : normal;
  }

  /// An update of a contact: the planes before and now, the device at x after its way [m] since the one before, the time
  /// that it took, and the age of the news [s].
  constexpr void hear(const auto& before, const auto& now, const vector& x, const vector& way,
                      scalar took, scalar age) noexcept {
    const vector normal = now.normal, turn = normal - vector(before.normal);
    const vector off = Space::difference(x, now.point), old = way_;
    const vector shift = Space::difference(now.point, before.point);
    const scalar beside_it = Space::norm(beside(normal, off));
    const scalar usual = kernels::larger(Space::norm(way), Space::norm(old));
    const scalar ages = scalar(2) * age / (took + took_);
    is_near_ = beside_it <= (scalar(2) + ages) * usual * scalar(is_near_ ? 2 : 1);
    fit(turn, is_near_ ? shift : way);

    const scalar strayed = Space::dot(turn, off);
    const scalar rose = Space::dot(shift, vector(normal + vector(before.normal))) / scalar(2);
    not_so_ = keeps() * not_so_ + (rose - strayed) * (rose - strayed);
    strays_ = keeps() * strays_ + strayed * strayed;
    if (!kernels::is_finite(missed_ + squares_ + curvature_ + not_so_ + strays_)) *this = {};
    if (is_near_ && !(scalar(64) * not_so_ < strays_)) {
      base_ = now.point;
      most_ = scalar(2) * usual + beside_it;
    } else {
      const vector since = (way + old) * (kernels::smaller(ages, scalar(4)) / scalar(2));
      base_ = vector(x - since);
      most_ = scalar(2) * usual + Space::norm(since);
    }
    way_ = way;
    took_ = took;
  }

 private:
  static constexpr scalar keeps() noexcept { return scalar(7) / scalar(8); }

  /// Takes Δn and Δp.
  constexpr void fit(const vector& turn, const vector& shift) noexcept {
    const scalar turns = Space::dot(turn, turn), both = Space::dot(turn, shift),
                 square = Space::dot(shift, shift);
    missed_ = keeps() * missed_ + turns + fits_ * (fits_ * square - scalar(2) * both);
    turns_ = keeps() * turns_ + turns;
    squares_ = keeps() * squares_ + square;
    both_ = keeps() * both_ + both;
    fits_ = squares_ > scalar(0) ? both_ / squares_ : scalar(0);
    curvature_ = turns_ > scalar(0) ? fits_ * foreseeable(scalar(1) - missed_ / turns_) : scalar(0);
  }
  [[nodiscard]] static constexpr vector beside(const vector& normal, const vector& way) noexcept {
    return way - normal * Space::dot(way, normal);
  }
  [[nodiscard]] static constexpr vector tilted(const vector& normal, const vector& s,
                                               scalar curvature) noexcept {
    const vector further = normal + s * curvature;
    return further / Space::norm(further);
  }

  typename Space::coordinates base_ = Space::zero();  ///< p, or what stands for it [m]
  typename Space::coordinates way_ = Space::zero();   ///< of the device before the last update [m]
  scalar took_{};                                     ///< the time of it [s]
  scalar most_{};                ///< the largest |s| up to which the surface bends [m]
  scalar turns_{}, missed_{};    ///< Σ |Δn|², and Σ |Δn − κ Δp|² by the κ of the time
  scalar squares_{}, both_{};    ///< Σ |Δp|² [m²], Σ Δn·Δp [m]
  scalar strays_{}, not_so_{};   ///< Σ (s·Δn)², Σ (Δp·n − s·Δn)² [m²]
  scalar fits_{}, curvature_{};  ///< κ with a = 1, κ [1/m]
  bool is_near_ = true;          ///< p is as near as the point touched is
};

}  // namespace v0
}  // namespace passive_haptics
