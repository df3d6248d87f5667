// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One triangle: its area, its normal, and the point of it closest to another point.
// force_shares() are the shares of a force that its nodes take:
//
//   barycentric  sⱼ = wⱼ           conserves force AND moment; dual of the linear displacement field
//   by_distance  sⱼ ∝ 1/|P − xⱼ|   the thesis (appendix A.2), for comparison: conserves the force and
//                                  moves its point of action by 0.10 edge in the mean, 0.19 at worst
//                                  (docs/design/audit.md A25)

#include <passive_haptics/base/language.hpp>
#include <passive_haptics/mesh/triple.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

using triangle = std::array<Eigen::Vector3d, 3>;  ///< corners [m], counter-clockwise from outside

// The arithmetic is that of mesh/triple.hpp, plain numbers: expressions of Eigen would take a user's compiler as long
// as all the rest of a program.
[[nodiscard]] inline mesh::triple triple_of(const Eigen::Vector3d& v) noexcept {
  return {v[0], v[1], v[2]};
}
[[nodiscard]] inline Eigen::Vector3d vector_of(const mesh::triple& v) noexcept {
  return {v.x, v.y, v.z};
}
[[nodiscard]] inline mesh::corners triples_of(const triangle& t) noexcept {
  return {triple_of(t[0]), triple_of(t[1]), triple_of(t[2])};
}

/// aᵀ C b.
[[nodiscard]] inline double across(const Eigen::Matrix3d& C, const Eigen::Vector3d& a,
                                   const Eigen::Vector3d& b) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j < 3; ++j) sum += a[i] * C(i, j) * b[j];
  }
  return sum;
}

/// ½ (b − a)×(c − a) [m²]: it is along the normal, and its length is the area.
[[nodiscard]] inline mesh::triple area_of(const mesh::corners& t) noexcept {
  return mesh::cross(t[1] - t[0], t[2] - t[0]) * 0.5;
}
[[nodiscard]] inline Eigen::Vector3d area_vector(const triangle& t) {
  return vector_of(area_of(triples_of(t)));
}

/// True when the triangle has no usable normal: twice its area ≤ 1e-9 of its longest edge squared,
/// or a corner that is not finite. (A17)
[[nodiscard]] inline bool is_degenerate(const mesh::corners& t) noexcept {
  const double longest = (std::max)(
      {mesh::squared(t[1] - t[0]), mesh::squared(t[2] - t[1]), mesh::squared(t[0] - t[2])});
  return !(2.0 * mesh::length(area_of(t)) > 1e-9 * longest) ||
         !(longest < std::numeric_limits<double>::infinity());
}
[[nodiscard]] inline bool is_degenerate(const triangle& t) {
  return is_degenerate(triples_of(t));
}

/// The unit normal n of a triangle that is not degenerate.
[[nodiscard]] inline mesh::triple normal_of(const mesh::corners& t) noexcept {
  const mesh::triple area = area_of(t);
  return area * (1.0 / mesh::length(area));
}
[[nodiscard]] inline Eigen::Vector3d unit_normal(const triangle& t) {
  return vector_of(normal_of(triples_of(t)));
}

/// Σ wⱼ xⱼ [m].
[[nodiscard]] inline Eigen::Vector3d point_at(const triangle& t, const Eigen::Vector3d& weights) {
  return vector_of(mesh::point_at(triples_of(t), triple_of(weights)));
}

/// Barycentric weights of the point of the triangle closest to p [m]: wⱼ ≥ 0, Σ wⱼ = 1, and exactly zero
/// for a corner that is not on the edge or corner of the point. The point is the foot of p on the plane
/// if that lies within all three edges, otherwise the closest point of the three edges. If rounding
/// turns one of these signs, the point changes by no more than rounding. Of a degenerate triangle only
/// the edges count.
[[nodiscard]] inline Eigen::Vector3d closest_weights(const triangle& t, const Eigen::Vector3d& p) {
  return vector_of(mesh::closest_weights(triples_of(t), triple_of(p)));
}

/// The rule by which a force at a point of a triangle is shared out to its nodes.
enum class force_split : std::uint8_t {
  barycentric,  ///< by the weights of the point
  by_distance,  ///< by the inverse distance to each node
};

/// The shares, Σ sⱼ = 1, of a force at the point of the triangle with these barycentric weights. A node
/// closer to the point than 1e-9 of the longest distance takes all. (A25)
[[nodiscard]] inline Eigen::Vector3d force_shares(force_split split, const triangle& t,
                                                  const Eigen::Vector3d& weights) {
  if (split == force_split::barycentric) return weights;
  const mesh::corners corners = triples_of(t);
  const mesh::triple point = mesh::point_at(corners, triple_of(weights));
  std::array<double, 3> distance{}, share{};
  for (std::size_t k = 0; k < 3; ++k) distance[k] = mesh::length(point - corners[k]);
  const auto [least, most] = std::minmax_element(distance.begin(), distance.end());
  if (*least <= 1e-9 * *most) {
    share[static_cast<std::size_t>(least - distance.begin())] = 1.0;
  } else {
    const double sum = 1.0 / distance[0] + 1.0 / distance[1] + 1.0 / distance[2];
    for (std::size_t k = 0; k < 3; ++k) share[k] = 1.0 / distance[k] / sum;
  }
  return {share[0], share[1], share[2]};
}

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
