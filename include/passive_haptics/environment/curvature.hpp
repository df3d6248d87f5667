// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The curvature of a mesh: of the smooth surface through its nodes, estimated next to a contact.
//
//   node_normal          of a node                 N. Max, "Weights for computing vertex normals from
//                                                  facet normals", J. Graphics Tools 4(2), 1999
//   triangle_curvature   from the normals of its   S. Rusinkiewicz, "Estimating curvatures and their
//   node_curvature       nodes; mean of those      derivatives on triangle meshes", 3DPVT 2004
//   shape_at             point, normal, principal curvatures of the smooth surface
//
// A curvature is a symmetric tensor C [1/m] with C n = 0: the normal turns by C δ along δ [m]. It is positive
// where the body bulges, 1/r on a ball. Only triangles around the contact count. To find them, a surface_view is
// searched from end to end; for a large surface take a surface_graph, which lists them for each node. No function
// keeps positions, so the body may deform, and none allocates.

#include <passive_haptics/device/eigen_space.hpp>
#include <passive_haptics/environment/surface.hpp>
#include <passive_haptics/environment/surface_graph.hpp>
#include <passive_haptics/environment/triangle_weights.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

/// Calls visit(triangle, k) for every usable triangle whose corner k is the node.
template <class Visit>
void for_triangles_at(surface_view surface, nodes_view nodes, int node, const Visit& visit) {
  for (const surface_triangle& t : surface) {
    const auto at = std::find(t.nodes.begin(), t.nodes.end(), node);
    if (at == t.nodes.end() || is_degenerate(corners(t, nodes))) continue;
    visit(t, static_cast<std::size_t>(at - t.nodes.begin()));
  }
}

template <class Visit>
void for_triangles_at(const surface_graph& surface, nodes_view nodes, int node,
                      const Visit& visit) {
  for (const int i : surface.triangles_at(node)) {
    const surface_triangle& t = surface[slot(i)];
    if (is_degenerate(corners(t, nodes))) continue;
    const auto at = std::find(t.nodes.begin(), t.nodes.end(), node);
    visit(t, static_cast<std::size_t>(at - t.nodes.begin()));
  }
}

/// a/|a|, or zero for zero.
[[nodiscard]] inline mesh::triple unit_of(const mesh::triple& a) noexcept {
  const double length = mesh::length(a);
  return length > 0.0 ? a * (1.0 / length) : mesh::triple{};
}

/// The unit normal of a node along Σ (a × b)/(|a|²|b|²), a and b being the edges of each triangle there. It is
/// exact where the node and its neighbours lie on one sphere, and zero for a node of no usable triangle.
template <class Surface>
[[nodiscard]] Eigen::Vector3d node_normal(const Surface& surface, nodes_view nodes, int node) {
  mesh::triple sum;
  for_triangles_at(surface, nodes, node, [&](const surface_triangle& t, std::size_t k) {
    const mesh::corners shape = triples_of(corners(t, nodes));
    const mesh::triple a = shape[(k + 1) % 3] - shape[k], b = shape[(k + 2) % 3] - shape[k];
    sum = sum + mesh::cross(a, b) * (1.0 / (mesh::squared(a) * mesh::squared(b)));
  });
  return vector_of(unit_of(sum));
}

/// The tensor C [1/m] in the plane of the triangle with C eₖ ≈ Δnₖ by least squares, where eₖ are its edges [m]
/// and Δnₖ the changes of the normals along them.
[[nodiscard]] inline Eigen::Matrix3d triangle_curvature(
    const triangle& shape, const std::array<Eigen::Vector3d, 3>& normals) {
  const mesh::corners at = triples_of(shape), normal = triples_of(normals);
  const mesh::triple u = unit_of(at[1] - at[0]), v = mesh::cross(normal_of(at), u);
  // The normal equations of C_uu, C_uv and C_vv: (uu, uv, 0), (uv, uu + vv, uv), (0, uv, vv) and their right side.
  double uu = 0.0, uv = 0.0, vv = 0.0;
  mesh::triple right;
  for (std::size_t k = 0; k < 3; ++k) {
    const mesh::triple edge = at[(k + 1) % 3] - at[k], turn = normal[(k + 1) % 3] - normal[k];
    const double eu = dot(edge, u), ev = dot(edge, v), tu = dot(turn, u), tv = dot(turn, v);
    uu += eu * eu;
    uv += eu * ev;
    vv += ev * ev;
    right = right + mesh::triple{eu * tu, ev * tu + eu * tv, ev * tv};
  }
  // Cramer's rule; the curvature of a triangle without area is taken as zero.
  const mesh::triple a{uu, uv, 0.0}, b{uv, uu + vv, uv}, c{0.0, uv, vv};
  const double volume = dot(a, cross(b, c));
  if (!(std::abs(volume) > 1e-30 * std::pow(2.0 * (uu + vv), 3))) return Eigen::Matrix3d::Zero();
  const double C_uu = dot(right, cross(b, c)) / volume, C_uv = dot(a, cross(right, c)) / volume,
               C_vv = dot(a, cross(b, right)) / volume;
  Eigen::Matrix3d curvature;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      curvature(i, j) = (C_uu * u[i] + C_uv * v[i]) * u[j] + (C_uv * u[i] + C_vv * v[i]) * v[j];
    }
  }
  return curvature;
}

/// The rotation that takes one unit vector to another the shortest way, c I + [v]× + v vᵀ/(1 + c) with v their
/// cross and c their dot product (Rodrigues), or half a turn if they are opposite.
[[nodiscard]] inline Eigen::Matrix3d turn_between(const Eigen::Vector3d& from,
                                                  const Eigen::Vector3d& to) {
  using scene = space<double, 3>;
  const double cosine = scene::dot(from, to);
  const bool opposite = 1.0 + cosine < 1e-12;
  const Eigen::Vector3d v = opposite ? scene::orthogonal(from) : scene::cross(from, to);
  const double c = opposite ? -1.0 : cosine, along = opposite ? 2.0 : 1.0 / (1.0 + c);
  Eigen::Matrix3d turn;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Eigen::Index j = (i + 1) % 3, k = (i + 2) % 3;
    const double sine = opposite ? 0.0 : v[i];
    turn(i, i) = along * v[i] * v[i] + c;
    turn(j, k) = along * v[j] * v[k] - sine;
    turn(k, j) = along * v[j] * v[k] + sine;
  }
  return turn;
}

/// C turned with its plane, the shortest way from one normal to another.
[[nodiscard]] inline Eigen::Matrix3d turned(const Eigen::Matrix3d& curvature,
                                            const Eigen::Vector3d& from,
                                            const Eigen::Vector3d& to) {
  const Eigen::Matrix3d turn = turn_between(from, to);
  const auto row = [&](Eigen::Index i) {
    return Eigen::Vector3d(turn(i, 0), turn(i, 1), turn(i, 2));
  };
  Eigen::Matrix3d result;
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j < 3; ++j) result(i, j) = across(curvature, row(i), row(j));
  }
  return result;
}

/// sum ← sum + C·s.
inline void add_times(Eigen::Matrix3d& sum, const Eigen::Matrix3d& curvature, double s) {
  for (Eigen::Index i = 0; i < 9; ++i) sum.data()[i] += curvature.data()[i] * s;
}

/// The curvature [1/m] at a node: the mean over its triangles, weighted by their areas.
template <class Surface>
[[nodiscard]] Eigen::Matrix3d node_curvature(const Surface& surface, nodes_view nodes, int node,
                                             const Eigen::Vector3d& normal) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  double area = 0.0;
  for_triangles_at(surface, nodes, node, [&](const surface_triangle& t, std::size_t /*k*/) {
    const triangle shape = corners(t, nodes);
    const Eigen::Matrix3d one = triangle_curvature(
        shape, {node_normal(surface, nodes, t.nodes[0]), node_normal(surface, nodes, t.nodes[1]),
                node_normal(surface, nodes, t.nodes[2])});
    const double share = mesh::length(area_of(triples_of(shape)));
    add_times(sum, turned(one, unit_normal(shape), normal), share);
    area += share;
  });
  Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
  if (area > 0.0) add_times(mean, sum, 1.0 / area);
  return mean;
}

/// The smooth surface next to a point of the mesh.
struct surface_shape {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< on the smooth surface [m]
  Eigen::Vector3d normal{0.0, 0.0, 1.0};            ///< unit, outward
  Eigen::Vector3d tangent{1.0, 0.0, 0.0};           ///< unit, of the first curvature
  double curvature = 0.0;                           ///< along the tangent [1/m]
  double cross_curvature = 0.0;                     ///< along n × t, ≤ the first [1/m]
  double rise = 0.0;  ///< height of the point above the facet, along the normal [m]
};

/// The shape at the point of a triangle with these barycentric weights. Normal and curvature are blended
/// from those of the three nodes; the point stands above the facet by what the curvature gives between
/// the nodes, Σ wₖ ½ δₖᵀC δₖ with δₖ from the point to node k, so that the surface goes through the nodes.
/// Throws std::invalid_argument for a triangle that does not exist.
template <class Surface>
[[nodiscard]] surface_shape shape_at(const Surface& surface, nodes_view nodes, int number,
                                     const Eigen::Vector3d& weights) {
  if (static_cast<std::size_t>(number) >= surface.size()) {
    refuse_argument("shape_at: triangle ", number, " of ", surface.size(),
                    "; give a triangle that closest_point() has found");
  }
  const surface_triangle& t = surface[static_cast<std::size_t>(number)];
  const mesh::corners shape = triples_of(corners(t, nodes));
  std::array<Eigen::Vector3d, 3> normals;
  for (std::size_t k = 0; k < 3; ++k) normals[k] = node_normal(surface, nodes, t.nodes[k]);
  const mesh::triple normal = unit_of(mesh::point_at(triples_of(normals), triple_of(weights)));
  surface_shape result;
  result.normal = vector_of(normal);
  Eigen::Matrix3d curvature = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const double weight = weights[static_cast<Eigen::Index>(k)];
    if (weight == 0.0) continue;
    add_times(
        curvature,
        turned(node_curvature(surface, nodes, t.nodes[k], normals[k]), normals[k], result.normal),
        weight);
  }
  const mesh::triple on_facet = mesh::point_at(shape, triple_of(weights));
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3d way = vector_of(shape[k] - on_facet);
    result.rise += weights[static_cast<Eigen::Index>(k)] * 0.5 * across(curvature, way, way);
  }
  result.point = vector_of(on_facet + normal * result.rise);

  // The two principal axes, in any frame of the tangent plane.
  const Eigen::Vector3d a = space<double, 3>::orthogonal(result.normal),
                        b = vector_of(mesh::cross(normal, triple_of(a)));
  const double aa = across(curvature, a, a), ab = across(curvature, a, b),
               bb = across(curvature, b, b);
  const double angle = 0.5 * std::atan2(2.0 * ab, aa - bb);
  result.tangent = vector_of(triple_of(a) * std::cos(angle) + triple_of(b) * std::sin(angle));
  const double spread = std::hypot(0.5 * (aa - bb), ab);
  result.curvature = 0.5 * (aa + bb) + spread;
  result.cross_curvature = 0.5 * (aa + bb) - spread;
  return result;
}

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
