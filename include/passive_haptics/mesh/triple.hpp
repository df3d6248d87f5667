// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Three numbers, a box of them, and the point of a triangle that is closest to another one: what a mesh is
// searched with. They are plain, so that they cross threads and stand in a port.

#include <passive_haptics/base/kernels.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace passive_haptics {
inline namespace v0 {
namespace mesh {

/// A point [m], a displacement [m], a direction.
struct triple {
  double x = 0.0, y = 0.0, z = 0.0;

  [[nodiscard]] constexpr double operator[](int i) const noexcept {
    return i == 0 ? x : i == 1 ? y : z;
  }
  friend constexpr triple operator+(const triple& a, const triple& b) noexcept {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend constexpr triple operator-(const triple& a, const triple& b) noexcept {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend constexpr triple operator*(const triple& a, double s) noexcept {
    return {a.x * s, a.y * s, a.z * s};
  }
  friend constexpr bool operator==(const triple& a, const triple& b) noexcept = default;
};

[[nodiscard]] constexpr double dot(const triple& a, const triple& b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
[[nodiscard]] constexpr triple cross(const triple& a, const triple& b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
[[nodiscard]] constexpr double squared(const triple& a) noexcept {
  return dot(a, a);
}
[[nodiscard]] constexpr double length(const triple& a) noexcept {
  return kernels::square_root(squared(a));
}
[[nodiscard]] constexpr bool is_finite(const triple& a) noexcept {
  return kernels::is_finite(a.x) && kernels::is_finite(a.y) && kernels::is_finite(a.z);
}
/// a + s (b − a).
[[nodiscard]] constexpr triple between(const triple& a, const triple& b, double s) noexcept {
  return a + (b - a) * s;
}

/// The points between two corners [m]; as it is made, none.
struct box {
  triple low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  constexpr void grow(const triple& p) noexcept { grow({p, p}); }
  constexpr void grow(const box& b) noexcept {
    low = {(std::min)(low.x, b.low.x), (std::min)(low.y, b.low.y), (std::min)(low.z, b.low.z)};
    high = {(std::max)(high.x, b.high.x), (std::max)(high.y, b.high.y),
            (std::max)(high.z, b.high.z)};
  }
  /// The squared distance [m²] of p; infinite of a box of no points.
  [[nodiscard]] constexpr double squared_distance(const triple& p) const noexcept {
    const auto beyond = [](double low_end, double high_end, double at) {
      return (std::max)((std::max)(low_end - at, at - high_end), 0.0);
    };
    return squared(
        triple{beyond(low.x, high.x, p.x), beyond(low.y, high.y, p.y), beyond(low.z, high.z, p.z)});
  }
  /// Half of its area [m²]; 0 of a box of no points.
  [[nodiscard]] constexpr double half_area() const noexcept {
    const triple side = high - low;
    return side.x >= 0.0 ? side.x * side.y + side.y * side.z + side.z * side.x : 0.0;
  }
  /// The largest n·p of its points.
  [[nodiscard]] constexpr double farthest_along(const triple& n) const noexcept {
    return n.x * (n.x > 0.0 ? high.x : low.x) + n.y * (n.y > 0.0 ? high.y : low.y) +
           n.z * (n.z > 0.0 ? high.z : low.z);
  }
};

/// The corners of a triangle [m].
using corners = std::array<triple, 3>;

[[nodiscard]] constexpr triple point_at(const corners& t, const triple& weights) noexcept {
  return t[0] * weights.x + t[1] * weights.y + t[2] * weights.z;
}

/// Barycentric weights of the point of the triangle that is closest to p, each ≥ 0, together 1. Of a triangle
/// without a usable area its edges count, and of an edge without a length its end.
[[nodiscard]] constexpr triple closest_weights(const corners& t, const triple& p) noexcept {
  const triple ab = t[1] - t[0], ac = t[2] - t[0], r = p - t[0];
  const triple n = cross(ab, ac);
  const double area = squared(n), longest = (std::max)(squared(ab), squared(ac));
  double share[3] = {0.0, 0.0, 0.0};
  if (area > 1e-18 * longest * longest) {
    share[1] = dot(cross(r, ac), n) / area;
    share[2] = dot(cross(ab, r), n) / area;
    share[0] = 1.0 - share[1] - share[2];
    if (share[0] > 0.0 && share[1] > 0.0 && share[2] > 0.0) return {share[0], share[1], share[2]};
  }
  triple best{1.0, 0.0, 0.0};
  double shortest = box::infinity;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    if (share[k] > 0.0) continue;  // p is on the inner side of this edge
    const triple edge = t[j] - t[i], way = p - t[i];
    const double square = squared(edge);
    const double s = square > 0.0 ? std::clamp(dot(way, edge) / square, 0.0, 1.0) : 0.0;
    const double missing = squared(way - edge * s);
    if (!(missing < shortest)) continue;
    shortest = missing;
    double w[3] = {0.0, 0.0, 0.0};
    w[i] = 1.0 - s;
    w[j] = s;
    best = {w[0], w[1], w[2]};
  }
  return best;
}

}  // namespace mesh
}  // namespace v0
}  // namespace passive_haptics
