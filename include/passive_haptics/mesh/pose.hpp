// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The place and the turn of a whole mesh in the world.

#include <passive_haptics/mesh/triple.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace mesh {

/// A place in the world and a turn, as a quaternion w + xi + yj + zk: p ↦ turn(p) + position.
struct pose {
  triple position{};  ///< [m]
  double w = 1.0;     ///< cos of half the angle
  triple axis{};      ///< the axis times sin of half the angle

  /// Makes the quaternion one of length 1; returns false if it has no length or a number is not finite.
  [[nodiscard]] constexpr bool prepare() noexcept {
    const double size = kernels::square_root(w * w + squared(axis));
    if (!(size > 1e-6) || !kernels::is_finite(size) || !is_finite(position)) return false;
    w /= size;
    axis = axis * (1.0 / size);
    return true;
  }
  /// A direction of the mesh as the world sees it.
  [[nodiscard]] constexpr triple out(const triple& v) const noexcept {
    const triple t = cross(axis, v) * 2.0;
    return v + t * w + cross(axis, t);
  }
  /// A direction of the world as the mesh sees it.
  [[nodiscard]] constexpr triple in(const triple& v) const noexcept {
    const triple t = cross(v, axis) * 2.0;
    return v + t * w + cross(t, axis);
  }
  friend constexpr bool operator==(const pose& a, const pose& b) noexcept = default;
};

/// The pose at the share s of the way from a to b; the turn goes the shorter way round.
[[nodiscard]] constexpr pose between(const pose& a, const pose& b, double s) noexcept {
  const double side = a.w * b.w + dot(a.axis, b.axis) < 0.0 ? -1.0 : 1.0;
  pose p{between(a.position, b.position, s), a.w + (side * b.w - a.w) * s,
         between(a.axis, b.axis * side, s)};
  return p.prepare() ? p : b;
}

/// c moved on by x times the way from b to c and y times the way from a to b; the turns go the shorter way round.
[[nodiscard]] constexpr pose onwards(const pose& c, const pose& b, double x, const pose& a,
                                     double y) noexcept {
  const auto side = [&c](const pose& p) {
    return c.w * p.w + dot(c.axis, p.axis) < 0.0 ? -1.0 : 1.0;
  };
  const double older = y - x, oldest = -y, turned = older * side(b), first = oldest * side(a);
  pose p{c.position * (1.0 + x) + b.position * older + a.position * oldest,
         c.w * (1.0 + x) + b.w * turned + a.w * first,
         c.axis * (1.0 + x) + b.axis * turned + a.axis * first};
  return p.prepare() ? p : c;
}

}  // namespace mesh
}  // namespace v0
}  // namespace passive_haptics
