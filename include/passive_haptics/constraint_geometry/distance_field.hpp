// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A surface given by its signed distance (the menu is in half_space.hpp).

#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/constraint_geometry/surface_probe.hpp>

#include <concepts>

namespace passive_haptics {
inline namespace v0 {

/// A signed distance, positive outside, and its gradient there.
template <class Space>
struct distance_and_gradient {
  typename Space::scalar distance;  ///< φ [m]
  typename Space::vector gradient;  ///< ∇φ; not zero, and of length one if φ is a true distance
};

/// What at(x) returns for a surface whose depth is not a distance and that has its gradient.
template <class Space>
struct gradient_probe {
  typename Space::scalar depth;    ///< d [m], > 0 inside
  typename Space::vector pushing;  ///< −∇d
  bool within;                     ///< x is in the region where the surface is defined
  [[nodiscard]] constexpr const typename Space::vector& push() const noexcept { return pushing; }
  /// The direction of push(); the last axis if push() is zero.
  [[nodiscard]] constexpr typename Space::vector outward() const noexcept {
    return detail::polar_form<Space>(pushing, detail::some_direction<Space>()).direction;
  }
  [[nodiscard]] constexpr bool covered() const noexcept { return within; }
};

/// A function of your own, of any slope. `field` is a plain value, and field(x) returns a distance_and_gradient and
/// does not throw. Depth is the distance to first order, so the stiffness felt is K:
///     d = −φ/s,   s = |∇φ|,   push() = −∇d = (∇φ + d ∇s)/s,   ∇s = ∇²φ ∇φ/s
/// ∇s is a central difference along ∇φ, which calls the field twice more unless s = 1. If the gradient is that of φ
/// (laws.hpp tests it), the force K d push() is conservative. At d > 1 m (or > thickness), which happens near a point
/// of zero slope, there is no contact. A prepare() of the field is called, too.
///     struct wave {
///       ph::distance_and_gradient<scene> operator()(const scene::vector& x) const noexcept;
///     };
///     ph::distance_field<scene, wave>{.field = {}, .stiffness = 500}
template <class Space, class Field>
struct distance_field {
  using space_type = Space;
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr surface_kind kind = surface_kind::smooth;

  Field field{};
  scalar stiffness{};                          ///< K [N/m], > 0
  typename Space::coordinates centre{};        ///< centre of the ball where the field is valid [m]
  scalar radius = kernels::largest<scalar>();  ///< of that ball [m], > 0
  scalar thickness = kernels::largest<scalar>();  ///< deepest contact [m], > 0

  /// False if the field's own prepare() is, for a centre or a distance there that is not finite, and for a
  /// stiffness, a radius or a thickness ≤ 0.
  [[nodiscard]] constexpr bool prepare() noexcept {
    if constexpr (requires {
                    { field.prepare() } -> std::same_as<bool>;
                  }) {
      if (!field.prepare()) return false;
    }
    return Space::is_finite(centre) && detail::usable_length(radius) &&
           detail::usable_length(thickness) && detail::usable_stiffness(stiffness) &&
           kernels::is_finite(scalar(field(vector(centre)).distance));
  }

  using probe = gradient_probe<Space>;
  [[nodiscard]] constexpr probe at(const vector& x) const noexcept(noexcept(field(x))) {
    const distance_and_gradient<Space> found = field(x);
    const bool within = Space::norm(Space::difference(x, centre)) <= radius;
    const scalar squared = Space::dot(found.gradient, found.gradient);
    const scalar rounding = scalar(4) * kernels::rounding<scalar>();
    if (kernels::magnitude(squared - scalar(1)) <= rounding) [[likely]] {
      return {-found.distance, found.gradient, within && -found.distance <= thickness};
    }
    if (!(squared * std::numeric_limits<scalar>::epsilon() > kernels::smallest<scalar>())) {
      return {-found.distance, found.gradient, false};
    }
    const scalar slope = kernels::square_root(squared);
    const scalar depth = -found.distance / slope;
    const vector way = found.gradient * (difference() / slope);
    const vector bend = (field(vector(x + way)).gradient - field(vector(x - way)).gradient) /
                        (scalar(2) * difference());
    return {depth, vector((found.gradient + bend * depth) / slope),
            within && depth <= kernels::smaller(thickness, scalar(1))};
  }

  /// The ball where the field is valid, but of a radius of one metre at most.
  [[nodiscard]] constexpr neighbourhood<Space> around() const noexcept {
    return {centre, kernels::smaller(radius, scalar(1))};
  }

 private:
  /// The step of that difference [m], 1 cm · ∛ε, at which rounding and curvature cause equal errors.
  [[nodiscard]] static constexpr scalar difference() noexcept {
    return scalar(std::numeric_limits<scalar>::digits > 30 ? 6e-8 : 5e-5);
  }
};

}  // namespace v0
}  // namespace passive_haptics
