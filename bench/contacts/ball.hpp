// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A ball of 50 mm, the finger that strokes it, and the loops that try to draw work out of a surface
// (docs/design/curved.md).

#include <passive_haptics/constraint_geometry/distance_brick.hpp>
#include <passive_haptics/constraint_geometry/quadric.hpp>
#include <passive_haptics/constraint_geometry/sphere.hpp>
#include <passive_haptics/constraint_geometry/surface_probe.hpp>
#include <passive_haptics/device/eigen_space.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace curved {

namespace ph = passive_haptics;
using d3 = ph::space<double, 3>;
using Eigen::Vector3d;

inline constexpr double radius = 0.05;    ///< of the ball that all surfaces are compared with [m]
inline constexpr double stiffness = 500;  ///< [N/m]

/// In float the numbers are double's, rounded.
template <class S>
typename S::vector of(const Vector3d& v) {
  return v.template cast<typename S::scalar>();
}

/// The force of a spring, K d push() where there is contact [N]. With `along_normal` it acts along outward()
/// in place of push().
template <class S>
Vector3d force(const auto& surface, const Vector3d& x, bool along_normal = false) {
  const auto seen = surface.at(of<S>(x));
  if (!seen.covered() || !(seen.depth > 0)) return Vector3d::Zero();
  const double K = static_cast<double>(surface.stiffness) * static_cast<double>(seen.depth);
  if (along_normal) return K * typename S::vector(seen.outward()).template cast<double>();
  return K * ph::detail::steepest_push<S>(seen).template cast<double>();
}

/// Work of a force field over a closed polygon [J], by Simpson's rule on each side cut in 100 pieces.
inline double work_round(const auto& field, const std::vector<Vector3d>& corners) {
  double work = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector3d from = corners[i], side = corners[(i + 1) % corners.size()] - from;
    constexpr int pieces = 100;
    for (int k = 0; k < pieces; ++k) {
      const auto at = [&](double s) -> Vector3d { return field(from + side * ((k + s) / pieces)); };
      work += (at(0.0) + 4.0 * at(0.5) + at(1.0)).dot(side) / (6.0 * pieces);
    }
  }
  return work;
}

/// The largest work, by size, round loops 10 mm along the ball about the origin and 2 mm deep, from 1 to
/// 3 mm under it, in all directions from the pole +z [J].
inline double largest_loop(const auto& field, int loops = 12) {
  double largest = 0.0;
  for (int i = 0; i < loops; ++i) {
    const double heading = 2.0 * std::acos(-1.0) * i / loops;
    const auto at = [&](double angle, double depth) -> Vector3d {
      return Vector3d(std::sin(angle) * std::cos(heading), std::sin(angle) * std::sin(heading),
                      std::cos(angle)) *
             (radius - depth);
    };
    const double end = 0.01 / radius;
    largest = std::max(
        largest,
        std::abs(work_round(field, {at(0, 1e-3), at(end, 1e-3), at(end, 3e-3), at(0, 3e-3)})));
  }
  return largest;
}

/// The way of a finger that strokes the ball, 2 mm deep on average.
struct path {
  double speed = 0.045;  ///< [m/s]
  double swing = 1e-3;   ///< of its depth [m]
  double rate = 0.004;   ///< of the same [rad a tick]
  double height = 0.35;  ///< over the equator that it follows [rad]
  Eigen::Matrix3d attitude = Eigen::Matrix3d::Identity();  ///< of that equator, and where it begins

  [[nodiscard]] Vector3d at(int tick) const {
    const double along = 1e-3 * speed / radius * tick, up = height + 0.25 * std::sin(0.37 * along);
    const Vector3d way(std::cos(along) * std::cos(up), std::sin(along) * std::cos(up),
                       std::sin(up));
    return attitude * way * (radius - 2e-3 - swing * std::sin(rate * tick));
  }
};
/// Tick i of the usual one.
inline Vector3d stroke(int i) {
  return path{}.at(i);
}

struct feel {
  double largest_step = 0.0;  ///< of the force, from tick to tick [N]
  double mean_error = 0.0;    ///< against the ball [N]
};
/// The force steps and errors of the force `force_at(tick, x)` along the path.
inline feel stroked(const auto& force_at, int ticks = 10000, const path& way = {}) {
  const ph::sphere<d3> ball{.centre = {0, 0, 0}, .radius = radius, .stiffness = stiffness};
  feel all;
  Vector3d last = Vector3d::Zero();
  for (int i = 0; i < ticks; ++i) {
    const Vector3d x = way.at(i), f = force_at(i, x);
    if (i > 0) all.largest_step = std::max(all.largest_step, (f - last).norm());
    all.mean_error += (f - force<d3>(ball, x)).norm() / ticks;
    last = f;
  }
  return all;
}

/// Where a quadric osculates the ball about the origin, next to x.
template <class S>
ph::quadric<S> osculating(const Vector3d& x) {
  using scalar = typename S::scalar;
  const Vector3d n = x.normalized();
  return {.point = of<S>(n * radius),
          .normal = of<S>(n),
          .curvature = scalar(1 / radius),
          .cross_curvature = scalar(1 / radius),
          .stiffness = scalar(stiffness),
          .thickness = scalar(0.01)};
}

/// A ball of triangles: an icosahedron whose faces are cut in four, `times` over.
struct triangulated {
  std::vector<Vector3d> nodes;  ///< [m]
  std::vector<std::array<int, 3>> triangles;
};
inline triangulated icosphere(int times, double r = radius) {
  const double f = (1.0 + std::sqrt(5.0)) / 2.0;
  triangulated m{
      {{-1, f, 0},
       {1, f, 0},
       {-1, -f, 0},
       {1, -f, 0},
       {0, -1, f},
       {0, 1, f},
       {0, -1, -f},
       {0, 1, -f},
       {f, 0, -1},
       {f, 0, 1},
       {-f, 0, -1},
       {-f, 0, 1}},
      {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
       {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
       {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  for (; times > 0; --times) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [at, added] =
          middles.try_emplace(std::minmax(a, b), static_cast<int>(m.nodes.size()));
      if (added) {
        const Vector3d sum = m.nodes[static_cast<std::size_t>(a)].normalized() +
                             m.nodes[static_cast<std::size_t>(b)].normalized();
        m.nodes.push_back(sum);
      }
      return at->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : m.triangles) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const auto& t : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) {
        finer.push_back(t);
      }
    }
    m.triangles = finer;
  }
  for (auto& node : m.nodes) node = node.normalized() * r;
  return m;
}

/// A distance field of the ball about the origin, sampled about a point of it.
template <class S>
ph::distance_brick<S> brick(const Vector3d& middle = {0, 0, radius}, double spacing = 5e-3) {
  using scalar = typename S::scalar;
  return ph::distance_brick<S>::sampled(
      [](const typename S::vector& x) { return scalar(S::norm(x) - scalar(radius)); },
      of<S>(middle - Vector3d::Constant(1.5 * spacing)), scalar(spacing), scalar(stiffness));
}

}  // namespace curved
