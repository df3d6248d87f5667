// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Rotates a vector of a surface with the surface's normal.

#include <passive_haptics/device/space.hpp>

namespace passive_haptics {
inline namespace v0 {

/// The vector a, rotated by the smallest rotation that takes the unit normal `from` to the unit normal `to`:
///     a − s (s·a)/(1 + from·to) + 2 to (from·a),   s = from + to
/// (parallel transport along the shorter great circle). It keeps |a|, and a vector orthogonal to `from` becomes
/// orthogonal to `to`. For opposite normals this rotation is not unique, and a is returned unchanged.
template <class Space>
[[nodiscard]] constexpr typename Space::vector carry(const typename Space::vector& a,
                                                     const typename Space::vector& from,
                                                     const typename Space::vector& to) noexcept {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  if constexpr (Space::dof == 1) {
    return a;
  } else {
    const scalar together = scalar(1) + Space::dot(from, to);
    if (!(together > scalar(1) / scalar(1 << 20))) return a;
    const vector sum = from + to;
    return a - sum * (Space::dot(sum, a) / together) + to * (scalar(2) * Space::dot(from, a));
  }
}

}  // namespace v0
}  // namespace passive_haptics
