// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A rounded solid: everything within r of a convex core (the menu is in half_space.hpp).
//
//   shell<point_core>      a ball                           any Dof
//   shell<segment_core>    a capsule                        Dof 2, 3
//   shell<box_core>        a box with rounded edges         Dof 3
//   shell<triangle_core>   a triangular plate, 2r thick     Dof 3
//
// The closest point of a convex core is unique, so in the shell the force is continuous and conservative, also
// at edges and corners, where the force of a bare box would turn by 90° at once. At depth d [m] the stiffness is K
// [N/m] along the normal and at most K d/(r − d) across it. With
//     r ≥ 2 F_max/K        F_max the limit of the motors: 1.8 mm for 9 N on 10 kN/m
// the motors reach F_max at d ≤ r/2, up to which the stiffness across is at most K, too. In the core the force is
// along the normal of the nearest face, so it jumps where another face becomes the nearest.

#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/constraint_geometry/surface_probe.hpp>
#include <passive_haptics/constraint_geometry/triangle_point.hpp>
#include <passive_haptics/device/eigen_space.hpp>

namespace passive_haptics {
inline namespace v0 {

/// The point of a core's boundary that is closest to x.
template <class Space>
struct core_point {
  typename Space::vector point;   ///< the closest point of the boundary [m]
  typename Space::vector normal;  ///< unit; outward if x is in the core or on it
  bool inside;                    ///< x is in the core or on it
};

/// All points within `radius` of a convex core. A core is a plain value with prepare() and around(), as
/// surfaces have them, and with closest(x), which returns a core_point.
template <class Core>
struct shell {
  using space_type = typename Core::space_type;
  using scalar = typename space_type::scalar;
  using vector = typename space_type::vector;
  static constexpr surface_kind kind = surface_kind::smooth;

  Core core{};
  scalar radius{};     ///< r [m], > 0; ≥ 2 F_max/K keeps the slope ≤ K
  scalar stiffness{};  ///< K [N/m], > 0

  /// False for a core that is not usable, a radius or a stiffness ≤ 0 or not finite.
  [[nodiscard]] constexpr bool prepare() noexcept {
    return core.prepare() && detail::usable_length(radius) && detail::usable_stiffness(stiffness);
  }

  using probe = distance_probe<space_type>;
  [[nodiscard]] constexpr probe at(const vector& x) const noexcept {
    const core_point<space_type> found = core.closest(x);
    const auto way =
        detail::polar_form<space_type>(space_type::difference(x, found.point), found.normal);
    if (found.inside) return {radius + way.length, found.normal, true};
    return {radius - way.length, way.direction, true};
  }

  /// The ball of twice the solid's size.
  [[nodiscard]] constexpr neighbourhood<space_type> around() const noexcept {
    const auto of_core = core.around();
    return {of_core.centre, scalar(2) * (of_core.radius + radius)};
  }
};

/// A point, whose shell is a ball.
template <class Space>
struct point_core {
  using space_type = Space;
  using vector = typename Space::vector;

  typename Space::coordinates point{};  ///< [m]

  [[nodiscard]] constexpr bool prepare() noexcept { return Space::is_finite(point); }
  [[nodiscard]] constexpr core_point<Space> closest(const vector& /*x*/) const noexcept {
    return {vector(point), detail::some_direction<Space>(), false};
  }
  [[nodiscard]] constexpr neighbourhood<Space> around() const noexcept { return {point, {}}; }
};

/// The line from a to b, whose shell is a capsule. In one dimension it would have an inside: use a sphere there.
template <class Space>
requires(Space::dof >= 2) struct segment_core {
  using space_type = Space;
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;

  typename Space::coordinates a{}, b{};  ///< [m]

  /// False for ends that are not finite, or so close that the square of their distance is lost.
  [[nodiscard]] constexpr bool prepare() noexcept {
    const scalar squared = length_squared();
    return Space::is_finite(a) && Space::is_finite(b) && kernels::is_finite(squared) &&
           squared > kernels::smallest<scalar>();
  }
  [[nodiscard]] constexpr core_point<Space> closest(const vector& x) const noexcept {
    const vector along = Space::difference(b, a);
    const scalar s =
        kernels::clamped(scalar(Space::dot(Space::difference(x, a), along) / length_squared()),
                         scalar(0), scalar(1));
    return {vector(vector(a) + along * s), Space::orthogonal(vector(along / Space::norm(along))),
            false};
  }
  [[nodiscard]] constexpr neighbourhood<Space> around() const noexcept {
    const vector along = Space::difference(b, a);
    return {vector(vector(a) + along * scalar(0.5)), Space::norm(along) / scalar(2)};
  }

 private:
  [[nodiscard]] constexpr scalar length_squared() const noexcept {
    const vector along = Space::difference(b, a);
    return Space::dot(along, along);
  }
};

/// A box of any orientation, whose shell is a box with rounded edges.
template <class Space>
requires(Space::dof == 3) struct box_core {
  using space_type = Space;
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;

  typename Space::coordinates centre{};  ///< [m]
  typename Space::coordinates half{};    ///< half the edge lengths, along its own axes [m], ≥ 0
  typename Space::coordinates first{scalar(1), scalar(0),
                                    scalar(0)};  ///< its first axis, any length
  typename Space::coordinates second{scalar(0), scalar(1),
                                     scalar(0)};  ///< its second, made square to it

  /// False for axes that are zero or parallel, an edge below zero, anything not finite.
  [[nodiscard]] constexpr bool prepare() noexcept {
    if (!detail::make_unit<Space>(first) || !detail::make_unit<Space>(second)) return false;
    const vector e = first, given = second;
    const vector square = given - e * Space::dot(given, e);
    if (!(Space::norm(square) > scalar(1e-3))) return false;
    second = square;
    return detail::make_unit<Space>(second) && Space::is_finite(centre) && Space::is_finite(half) &&
           half[0] >= scalar(0) && half[1] >= scalar(0) && half[2] >= scalar(0);
  }
  [[nodiscard]] constexpr core_point<Space> closest(const vector& x) const noexcept {
    const vector r = Space::difference(x, centre);
    const std::array<vector, 3> axis{vector(first), vector(second), Space::cross(first, second)};
    std::array<scalar, 3> own{};  // x, and the point, in the box's axes
    bool inside = true;
    std::size_t face = 0;
    scalar shallowest = kernels::largest<scalar>();
    vector point = centre;
    for (std::size_t i = 0; i < 3; ++i) {
      own[i] = Space::dot(r, axis[i]);
      const scalar to_face = half[i] - kernels::magnitude(own[i]);
      inside = inside && to_face >= scalar(0);
      if (to_face < shallowest) {
        shallowest = to_face;
        face = i;
      }
    }
    for (std::size_t i = 0; i < 3; ++i) {
      scalar within = kernels::clamped(own[i], scalar(-half[i]), half[i]);
      if (inside && i == face) within = own[i] < scalar(0) ? scalar(-half[i]) : half[i];
      point = vector(point + axis[i] * within);
    }
    const vector out = own[face] < scalar(0) ? vector(-axis[face]) : axis[face];
    return {point, out, inside};
  }
  [[nodiscard]] constexpr neighbourhood<Space> around() const noexcept {
    return {centre, Space::norm(half)};
  }
};

/// A triangle, whose shell is a plate with round edges that is felt from both sides.
template <class Space>
requires(Space::dof == 3) struct triangle_core {
  using space_type = Space;
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;

  typename Space::coordinates a{}, b{}, c{};  ///< corners [m]

  /// False for a triangle whose area is lost in rounding, and for anything not finite.
  [[nodiscard]] constexpr bool prepare() noexcept {
    return detail::facing_of<Space>(a, b, c).usable;
  }
  [[nodiscard]] constexpr core_point<Space> closest(const vector& x) const noexcept {
    return {detail::closest_on_triangle<Space>(a, b, c, x).point,
            detail::facing_of<Space>(a, b, c).normal, false};
  }
  [[nodiscard]] constexpr neighbourhood<Space> around() const noexcept {
    const vector A = a, B = b, C = c;
    const vector middle = (A + B + C) / scalar(3);
    return {middle, kernels::larger(Space::norm(vector(A - middle)),
                                    kernels::larger(Space::norm(vector(B - middle)),
                                                    Space::norm(vector(C - middle))))};
  }
};

static_assert(surface_for<shell<segment_core<space<float, 3>>>, space<float, 3>>);

}  // namespace v0
}  // namespace passive_haptics
