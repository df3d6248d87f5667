// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Moves the nodes of a constraint towards those of the environment along the lines of Fig. 2.5, clamped to the ends
// of the lines and projected (A22). Without the clamp half of random cases leave their line, and some triangles flip.

#include <passive_haptics/port/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace detail {

/// True on 32-bit targets, where code size matters more than the cost of a call, so a function that is used several
/// times is not inlined.
inline constexpr bool saves_bytes = sizeof(void*) <= 4;

/// The new position of a node [m] when its constraint's plane is to pass through p with unit normal n: the point of
/// the line from→to nearest to its intersection with the plane, projected onto the plane. (Fig. 2.5)
template <class Space>
[[nodiscard, gnu::always_inline]] constexpr typename Space::coordinates node_on_plane(
    const typename Space::coordinates& from, const typename Space::coordinates& to,
    const typename Space::coordinates& p, const typename Space::coordinates& n) noexcept {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  const vector line = Space::difference(to, from);
  const scalar across = Space::dot(line, n);
  const scalar smallest = std::numeric_limits<scalar>::epsilon() * Space::norm(line);
  scalar t(0);
  if (across > smallest || across < -smallest) {
    t = Space::dot(Space::difference(p, from), n) / across;
    t = kernels::clamped(t, scalar(0), scalar(1));
  }
  const vector node = vector(from) + line * t;
  return vector(node + vector(n) * Space::dot(Space::difference(p, node), n));
}
/// The same, not inlined; coordinates are passed instead of vectors, because they fit into registers.
template <class Space>
[[nodiscard, gnu::noinline]] constexpr typename Space::coordinates call_node_on_plane(
    typename Space::coordinates from, typename Space::coordinates to,
    typename Space::coordinates through, typename Space::coordinates normal) noexcept {
  return node_on_plane<Space>(from, to, through, normal);
}
template <class Space>
[[nodiscard, gnu::always_inline]] constexpr typename Space::coordinates follow_node(
    const typename Space::coordinates& from, const typename Space::coordinates& to,
    const typename Space::coordinates& through,
    const typename Space::coordinates& normal) noexcept {
  if constexpr (saves_bytes) return call_node_on_plane<Space>(from, to, through, normal);
  return node_on_plane<Space>(from, to, through, normal);
}

}  // namespace detail
}  // namespace v0
}  // namespace passive_haptics
