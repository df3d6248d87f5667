// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The surface of a tetrahedral mesh, and the point of it closest to another point.
//
//   boundary        the faces owned by one element, outward
//   point_on        the point of ONE triangle closest to p
//   closest_point   the point of the whole surface closest to p, with the right sign of depth
//   match_normal    the thesis's choice (appendix A.1), for comparison
//
// Topology (surface) and positions (nodes) are separate arguments, because the body deforms and its triangles
// stay the same. All searches look at every triangle; some hundred triangles take some microseconds. For more
// triangles surface_search.hpp gives the same answers.

#include <passive_haptics/environment/mesh.hpp>
#include <passive_haptics/environment/triangle_weights.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

/// Three nodes of the mesh, counter-clockwise seen from outside.
struct surface_triangle {
  std::array<int, 3> nodes;
};

using surface_view = std::span<const surface_triangle>;
using nodes_view = std::span<const Eigen::Vector3d>;  ///< positions [m]

[[noreturn, gnu::cold, gnu::noinline]] inline void refuse_node(int node, std::size_t count) {
  refuse_argument("surface: a triangle names node ", node, " of ", count,
                  "; count nodes from 0 and give the positions of all of them");
}
/// Refuses a triangle that names a node which is not one of so many.
inline void check_nodes(const surface_triangle& t, std::size_t count) {
  for (const int node : t.nodes) {
    if (static_cast<std::size_t>(node) >= count) refuse_node(node, count);
  }
}

/// Throws std::invalid_argument for a node that does not exist.
[[nodiscard]] inline triangle corners(const surface_triangle& t, nodes_view nodes) {
  check_nodes(t, nodes.size());
  return {nodes[static_cast<std::size_t>(t.nodes[0])], nodes[static_cast<std::size_t>(t.nodes[1])],
          nodes[static_cast<std::size_t>(t.nodes[2])]};
}

/// The faces owned by exactly one element, outward, in the order of the elements. The mesh must pass
/// check(). Throws mesh_error for elements that overlap at a face.
[[nodiscard]] inline std::vector<surface_triangle> boundary(const tetrahedral_mesh& mesh) {
  const std::vector<element_face> all = sorted_faces(mesh);
  if (const auto fault = find_overlap(all)) {
    refuse(mesh_error(
        "surface",
        sentence("tetrahedra ", fault->tetrahedron, " and ", fault->other, " ", fault->problem),
        fault->remedy));
  }
  std::vector<int> place(all.size(), -1);  // in `all`, of each face of one owner
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i + 1 < all.size() && all[i].key == all[i + 1].key) {
      ++i;  // skips the face of the other owner
    } else {
      place[static_cast<std::size_t>(all[i].number)] = static_cast<int>(i);
    }
  }
  std::vector<surface_triangle> result;
  for (const int i : place) {
    if (i >= 0) result.push_back({all[static_cast<std::size_t>(i)].nodes});
  }
  return result;
}

/// A point p of the surface next to another point x.
struct surface_point {
  int triangle = -1;                       ///< its number; −1: none
  Eigen::Vector3d point{0.0, 0.0, 0.0};    ///< p, on the triangle [m]
  Eigen::Vector3d weights{0.0, 0.0, 0.0};  ///< barycentric, of p
  Eigen::Vector3d normal{0.0, 0.0, 1.0};   ///< n of the triangle, unit, outward
  double distance = 0.0;                   ///< |p − x| [m]
  double depth = 0.0;                      ///< d = (p − x)·n [m], positive behind the triangle
};

/// The point of triangle `number` closest to x [m]; none if the triangle is degenerate (audit.md A17) or x is not
/// finite.
[[nodiscard]] inline std::optional<surface_point> point_on(surface_view surface, nodes_view nodes,
                                                           int number, const Eigen::Vector3d& x) {
  const mesh::corners t = triples_of(corners(surface[static_cast<std::size_t>(number)], nodes));
  const mesh::triple from = triple_of(x);
  if (is_degenerate(t) || !mesh::is_finite(from)) return std::nullopt;
  const mesh::triple weights = mesh::closest_weights(t, from), point = mesh::point_at(t, weights),
                     normal = normal_of(t);
  return surface_point{.triangle = number,
                       .point = vector_of(point),
                       .weights = vector_of(weights),
                       .normal = vector_of(normal),
                       .distance = mesh::length(point - from),
                       .depth = mesh::dot(point - from, normal)};
}

/// True if t has every corner of `owner` whose weight is > 0, that is, touches the face, edge or node of a point.
[[nodiscard]] inline bool touches(const surface_triangle& t, const surface_triangle& owner,
                                  const Eigen::Vector3d& weights) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (weights[static_cast<Eigen::Index>(k)] > 0.0 &&
        std::find(t.nodes.begin(), t.nodes.end(), owner.nodes[k]) == t.nodes.end()) {
      return false;
    }
  }
  return true;
}

/// The corner of the largest weight.
[[nodiscard]] inline std::size_t heaviest(const Eigen::Vector3d& weights) {
  const auto first = weights.data();
  return static_cast<std::size_t>(std::max_element(first, first + 3) - first);
}

/// Σ αₜ nₜ over the triangles that touch the point, where αₜ is the corner's angle [rad] at a node, and 1 on an
/// edge and inside a face, where all angles are equal. The sign of (p − x)·Σ αₜ nₜ tells inside from outside even
/// where that of one triangle does not: Bærentzen and Aanæs, "Signed distance computation using the angle weighted
/// pseudonormal", IEEE TVCG 11(3), 2005. for_each(visit) visits, in ascending order, at least those triangles.
template <class ForEach>
[[nodiscard]] Eigen::Vector3d pseudo_normal(surface_view surface, nodes_view nodes,
                                            const surface_point& on, const ForEach& for_each) {
  const surface_triangle& owner = surface[static_cast<std::size_t>(on.triangle)];
  const int node = owner.nodes[heaviest(on.weights)];
  int held = 0;
  for (Eigen::Index k = 0; k < 3; ++k) held += on.weights[k] > 0.0 ? 1 : 0;
  mesh::triple sum;
  for_each([&](int number) {
    const surface_triangle& t = surface[static_cast<std::size_t>(number)];
    const mesh::corners shape = triples_of(corners(t, nodes));
    if (!touches(t, owner, on.weights) || is_degenerate(shape)) return;
    double angle = 1.0;  // the same for both sides of an edge
    if (held == 1) {     // at a node
      const auto k = static_cast<std::size_t>(std::find(t.nodes.begin(), t.nodes.end(), node) -
                                              t.nodes.begin());
      const mesh::triple a = shape[(k + 1) % 3] - shape[k], b = shape[(k + 2) % 3] - shape[k];
      angle = std::atan2(mesh::length(mesh::cross(a, b)), mesh::dot(a, b));
    }
    sum = sum + normal_of(shape) * angle;
  });
  return vector_of(sum);
}

/// The same point, on that triangle, of all that touch it, whose |depth| is largest with the sign of the pseudo-normal.
template <class ForEach>
[[nodiscard]] surface_point facing(surface_view surface, nodes_view nodes, const Eigen::Vector3d& x,
                                   const surface_point& found, const ForEach& for_each) {
  const mesh::triple weights = triple_of(found.weights);
  if (weights.x > 0.0 && weights.y > 0.0 && weights.z > 0.0) return found;
  const mesh::triple outward = triple_of(pseudo_normal(surface, nodes, found, for_each));
  const double side = mesh::dot(triple_of(found.point) - triple_of(x), outward) < 0.0 ? -1.0 : 1.0;
  surface_point best = found;
  for_each([&](int i) {
    if (!touches(surface[static_cast<std::size_t>(i)],
                 surface[static_cast<std::size_t>(found.triangle)], found.weights)) {
      return;
    }
    const auto twin = point_on(surface, nodes, i, x);
    if (twin && side * twin->depth > side * best.depth) best = *twin;
  });
  return best;
}

/// The point of the surface closest to x [m]. On an edge or a node it belongs to several triangles, and the one of
/// the largest |depth| is returned; so depth > 0 inside the body and < 0 outside, at edges and nodes too.
/// There is none if x is not finite or every triangle is degenerate.
[[nodiscard]] inline std::optional<surface_point> closest_point(surface_view surface,
                                                                nodes_view nodes,
                                                                const Eigen::Vector3d& x) {
  const auto for_each = [&](const auto& visit) {
    for (int i = 0; i < static_cast<int>(surface.size()); ++i) visit(i);
  };
  std::optional<surface_point> best;
  for_each([&](int i) {
    const auto candidate = point_on(surface, nodes, i, x);
    if (candidate && (!best || candidate->distance < best->distance)) best = candidate;
  });
  if (!best) return best;
  return facing(surface, nodes, x, *best, for_each);
}

/// True if x is inside the body.
[[nodiscard]] inline bool is_inside(surface_view surface, nodes_view nodes,
                                    const Eigen::Vector3d& x) {
  const auto closest = closest_point(surface, nodes, x);
  return closest && closest->depth > 0.0;
}

/// The point on the triangle whose normal is nearest to the direction from `centre` [m] to x [m] (thesis
/// A.1). It is right for a sphere at rest, and wrong for other shapes and deformed spheres (A26). depth is
/// that of the plane of the triangle.
[[nodiscard]] inline std::optional<surface_point> match_normal(surface_view surface,
                                                               nodes_view nodes,
                                                               const Eigen::Vector3d& centre,
                                                               const Eigen::Vector3d& x) {
  int best = -1;
  double largest = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < static_cast<int>(surface.size()); ++i) {
    const mesh::corners t = triples_of(corners(surface[static_cast<std::size_t>(i)], nodes));
    if (is_degenerate(t)) continue;
    const double match = mesh::dot(normal_of(t), triple_of(x) - triple_of(centre));
    if (match > largest) {
      largest = match;
      best = i;
    }
  }
  if (best < 0) return std::nullopt;
  return point_on(surface, nodes, best, x);
}

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
