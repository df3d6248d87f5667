// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Constraint geometry: the piece of the world that the environment publishes and the local model
// keeps. Plain values, trivially copyable, so they cross threads as they are.
//
//   half_space   a plane and what lies behind it         any Dof; walls, tangent planes of meshes
//   segment      two nodes                               Dof 2
//   triangle     three nodes, with edge tests            Dof 3; the local model of the thesis
//
// Each one carries its stiffness, because the environment knows it. Nodes follow the environment's
// along the lines of Fig. 2.5, clamped and projected (A22): unclamped, half of random cases leave the
// segment and some triangles flip.

#include <passive_haptics/concepts.hpp>

#include <array>

namespace passive_haptics {
inline namespace v0 {

namespace detail {

template <class Scalar>
[[nodiscard]] constexpr bool usable_stiffness(Scalar K) noexcept {
  return K > Scalar(0) && kernels::is_finite(K);
}

/// Where a node goes when its constraint's plane is to pass through p with unit normal n: where the
/// line from→to meets the plane, no further than its ends, then straight onto the plane. (Fig. 2.5)
/// Coordinates, because a call hands them over in registers: there are three nodes, and one of this.
template <class Space>
[[nodiscard, gnu::noinline]] constexpr typename Space::coordinates follow_node(
    typename Space::coordinates from, typename Space::coordinates to,
    typename Space::coordinates through, typename Space::coordinates normal) noexcept {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  const vector start = from, end = to, p = through, n = normal;
  const vector line = end - start;
  const scalar across = Space::dot(line, n);
  const scalar smallest = std::numeric_limits<scalar>::epsilon() * Space::norm(line);
  scalar t(0);
  if (across > smallest || across < -smallest) {
    t = Space::dot(vector(p - start), n) / across;
    t = kernels::smaller(kernels::larger(t, scalar(0)), scalar(1));
  }
  const vector node = start + line * t;
  return vector(node + n * Space::dot(vector(p - node), n));
}

}  // namespace detail

/// All x with (p − x)·n ≥ 0. (2.18-2.19, A1-A3)
template <class Space>
struct half_space {
  using space_type = Space;
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;

  typename Space::coordinates point{};   ///< p, any point of the surface [m]
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
  [[nodiscard]] constexpr vector outward() const noexcept { return normal; }
  [[nodiscard]] constexpr scalar depth(const vector& x) const noexcept {
    const vector p = point;
    return Space::dot(vector(p - x), normal);
  }
  [[nodiscard]] constexpr bool covers(const vector& /*x*/) const noexcept { return true; }

  [[nodiscard]] constexpr half_space toward(const half_space& target, const vector& x,
                                            const vector& n, scalar d) const noexcept {
    return {vector(x + n * d), n, target.stiffness};
  }
};

/// The triangle a, b, c with outward normal ∝ (b − a) × (c − a), and what lies within `thickness`
/// behind it. A point is covered when it is on the inner side of all three edges. (2.20-2.23)
template <class Space>
requires(Space::dof == 3) struct triangle {
  using space_type = Space;
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;

  typename Space::coordinates a{}, b{}, c{};              ///< nodes [m]
  scalar stiffness{};                                     ///< K [N/m], > 0
  scalar thickness = std::numeric_limits<scalar>::max();  ///< deepest contact [m] (A18)
  typename Space::coordinates normal{};                   ///< unit; set by prepare()

  /// False for stiffness ≤ 0, anything not finite, and a triangle whose height is lost in rounding.
  [[nodiscard]] constexpr bool prepare() noexcept {
    const vector A = a, B = b, C = c;
    const vector n = Space::cross(vector(B - A), vector(C - A));
    const scalar twice_area = Space::norm(n);
    const scalar longest =
        kernels::larger(kernels::larger(square(B - A), square(C - A)), square(C - B));
    const scalar smallest = scalar(16) * std::numeric_limits<scalar>::epsilon() * longest;
    if (!(twice_area > smallest) || !kernels::is_finite(twice_area)) return false;  // A17
    normal = vector(n / twice_area);
    return Space::is_finite(normal) && thickness > scalar(0) && detail::usable_stiffness(stiffness);
  }
  [[nodiscard]] constexpr vector outward() const noexcept { return normal; }
  [[nodiscard]] constexpr scalar depth(const vector& x) const noexcept {
    const vector A = a;
    return Space::dot(vector(A - x), normal);
  }
  [[nodiscard, gnu::noinline]] constexpr bool covers(const vector& x) const noexcept {
    return inside(a, b, x) && inside(b, c, x) && inside(c, a, x) && depth(x) <= thickness;
  }

  [[nodiscard]] constexpr triangle toward(const triangle& target, const vector& x, const vector& n,
                                          scalar d) const noexcept {
    const vector p = x + n * d;
    return {detail::follow_node<Space>(a, target.a, p, n),
            detail::follow_node<Space>(b, target.b, p, n),
            detail::follow_node<Space>(c, target.c, p, n),
            target.stiffness,
            target.thickness,
            n};
  }

 private:
  [[nodiscard]] static constexpr scalar square(const vector& v) noexcept {
    return Space::dot(v, v);
  }
  /// ((to − from) × (x − from))·n ≥ 0; the height of x above the plane drops out (A15).
  [[nodiscard, gnu::always_inline]] constexpr bool inside(const typename Space::coordinates& from,
                                                          const typename Space::coordinates& to,
                                                          const vector& x) const noexcept {
    const vector start = from, end = to;
    return Space::dot(Space::cross(vector(end - start), vector(x - start)), normal) >= scalar(0);
  }
};

/// The segment a, b; walking from a to b the outward normal is on the right, so a boundary runs
/// counter-clockwise round its body. The triangle of two dimensions.
template <class Space>
requires(Space::dof == 2) struct segment {
  using space_type = Space;
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;

  typename Space::coordinates a{}, b{};                   ///< nodes [m]
  scalar stiffness{};                                     ///< K [N/m], > 0
  scalar thickness = std::numeric_limits<scalar>::max();  ///< deepest contact [m] (A18)
  typename Space::coordinates normal{};                   ///< unit; set by prepare()

  [[nodiscard]] constexpr bool prepare() noexcept {
    const vector A = a, B = b;
    const vector along = B - A;
    const scalar length = Space::norm(along);
    if (!(length > scalar(0)) || !kernels::is_finite(length)) return false;
    normal = vector(along(1) / length, -along(0) / length);
    return Space::is_finite(normal) && thickness > scalar(0) && detail::usable_stiffness(stiffness);
  }
  [[nodiscard]] constexpr vector outward() const noexcept { return normal; }
  [[nodiscard]] constexpr scalar depth(const vector& x) const noexcept {
    const vector A = a;
    return Space::dot(vector(A - x), normal);
  }
  [[nodiscard]] constexpr bool covers(const vector& x) const noexcept {
    const vector A = a, B = b;
    const vector along = B - A;
    return Space::dot(vector(x - A), along) >= scalar(0) &&
           Space::dot(vector(x - B), along) <= scalar(0) && depth(x) <= thickness;
  }

  [[nodiscard]] constexpr segment toward(const segment& target, const vector& x, const vector& n,
                                         scalar d) const noexcept {
    const vector p = x + n * d;
    return {detail::follow_node<Space>(a, target.a, p, n),
            detail::follow_node<Space>(b, target.b, p, n), target.stiffness, target.thickness, n};
  }
};

static_assert(constraint_for<half_space<space<float, 1>>, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
