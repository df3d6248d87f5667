// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Constraint geometry: the piece of a surface that the environment publishes and the local model
// keeps. Constraints are plain, trivially copyable values, so they can be passed between threads.
//
//   half_space   a plane and the half-space behind it    any Dof; walls, tangent planes of meshes
//   segment      two nodes                               Dof 2
//   triangle     three nodes, with edge tests            Dof 3; the local model of the thesis
//   sphere       a centre and a radius, solid or hollow  any Dof
//   quadric      a point, a normal, two curvatures       Dof 3; for smooth meshes
//   shell        all points within r of a point, segment, box or triangle: balls, capsules, round edges
//   patch        up to M triangles, the closest feature  Dof 3; dents and ridges of a mesh
//   distance_brick, distance_field     a signed distance, sampled (Dof 3) or a function (any Dof)
//
// The first three are pieces of planes, which the local model of the thesis can follow. Formulas,
// proofs and measurements of the others are in docs/design/curved.md.
//
// Each one carries its stiffness K [N/m], because it is a property of the environment. A supply owns a
// constraint and moves it: fixed.hpp, followed.hpp.

#include <passive_haptics/port/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

namespace detail {
template <class Scalar>
[[nodiscard]] constexpr bool usable_stiffness(Scalar K) noexcept {
  return K > Scalar(0) && kernels::is_finite(K);
}
}  // namespace detail

/// All x with depth d = (p − x)·n ≥ 0. (2.18-2.19, A1-A3)
template <class Space>
struct half_space {
  using space_type = Space;
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr surface_kind kind = surface_kind::flat;

  typename Space::coordinates point{};  ///< p, of the surface; the one touched, if it is curved [m]
  typename Space::coordinates normal{};  ///< n, outward, any length but zero
  scalar stiffness{};                    ///< K [N/m], > 0

  [[nodiscard]] constexpr bool prepare() noexcept {
    const vector n = normal;
    const scalar length = Space::norm(n);
    if (!(length > scalar(0)) || !kernels::is_finite(length)) return false;
    normal = vector(n / length);
    return Space::is_finite(point) && Space::is_finite(normal) &&
           detail::usable_stiffness(stiffness);
  }

  /// Depth and normal at a point x. It holds a reference to the constraint.
  struct probe {
    scalar depth;  ///< (p − x)·n [m]
    const half_space& plane;
    [[nodiscard]] constexpr vector outward() const noexcept { return plane.normal; }
    [[nodiscard]] static constexpr bool covered() noexcept { return true; }
  };
  [[nodiscard]] constexpr probe at(const vector& x) const noexcept {
    return {Space::dot(Space::difference(point, x), normal), *this};
  }

  [[nodiscard]] constexpr half_space toward(const half_space& target, const vector& x,
                                            const vector& n, scalar d) const noexcept {
    return {vector(x + n * d), n, target.stiffness};
  }
};

static_assert(constraint_for<half_space<space<float, 1>>, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
