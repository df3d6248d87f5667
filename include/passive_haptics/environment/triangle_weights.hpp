// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One triangle: its area, its normal, and the point of it closest to another point.
// force_shares() are the shares of a force that its nodes take:
//
//   barycentric  sⱼ = wⱼ           conserves force AND moment; dual of the linear displacement field
//   by_distance  sⱼ ∝ 1/|P − xⱼ|   the thesis (appendix A.2), for comparison: conserves the force and
//                                  moves its point of action by 0.10 edge in the mean, 0.19 at worst
//                                  (A25)

#include <passive_haptics/base/language.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

using triangle = std::array<Eigen::Vector3d, 3>;  ///< corners [m], counter-clockwise from outside

/// ½ (b − a)×(c − a) [m²]: it is along the normal, and its length is the area.
[[nodiscard]] inline Eigen::Vector3d area_vector(const triangle& t) {
  return 0.5 * (t[1] - t[0]).cross(t[2] - t[0]);
}

/// True when the triangle has no usable normal: twice its area ≤ 1e-9 of its longest edge squared,
/// or a corner that is not finite. (A17)
[[nodiscard]] inline bool is_degenerate(const triangle& t) {
  const double longest = (std::max)(
      {(t[1] - t[0]).squaredNorm(), (t[2] - t[1]).squaredNorm(), (t[0] - t[2]).squaredNorm()});
  return !(2.0 * area_vector(t).norm() > 1e-9 * longest) ||
         !(longest < std::numeric_limits<double>::infinity());
}

/// The unit normal n of a triangle that is not degenerate.
[[nodiscard]] inline Eigen::Vector3d unit_normal(const triangle& t) {
  return area_vector(t).normalized();
}

/// Σ wⱼ xⱼ [m].
[[nodiscard]] inline Eigen::Vector3d point_at(const triangle& t, const Eigen::Vector3d& weights) {
  return weights[0] * t[0] + weights[1] * t[1] + weights[2] * t[2];
}

/// Barycentric weights of the point of the triangle closest to p [m]: wⱼ ≥ 0, Σ wⱼ = 1, and exactly zero
/// for a corner that is not on the edge or corner of the point. The point is the foot of p on the plane
/// if that lies within all three edges, otherwise the closest point of the three edges. If rounding
/// turns one of these signs, the point changes by no more than rounding. Of a degenerate triangle only
/// the edges count.
[[nodiscard]] inline Eigen::Vector3d closest_weights(const triangle& t, const Eigen::Vector3d& p) {
  if (!is_degenerate(t)) {
    const Eigen::Vector3d normal = 2.0 * area_vector(t);
    const Eigen::Vector3d r = p - t[0];
    const double b = r.cross(t[2] - t[0]).dot(normal) / normal.squaredNorm();
    const double c = (t[1] - t[0]).cross(r).dot(normal) / normal.squaredNorm();
    const double a = 1.0 - b - c;
    if (a > 0.0 && b > 0.0 && c > 0.0) return {a, b, c};
  }
  Eigen::Vector3d best = Eigen::Vector3d::UnitX();
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const Eigen::Vector3d edge = t[j] - t[i];
    const double length2 = edge.squaredNorm();
    const double s = length2 > 0.0 ? std::clamp((p - t[i]).dot(edge) / length2, 0.0, 1.0) : 0.0;
    const double distance2 = (t[i] + s * edge - p).squaredNorm();
    if (distance2 < shortest) {
      shortest = distance2;
      best.setZero();
      best[static_cast<Eigen::Index>(i)] = 1.0 - s;
      best[static_cast<Eigen::Index>(j)] = s;
    }
  }
  return best;
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
  const Eigen::Vector3d point = point_at(t, weights);
  const Eigen::Vector3d distance{(point - t[0]).norm(), (point - t[1]).norm(),
                                 (point - t[2]).norm()};
  Eigen::Index nearest = 0;
  if (distance.minCoeff(&nearest) <= 1e-9 * distance.maxCoeff()) {
    return Eigen::Vector3d::Unit(nearest);
  }
  const Eigen::Vector3d closeness = distance.cwiseInverse();
  return closeness / closeness.sum();
}

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
