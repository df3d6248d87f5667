// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A piece of a mesh with its edges and corners (the menu is in half_space.hpp).

#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/constraint_geometry/surface_probe.hpp>
#include <passive_haptics/constraint_geometry/triangle_point.hpp>
#include <passive_haptics/device/eigen_space.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace passive_haptics {
inline namespace v0 {

namespace detail {
/// The angle between two vectors [rad]. Scalars that are not built in bring an atan2 of their own.
template <class Space>
[[nodiscard]] typename Space::scalar angle_between(const typename Space::vector& a,
                                                   const typename Space::vector& b) noexcept {
  using std::atan2;
  return atan2(Space::norm(Space::cross(a, b)), Space::dot(a, b));
}
}  // namespace detail

/// Triangles that share whole edges, each counter-clockwise seen from outside. Depth is the distance from x to their
/// closest point c [m], positive inside, and outward() there is along c − x. The sign follows from the pseudo-normal
/// at c: the normal of the face, the mean of both normals at an edge, or the mean of all normals at a node, weighted
/// by their angles (Bærentzen and Aanæs, IEEE TVCG 11(3), 2005). If c is on the rim of the patch, x is not covered,
/// because the surface beyond is unknown. No point is covered twice and, unlike with single `triangle`s, none between
/// two triangles is missed. Inside, the force direction jumps where another face, edge or node becomes the closest.
template <class Space, std::size_t M = 16>
requires(Space::dof == 3 && 1 <= M && M <= 250) struct patch {
  using space_type = Space;
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr surface_kind kind = surface_kind::faceted;
  static constexpr std::size_t capacity = M;
  static constexpr std::size_t node_capacity = M + 2;  ///< M connected triangles have no more nodes
  static constexpr std::uint8_t none = 255;

  std::array<typename Space::coordinates, node_capacity> nodes{};  ///< [m]
  std::array<std::array<std::uint8_t, 3>, M> triangles{};          ///< numbers of nodes
  std::uint8_t node_count{};                                       ///< ≥ 3
  std::uint8_t triangle_count{};                                   ///< ≥ 1
  scalar stiffness{};                                              ///< K [N/m], > 0
  scalar thickness = kernels::largest<scalar>();                   ///< deepest contact [m], > 0

  std::array<typename Space::coordinates, M> normals{};  ///< of the triangles; set by prepare()
  std::array<typename Space::coordinates, node_capacity> pseudo_normals{};  ///< by prepare()
  std::array<std::array<std::uint8_t, 3>, M> neighbours{};  ///< across edge k, k + 1; by prepare()
  std::array<bool, node_capacity> on_rim{};                 ///< for each node; by prepare()

  /// False for no triangle or too many, a node that does not exist or is not finite, a triangle whose height is lost
  /// in rounding, an edge of three triangles or of two that face opposite sides, stiffness or thickness ≤ 0.
  [[nodiscard]] bool prepare() noexcept {
    if (triangle_count < 1 || triangle_count > M || node_count > node_capacity) return false;
    if (!detail::usable_stiffness(stiffness) || !detail::usable_length(thickness)) return false;
    on_rim = {};
    std::array<vector, node_capacity> around{};
    around.fill(Space::zero());
    for (std::size_t i = 0; i < triangle_count; ++i) {
      for (const std::uint8_t node : triangles[i]) {
        if (node >= node_count) return false;
      }
      const detail::facing<Space> outside =
          detail::facing_of<Space>(corner(i, 0), corner(i, 1), corner(i, 2));
      if (!outside.usable) return false;
      normals[i] = outside.normal;
      for (std::size_t k = 0; k < 3; ++k) {
        if (!find_neighbour(i, k)) return false;
        const scalar angle =
            detail::angle_between<Space>(vector(corner(i, (k + 1) % 3) - corner(i, k)),
                                         vector(corner(i, (k + 2) % 3) - corner(i, k)));
        around[triangles[i][k]] += outside.normal * angle;
      }
    }
    for (std::size_t node = 0; node < node_count; ++node) {
      if (!Space::is_finite(nodes[node])) return false;
      pseudo_normals[node] =
          detail::polar_form<Space>(around[node], detail::some_direction<Space>()).direction;
    }
    return true;
  }

  using probe = distance_probe<Space>;
  [[nodiscard]] probe at(const vector& x) const noexcept {
    scalar closest = kernels::largest<scalar>();
    std::size_t triangle = M;
    detail::triangle_point<Space> on{Space::zero(), {}};
    for (std::size_t i = 0; i < triangle_count; ++i) {
      const scalar height = Space::dot(Space::difference(x, nodes[triangles[i][0]]), normals[i]);
      if (!(height * height < closest)) continue;  // even the triangle's plane is farther away
      const auto candidate =
          detail::closest_on_triangle<Space>(corner(i, 0), corner(i, 1), corner(i, 2), x);
      const vector way = x - candidate.point;
      const scalar squared = Space::dot(way, way);
      if (!(squared < closest)) continue;
      closest = squared;
      triangle = i;
      on = candidate;
    }
    if (triangle == M) return {-kernels::largest<scalar>(), detail::some_direction<Space>(), false};
    return seen_from(x, triangle, on);
  }

  /// The smallest ball about the mean of the nodes that contains them all.
  [[nodiscard]] neighbourhood<Space> around() const noexcept {
    vector middle = Space::zero();
    for (std::size_t i = 0; i < node_count; ++i) middle += vector(nodes[i]);
    middle = vector(middle / scalar(static_cast<int>(node_count)));
    scalar radius(0);
    for (std::size_t i = 0; i < node_count; ++i) {
      radius = kernels::larger(radius, Space::norm(Space::difference(nodes[i], middle)));
    }
    return {middle, radius};
  }

 private:
  [[nodiscard]] vector corner(std::size_t triangle, std::size_t k) const noexcept {
    return nodes[triangles[triangle][k]];
  }

  /// The triangle that shares the edge from corner k to the next one, which must run the other way.
  [[nodiscard]] bool find_neighbour(std::size_t triangle, std::size_t k) noexcept {
    const std::uint8_t from = triangles[triangle][k], to = triangles[triangle][(k + 1) % 3];
    neighbours[triangle][k] = none;
    for (std::size_t i = 0; i < triangle_count; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        const std::uint8_t start = triangles[i][j], end = triangles[i][(j + 1) % 3];
        if (start == from && end == to && i != triangle) return false;
        if (start == to && end == from) neighbours[triangle][k] = static_cast<std::uint8_t>(i);
      }
    }
    if (neighbours[triangle][k] == none) on_rim[from] = on_rim[to] = true;
    return true;
  }

  [[nodiscard]] probe seen_from(const vector& x, std::size_t triangle,
                                const detail::triangle_point<Space>& on) const noexcept {
    const vector way = x - on.point;
    const bool has_first = on.weights[0] > scalar(0), has_second = on.weights[1] > scalar(0),
               has_third = on.weights[2] > scalar(0);
    if (has_first && has_second && has_third) {  // on a face `way` may be rounding only
      const vector n = normals[triangle];
      const scalar depth = -Space::dot(way, n);
      return {depth, n, depth <= thickness};
    }
    bool covered = true;
    vector pseudo_normal = Space::zero();
    if (int(has_first) + int(has_second) + int(has_third) == 1) {
      const std::uint8_t node = triangles[triangle][has_first ? 0 : has_second ? 1 : 2];
      covered = !on_rim[node];
      pseudo_normal = pseudo_normals[node];
    } else {
      const std::uint8_t other = neighbours[triangle][!has_third ? 0 : !has_first ? 1 : 2];
      covered = other != none;
      const vector both = covered ? vector(vector(normals[triangle]) + vector(normals[other]))
                                  : vector(normals[triangle]);
      pseudo_normal = detail::polar_form<Space>(both, normals[triangle]).direction;
    }
    const scalar side = Space::dot(way, pseudo_normal) < scalar(0) ? scalar(-1) : scalar(1);
    const scalar distance = Space::norm(way);
    // Rounding of the coordinates must not turn the normal of a contact without depth.
    const scalar size =
        Space::norm(x) + Space::norm(vector(corner(triangle, 1) - corner(triangle, 0)));
    const scalar noise = scalar(64) * std::numeric_limits<scalar>::epsilon() * size;
    const vector n = distance > noise ? vector(way * (side / distance)) : pseudo_normal;
    return {-side * distance, n, covered && -side * distance <= thickness};
  }
};

static_assert(surface_for<patch<space<float, 3>, 2>, space<float, 3>>);

}  // namespace v0
}  // namespace passive_haptics
