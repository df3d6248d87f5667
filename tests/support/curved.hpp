// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Surfaces of every kind, for tests to try (docs/design/curved.md).
#include "../bench/contacts/ball.hpp"
#include "support/scenes.hpp"

namespace curved {

/// An ellipsoid by a function whose value is no distance and whose gradient is not of length one.
template <class S>
struct ellipsoid {
  ph::distance_and_gradient<S> operator()(const typename S::vector& x) const noexcept {
    using scalar = typename S::scalar;
    const typename S::vector per_axis(scalar(20), scalar(25), scalar(10));
    const typename S::vector q = x.cwiseProduct(per_axis);
    const scalar n = S::norm(q);
    return {(n - scalar(1)) / scalar(20),
            typename S::vector(q.cwiseProduct(per_axis) / (scalar(20) * n))};
  }
};

/// Four triangles around a node: a ridge on one side, a dent on the other.
template <class S, std::size_t M = 4>
ph::patch<S, M> saddle() {
  ph::patch<S, M> p;
  const std::array<Vector3d, 5> nodes{
      {{0, 0, 0}, {0.01, 0, -0.002}, {0, 0.01, 0.003}, {-0.01, 0, -0.001}, {0, -0.01, 0.002}}};
  for (std::size_t i = 0; i < nodes.size(); ++i) p.nodes[i] = of<S>(nodes[i]);
  p.node_count = 5;
  p.triangles = {{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}};
  p.triangle_count = 4;
  p.stiffness = 500;
  return p;
}

/// Calls `try_out` with a surface of every kind.
template <class S>
void every_surface(const auto& try_out) {
  const auto at = [](double x, double y, double z) {
    return typename S::coordinates(of<S>(Vector3d(x, y, z)));
  };
  const auto m = [](double length) { return typename S::scalar(length); };
  try_out(ph::half_space<S>{at(0.1, 0, 0), at(1, 1, 1), m(500)});
  try_out(
      ph::triangle<S>{.a = at(1, 0, 0), .b = at(0, 1, 1), .c = at(1, 3, 0), .stiffness = m(500)});
  try_out(ph::sphere<S>{at(0.01, 0.02, 0), m(0.05), m(500)});
  try_out(ph::sphere<S>{at(0.01, 0.02, 0), m(0.05), m(500), ph::felt_from::inside});
  try_out(ph::quadric<S>{.point = at(0, 0, 0.05),
                         .normal = at(0, 0.1, 2),
                         .tangent = at(1, 1, 0),
                         .curvature = m(20),
                         .cross_curvature = m(-10),
                         .stiffness = m(500),
                         .thickness = m(0.01)});
  try_out(ph::shell<ph::point_core<S>>{{at(0, 0, 0.01)}, m(0.01), m(500)});
  try_out(ph::shell<ph::segment_core<S>>{{at(0, 0, 0.01), at(0.02, 0, 0)}, m(0.01), m(500)});
  try_out(ph::shell<ph::box_core<S>>{
      {at(0, 0, 0.01), at(0.02, 0.01, 0.01), at(1, 1, 0), at(0, 1, 1)}, m(0.005), m(500)});
  try_out(ph::shell<ph::triangle_core<S>>{
      {at(0, 0, 0.01), at(0.02, 0, 0), at(0, 0.03, 0)}, m(0.005), m(500)});
  try_out(brick<S>());
  try_out(ph::distance_field<S, ellipsoid<S>>{
      .stiffness = m(500), .centre = at(0.05, 0, 0), .radius = m(0.02)});
  try_out(saddle<S>());
}

}  // namespace curved
