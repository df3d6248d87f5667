// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A piece of a surface with its two curvatures (the menu is in half_space.hpp).

#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/constraint_geometry/surface_probe.hpp>
#include <passive_haptics/device/eigen_space.hpp>

namespace passive_haptics {
inline namespace v0 {

/// The osculating paraboloid of a surface at p. With u, v, ζ [m] the coordinates of x − p along t, n × t and n, its
/// equation is ζ = h = −½(κ₁u² + κ₂v²). A curvature is positive if the solid is convex, 1/r for a ball.
///     g = n + κ₁u t + κ₂v (n × t)        the gradient of ζ − h
///     d = (h − ζ)/|g|                    the depth to first order, exact at u = v = 0
///     push() = −∇d = g/|g| + d ∇|g|/|g|
/// The force K d push() is conservative; K d outward() would not be. |push()| < 1 + |κ| thickness/2.
template <class Space>
requires(Space::dof == 3) struct quadric {
  using space_type = Space;
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr surface_kind kind = surface_kind::smooth;

  typename Space::coordinates point{};        ///< p [m]
  typename Space::coordinates normal{};       ///< n, outward, any length but zero
  typename Space::coordinates tangent{};      ///< t, along κ₁; of any length, roughly tangential
  scalar curvature{};                         ///< κ₁, along t [1/m]
  scalar cross_curvature{};                   ///< κ₂, along n × t [1/m]
  scalar stiffness{};                         ///< K [N/m], > 0
  scalar thickness{};                         ///< deepest contact [m], > 0; |κ| thickness < 1
  scalar reach = kernels::largest<scalar>();  ///< farthest from p along the tangent plane [m], > 0

  /// False for a normal without a direction, a tangent without one across the normal (unless the
  /// curvatures are equal, when it does not matter), a curvature with |κ| thickness ≥ 1,
  /// stiffness, thickness or reach ≤ 0, and for anything but `reach` that is not finite.
  [[nodiscard]] constexpr bool prepare() noexcept {
    if (!detail::make_unit<Space>(normal)) return false;
    if (curvature == cross_curvature && Space::is_finite(tangent)) {
      tangent = Space::orthogonal(normal);  // every tangent is equivalent
    } else {
      if (!detail::make_unit<Space>(tangent)) return false;
      const vector t = tangent, n = normal;
      const vector across = t - n * Space::dot(t, n);
      if (!(Space::norm(across) > scalar(1e-3))) return false;
      tangent = across;
      if (!detail::make_unit<Space>(tangent)) return false;
    }
    return Space::is_finite(point) && kernels::is_finite(curvature) &&
           kernels::is_finite(cross_curvature) && detail::usable_stiffness(stiffness) &&
           detail::usable_length(thickness) && reach > scalar(0) &&
           kernels::magnitude(curvature) * thickness < scalar(1) &&
           kernels::magnitude(cross_curvature) * thickness < scalar(1);
  }

  /// Depth, normal and −∇d at a point x.
  struct probe {
    scalar depth;    ///< d [m]
    vector normal;   ///< g/|g|
    vector pushing;  ///< −∇d
    bool within;
    [[nodiscard]] constexpr const vector& outward() const noexcept { return normal; }
    [[nodiscard]] constexpr const vector& push() const noexcept { return pushing; }
    [[nodiscard]] constexpr bool covered() const noexcept { return within; }
  };
  [[nodiscard, gnu::always_inline]] constexpr probe at(const vector& x) const noexcept {
    const vector n = normal, t = tangent, s = Space::cross(n, t);
    const vector r = Space::difference(x, point);
    const scalar u = Space::dot(r, t), v = Space::dot(r, s);
    const scalar a = curvature * u, b = cross_curvature * v;  // the slopes −∂h/∂u, −∂h/∂v
    const scalar shorter = scalar(1) / kernels::square_root(scalar(1) + a * a + b * b);  // 1/|g|
    const scalar depth = -(Space::dot(r, n) + (a * u + b * v) / scalar(2)) * shorter;
    const vector outward = (n + t * a + s * b) * shorter;
    const scalar along = depth * shorter * shorter;  // d/|g|², and ∇|g| = (κ₁a t + κ₂b s)/|g|
    const vector turning = t * (curvature * a * along) + s * (cross_curvature * b * along);
    return {depth, outward, vector(outward + turning),
            depth <= thickness && u * u + v * v <= reach * reach};
  }

  /// The target's shape, placed so that x lies d [m] deep under its point, with normal n.
  [[nodiscard]] constexpr quadric toward(const quadric& target, const vector& x, const vector& n,
                                         scalar d) const noexcept {
    quadric own = target;
    const vector t = target.tangent, across = t - n * Space::dot(t, n);
    const scalar length = Space::norm(across);
    own.point = vector(x + n * d);
    own.normal = n;
    own.thickness = kernels::larger(own.thickness, scalar(2) * d);  // it covers x, however pressed
    own.tangent = length > scalar(0.5) ? vector(across / length) : Space::orthogonal(n);
    return own;
  }

  /// The ball about p of radius `reach`, or of ten times the thickness if that is less.
  [[nodiscard]] constexpr neighbourhood<Space> around() const noexcept {
    return {point, kernels::smaller(reach, scalar(10) * thickness)};
  }
};

static_assert(surface_for<quadric<space<float, 3>>, space<float, 3>>);

}  // namespace v0
}  // namespace passive_haptics
