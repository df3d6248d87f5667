// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A piece of a curve in the plane, with ends (the menu is in half_space.hpp).

#include <passive_haptics/constraint_geometry/follow_node.hpp>
#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/device/eigen_space.hpp>

namespace passive_haptics {
inline namespace v0 {

/// The segment from a to b. Its outward normal is on the right of that direction, so a boundary runs
/// counter-clockwise round its body. It is the two-dimensional counterpart of `triangle`.
template <class Space>
requires(Space::dof == 2) struct segment {
  using space_type = Space;
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr surface_kind kind = surface_kind::flat;

  typename Space::coordinates a{}, b{};           ///< nodes [m]
  scalar stiffness{};                             ///< K [N/m], > 0
  scalar thickness = kernels::largest<scalar>();  ///< deepest contact [m] (A18)
  typename Space::coordinates normal{};           ///< unit; set by prepare()

  [[nodiscard]] constexpr bool prepare() noexcept {
    const vector A = a, B = b;
    const vector along = B - A;
    const scalar length = Space::norm(along);
    if (!(length > scalar(0)) || !kernels::is_finite(length)) return false;
    normal = vector(along(1) / length, -along(0) / length);
    return Space::is_finite(normal) && thickness > scalar(0) && detail::usable_stiffness(stiffness);
  }

  /// Depth and normal at a point x. It holds references to both.
  struct probe {
    scalar depth;  ///< (a − x)·n [m]
    const segment& piece;
    const vector& x;
    [[nodiscard]] constexpr vector outward() const noexcept { return piece.normal; }
    [[nodiscard]] constexpr bool covered() const noexcept { return piece.covers(x, depth); }
  };
  [[nodiscard]] constexpr probe at(const vector& x) const noexcept {
    const vector A = a;
    return {Space::dot(vector(A - x), normal), *this, x};
  }

  [[nodiscard]] constexpr segment toward(const segment& target, const vector& x, const vector& n,
                                         scalar d) const noexcept {
    const vector p = x + n * d;
    return {detail::follow_node<Space>(a, target.a, p, n),
            detail::follow_node<Space>(b, target.b, p, n), target.stiffness, target.thickness, n};
  }

 private:
  [[nodiscard]] constexpr bool covers(const vector& x, scalar depth) const noexcept {
    const vector A = a, B = b;
    const vector along = B - A;
    return depth <= thickness && Space::dot(vector(x - A), along) >= scalar(0) &&
           Space::dot(vector(x - B), along) <= scalar(0);
  }
};

static_assert(constraint_for<segment<space<float, 2>>, space<float, 2>>);

}  // namespace v0
}  // namespace passive_haptics
