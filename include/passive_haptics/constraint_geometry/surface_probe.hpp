// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The common part of the curved surfaces: the result of at(x), the region of a surface, and the direction of its
// force (the menu is in half_space.hpp, the proofs are in docs/design/curved.md).

#include <passive_haptics/port/concepts.hpp>

#include <cstdint>

namespace passive_haptics {
inline namespace v0 {

/// The side from which a closed surface is touched: from outside it is a solid, from inside a cavity.
enum class felt_from : std::uint8_t { outside, inside };

/// A ball around the region that a surface is meant for, in which laws.hpp tests it.
template <class Space>
struct neighbourhood {
  typename Space::coordinates centre{};  ///< [m]
  typename Space::scalar radius{};       ///< [m]
};

/// What at(x) returns for a surface whose depth is the distance to it, so that ∇d = −outward().
template <class Space>
struct distance_probe {
  typename Space::scalar depth;   ///< [m], > 0 inside
  typename Space::vector normal;  ///< unit
  bool within;                    ///< x is in the region where the surface is defined
  [[nodiscard]] constexpr const typename Space::vector& outward() const noexcept { return normal; }
  [[nodiscard]] constexpr bool covered() const noexcept { return within; }
};

namespace detail {

/// −∇d, the direction in which the force of a spring is conservative: push(), or outward() if there is none.
template <class Space>
[[nodiscard]] constexpr typename Space::vector steepest_push(const auto& probe) noexcept {
  if constexpr (says_push<decltype(probe)>) return probe.push();
  return probe.outward();
}

/// The last axis, for points at which the direction is not defined.
template <class Space>
[[nodiscard]] constexpr typename Space::vector some_direction() noexcept {
  using scalar = typename Space::scalar;
  typename Space::vector up = Space::zero();
  Space::component(up, Space::dof - 1) = scalar(1);
  return up;
}

/// The length and the direction of a vector.
template <class Space>
struct polar {
  typename Space::scalar length;
  typename Space::vector direction;  ///< unit
};

/// The length and the direction of v. The direction is `otherwise` where v is NaN, or so short that its
/// square is below the smallest normal number over ε.
template <class Space>
[[nodiscard, gnu::always_inline]] constexpr polar<Space> polar_form(
    const typename Space::vector& v, const typename Space::vector& otherwise) noexcept {
  using scalar = typename Space::scalar;
  const scalar squared = Space::dot(v, v);
  const scalar length = kernels::square_root(squared);
  if (!(squared * std::numeric_limits<scalar>::epsilon() > kernels::smallest<scalar>())) {
    return {length, otherwise};
  }
  return {length, typename Space::vector(v / length)};
}

/// Gives `v` the length one; false if it has no direction or is not finite.
template <class Space>
[[nodiscard]] constexpr bool make_unit(typename Space::coordinates& v) noexcept {
  using scalar = typename Space::scalar;
  const typename Space::vector given = v;
  scalar largest(0);
  for (int i = 0; i < Space::dof; ++i) {
    largest = kernels::larger(largest, kernels::magnitude(scalar(Space::component(given, i))));
  }
  if (!Space::is_finite(given) || !(largest > scalar(0))) return false;
  const typename Space::vector scaled = given / largest;  // so that no square underflows
  v = typename Space::vector(scaled / Space::norm(scaled));
  return Space::is_finite(v);
}

[[nodiscard]] constexpr bool usable_length(real auto length) noexcept {
  return length > decltype(length)(0) && kernels::is_finite(length);
}

}  // namespace detail

}  // namespace v0
}  // namespace passive_haptics
