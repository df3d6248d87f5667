// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A piece of a surface in space, with edges (the menu is in half_space.hpp).

#include <passive_haptics/constraint_geometry/follow_node.hpp>
#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/constraint_geometry/triangle_point.hpp>
#include <passive_haptics/device/eigen_space.hpp>

namespace passive_haptics {
inline namespace v0 {

/// The triangle a, b, c with outward normal ∝ (b − a) × (c − a), and the solid up to `thickness` [m] behind
/// it. A point is covered if it is on the inner side of all three edges. (2.20-2.23)
template <class Space>
requires(Space::dof == 3) struct triangle {
  using space_type = Space;
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr surface_kind kind = surface_kind::flat;

  typename Space::coordinates a{}, b{}, c{};      ///< nodes [m]
  scalar stiffness{};                             ///< K [N/m], > 0
  scalar thickness = kernels::largest<scalar>();  ///< deepest contact [m] (A18)
  typename Space::coordinates normal{};           ///< unit; set by prepare()

  /// False for stiffness ≤ 0, anything not finite, and a triangle whose height is lost in rounding.
  [[nodiscard]] constexpr bool prepare() noexcept {
    const detail::facing<Space> outside = detail::facing_of<Space>(a, b, c);
    if (!outside.usable) return false;
    normal = outside.normal;
    return thickness > scalar(0) && detail::usable_stiffness(stiffness);
  }

  /// Depth and normal at a point x. It holds references to both.
  struct probe {
    scalar depth;  ///< (a − x)·n [m]
    const triangle& piece;
    const vector& x;
    [[nodiscard]] constexpr vector outward() const noexcept { return piece.normal; }
    [[nodiscard, gnu::always_inline]] constexpr bool covered() const noexcept {
      return piece.covers(x, depth);
    }
  };
  [[nodiscard]] constexpr probe at(const vector& x) const noexcept {
    return {Space::dot(Space::difference(a, x), normal), *this, x};
  }

  [[nodiscard, gnu::always_inline]] constexpr triangle toward(const triangle& target,
                                                              const vector& x, const vector& n,
                                                              scalar d) const noexcept {
    const typename Space::coordinates p = vector(x + n * d);
    const typename Space::coordinates m = n;
    return {detail::follow_node<Space>(a, target.a, p, m),
            detail::follow_node<Space>(b, target.b, p, m),
            detail::follow_node<Space>(c, target.c, p, m),
            target.stiffness,
            target.thickness,
            n};
  }

 private:
  [[nodiscard, gnu::always_inline]] constexpr bool covers(const vector& x,
                                                          scalar depth) const noexcept {
    if constexpr (detail::saves_bytes) return call_within_edges(x, depth);
    return within_edges(x, depth);
  }
  [[nodiscard, gnu::noinline]] constexpr bool call_within_edges(const vector& x,
                                                                scalar depth) const noexcept {
    return within_edges(x, depth);
  }
  [[nodiscard, gnu::always_inline]] constexpr bool within_edges(const vector& x,
                                                                scalar depth) const noexcept {
    return depth <= thickness && inside(a, b, x) && inside(b, c, x) && inside(c, a, x);
  }
  /// ((to − from) × (x − from))·n ≥ 0; the height of x above the plane drops out (A15).
  [[nodiscard, gnu::always_inline]] constexpr bool inside(const typename Space::coordinates& from,
                                                          const typename Space::coordinates& to,
                                                          const vector& x) const noexcept {
    return Space::dot(Space::cross(Space::difference(to, from), Space::difference(x, from)),
                      normal) >= scalar(0);
  }
};

static_assert(constraint_for<triangle<space<float, 3>>, space<float, 3>>);

}  // namespace v0
}  // namespace passive_haptics
