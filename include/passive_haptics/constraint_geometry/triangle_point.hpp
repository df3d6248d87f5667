// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The point of a triangle that is closest to a given point, for surfaces that are made of triangles.

#include <passive_haptics/device/eigen_space.hpp>
#include <passive_haptics/port/concepts.hpp>

#include <array>

namespace passive_haptics {
inline namespace v0 {
namespace detail {

/// The outward normal of a triangle.
template <class Space>
struct facing {
  typename Space::vector normal;  ///< unit
  bool usable;                    ///< false if the triangle's height is lost in rounding (A17)
};

/// The normal of a, b, c, counter-clockwise seen from outside.
template <class Space>
[[nodiscard, gnu::always_inline]] constexpr facing<Space> facing_of(
    const typename Space::vector& a, const typename Space::vector& b,
    const typename Space::vector& c) noexcept {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  const auto square = [](const vector& v) { return Space::dot(v, v); };
  const vector n = Space::cross(vector(b - a), vector(c - a));
  const scalar twice_area = Space::norm(n);
  const scalar longest =
      kernels::larger(kernels::larger(square(b - a), square(c - a)), square(c - b));
  const scalar smallest = scalar(16) * std::numeric_limits<scalar>::epsilon() * longest;
  if (!(twice_area > smallest) || !kernels::is_finite(twice_area)) return {Space::zero(), false};
  const vector normal = n / twice_area;
  return {normal, Space::is_finite(normal)};
}

/// A point of a triangle and its barycentric coordinates.
template <class Space>
struct triangle_point {
  typename Space::vector point;  ///< [m]
  std::array<typename Space::scalar, 3>
      weights;  ///< barycentric; exactly zero for a corner that has no part
};

/// The point of the triangle a, b, c closest to x: the projection of x on its plane if that lies within the edges,
/// else the closest point of the edges that x is beyond. Rounding can confuse a face, an edge and a corner only
/// where they meet. The triangle must have an area.
template <class Space>
[[nodiscard]] constexpr triangle_point<Space> closest_on_triangle(
    const typename Space::vector& a, const typename Space::vector& b,
    const typename Space::vector& c, const typename Space::vector& x) noexcept {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  const vector ab = b - a, ac = c - a, r = x - a;
  const vector n = Space::cross(ab, ac);
  const scalar area = Space::dot(n, n);
  const scalar of_b = Space::dot(Space::cross(r, ac), n) / area;
  const scalar of_c = Space::dot(Space::cross(ab, r), n) / area;
  const scalar of_a = scalar(1) - of_b - of_c;
  const std::array<scalar, 3> share{of_a, of_b, of_c};
  if (of_a > scalar(0) && of_b > scalar(0) && of_c > scalar(0)) {
    return {vector(a + ab * of_b + ac * of_c), share};
  }
  const std::array<const vector*, 3> corner{&a, &b, &c};
  triangle_point<Space> best{a, {scalar(1), scalar(0), scalar(0)}};
  scalar shortest = kernels::largest<scalar>();
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (share[(i + 2) % 3] > scalar(0)) continue;  // x is on the inner side of this edge
    const vector edge = *corner[j] - *corner[i];
    const vector way = x - *corner[i];
    const scalar s = kernels::clamped(scalar(Space::dot(way, edge) / Space::dot(edge, edge)),
                                      scalar(0), scalar(1));
    const vector missing = way - edge * s;
    const scalar squared = Space::dot(missing, missing);
    if (!(squared < shortest)) continue;
    shortest = squared;
    best.point = *corner[i] + edge * s;
    best.weights = {};
    best.weights[i] = scalar(1) - s;
    best.weights[j] = s;
  }
  return best;
}

}  // namespace detail
}  // namespace v0
}  // namespace passive_haptics
