// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Balls and cavities (the menu is in half_space.hpp).

#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/constraint_geometry/surface_probe.hpp>

namespace passive_haptics {
inline namespace v0 {

/// The sphere |x − c| = r. A solid ball has depth r − |x − c| and pushes away from its centre; a cavity has depth
/// |x − c| − r and pushes towards it. At the centre, where the normal is not defined, the direction of x − c is taken
/// to be the last axis. In two dimensions this is a circle, in one an interval.
template <class Space>
struct sphere {
  using space_type = Space;
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr surface_kind kind = surface_kind::smooth;

  typename Space::coordinates centre{};  ///< c [m]
  scalar radius{};                       ///< r [m], > 0
  scalar stiffness{};                    ///< K [N/m], > 0
  felt_from felt = felt_from::outside;

  /// False for a radius or a stiffness that is not above zero, and for anything not finite.
  [[nodiscard]] constexpr bool prepare() noexcept {
    return Space::is_finite(centre) && detail::usable_length(radius) &&
           detail::usable_stiffness(stiffness) &&
           (felt == felt_from::outside || felt == felt_from::inside);
  }

  using probe = distance_probe<Space>;
  [[nodiscard]] constexpr probe at(const vector& x) const noexcept {
    const auto from_centre =
        detail::polar_form<Space>(Space::difference(x, centre), detail::some_direction<Space>());
    const scalar depth = radius - from_centre.length;
    if (felt == felt_from::outside) return {depth, from_centre.direction, true};
    return {-depth, vector(-from_centre.direction), true};
  }

  /// A sphere of the target's size and side, placed so that x lies d [m] deep in it, under the normal n, before its centre.
  [[nodiscard]] constexpr sphere toward(const sphere& target, const vector& x, const vector& n,
                                        scalar d) const noexcept {
    const scalar r = target.radius, above = kernels::smaller(d, r * scalar(0.999)) - r;
    const scalar way = target.felt == felt_from::outside ? above : d + r;
    return {vector(x + n * way), r, target.stiffness, target.felt};
  }

  /// The ball about its centre of twice its radius.
  [[nodiscard]] constexpr neighbourhood<Space> around() const noexcept {
    return {centre, scalar(2) * radius};
  }
};

static_assert(constraint_for<sphere<space<float, 1>>, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
