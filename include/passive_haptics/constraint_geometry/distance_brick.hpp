// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A piece of a sampled distance field (the menu is in half_space.hpp).

#include <passive_haptics/constraint_geometry/distance_field.hpp>
#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/constraint_geometry/surface_probe.hpp>
#include <passive_haptics/device/eigen_space.hpp>

#include <array>
#include <cstddef>

namespace passive_haptics {
inline namespace v0 {

/// φ(x) = Σ cᵢⱼₖ B(ξ − i) B(η − j) B(ζ − k) [m], with ξ, η, ζ the coordinates of x − origin in units of `spacing` and
/// B the quadratic B-spline. Depth is d = −φ, and push() = ∇φ is continuous and the exact gradient of φ, so the force
/// K d push() is conservative for any coefficients. It covers a cube of two spacings, from 0.5 to 2.5 spacings along
/// each axis. φ may have any slope, because prepare() scales it to that of a distance.
template <class Space>
requires(Space::dof == 3) struct distance_brick {
  using space_type = Space;
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr surface_kind kind = surface_kind::smooth;
  static constexpr std::size_t side = 4;

  std::array<scalar, side * side * side> coefficients{};  ///< c [m]; the last axis runs fastest
  typename Space::coordinates origin{};  ///< of the first node [m]; its axes are those of the space
  scalar spacing{};                      ///< from node to node [m], > 0
  scalar stiffness{};                    ///< K [N/m], > 0
  scalar thickness = kernels::largest<scalar>();  ///< deepest contact [m], > 0

  /// The brick of a distance function phi(x) [m], sampled on a grid of spacing h [m] and one node beyond. With plain
  /// samples as coefficients φ would be smoothed: a ball of r = 50 mm on h = 5 mm shrinks by h²/(4r) = 0.125 mm. So
  ///     c = φ − (h²/8) ∇²φ      by second differences
  /// which reproduces every quadratic φ exactly (quasi-interpolation: de Boor and Fix, "Spline
  /// approximation by quasiinterpolants", J. Approx. Theory 8, 1973).
  template <class Distance>
  [[nodiscard]] static constexpr distance_brick sampled(const Distance& phi, const vector& origin,
                                                        scalar spacing, scalar stiffness) {
    distance_brick brick;
    brick.origin = origin;
    brick.spacing = spacing;
    brick.stiffness = stiffness;
    for (std::size_t node = 0; node < brick.coefficients.size(); ++node) {
      vector x = origin;
      x(0) += spacing * scalar(static_cast<int>(node / (side * side)));
      x(1) += spacing * scalar(static_cast<int>(node / side % side));
      x(2) += spacing * scalar(static_cast<int>(node % side));
      const scalar here = phi(x);
      scalar bend(0);
      for (int axis = 0; axis < 3; ++axis) {
        vector next = x, last = x;
        next(axis) += spacing;
        last(axis) -= spacing;
        bend += (scalar(phi(next)) - here) + (scalar(phi(last)) - here);
      }
      brick.coefficients[node] = here - bend / scalar(8);
    }
    return brick;
  }

  /// Divides φ by its slope s₀ at the surface, near the middle of the cube, because the stiffness felt is K|∇φ|². If
  /// s₀ is within 1/16 of 1, φ is a distance and stays unchanged; so does a φ without a slope beyond rounding. If φ is
  /// more than √2 times steeper in a corner, s₀ is that slope over √2, so the stiffness felt is about 2K at most. False
  /// for coefficients or an origin that are not finite, for a spacing, a stiffness or a thickness ≤ 0, and for a slope
  /// that overflows.
  [[nodiscard]] constexpr bool prepare() noexcept {
    scalar most(0);
    for (const scalar& c : coefficients) {
      if (!kernels::is_finite(c)) return false;
      most = kernels::larger(most, kernels::magnitude(c));
    }
    if (!(Space::is_finite(origin) && detail::usable_length(spacing) &&
          detail::usable_length(thickness) && detail::usable_stiffness(stiffness))) {
      return false;
    }
    const scalar slope = slope_at_the_surface();
    if (!kernels::is_finite(slope)) return false;
    const bool slopes = slope * spacing > kernels::rounding<scalar>() * most;
    if (slopes && kernels::magnitude(slope - scalar(1)) > scalar(1) / scalar(16)) {
      for (scalar& c : coefficients) c /= slope;
    }
    return true;
  }

  using probe = gradient_probe<Space>;
  [[nodiscard]] constexpr probe at(const vector& x) const noexcept {
    const vector r = Space::difference(x, origin);
    const basis first(r(0) / spacing), second(r(1) / spacing), third(r(2) / spacing);
    scalar value(0), by_first(0), by_second(0), by_third(0);
    for (std::size_t i = 0; i < 3; ++i) {
      scalar plane(0), plane_second(0), plane_third(0);
      for (std::size_t j = 0; j < 3; ++j) {
        const scalar* row =
            &coefficients[((first.node + i) * side + second.node + j) * side + third.node];
        const scalar line = third.blend(row), slope = third.blend_slopes(row);
        plane += second.weight[j] * line;
        plane_second += second.slope[j] * line;
        plane_third += second.weight[j] * slope;
      }
      value += first.weight[i] * plane;
      by_first += first.slope[i] * plane;
      by_second += first.weight[i] * plane_second;
      by_third += first.weight[i] * plane_third;
    }
    return {-value, vector(by_first / spacing, by_second / spacing, by_third / spacing),
            first.within && second.within && third.within && -value <= thickness};
  }

  /// The ball around the covered cube.
  [[nodiscard]] constexpr neighbourhood<Space> around() const noexcept {
    const scalar middle = spacing * scalar(1.5);
    return {vector(vector(origin) + vector(middle, middle, middle)), scalar(1.8) * spacing};
  }

 private:
  /// s₀
  [[nodiscard]] constexpr scalar slope_at_the_surface() const noexcept {
    const vector least = vector(origin) + vector(spacing, spacing, spacing) * scalar(0.5);
    vector x = least + vector(spacing, spacing, spacing);
    for (int step = 0; step < 4; ++step) {  // Newton's method, kept in the cube
      const probe here = at(x);
      const scalar squared = Space::dot(here.pushing, here.pushing);
      if (!(squared > scalar(0))) break;
      x += here.pushing * (here.depth / squared);
      for (int axis = 0; axis < 3; ++axis) {
        x(axis) = kernels::clamped(x(axis), least(axis), least(axis) + scalar(2) * spacing);
      }
    }
    scalar steepest(0);
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const auto of = [corner](std::size_t bit) { return scalar((corner & bit) != 0 ? 2 : 0); };
      const vector there(of(1), of(2), of(4));
      steepest = kernels::larger(steepest, Space::norm(at(least + there * spacing).pushing));
    }
    return kernels::larger(Space::norm(at(x).pushing), steepest * scalar(0.7071067811865476));
  }
  /// The values and slopes of the three B-splines along one axis that are not zero.
  struct basis {
    std::array<scalar, 3> weight;
    std::array<scalar, 3> slope;  ///< per spacing
    std::size_t node;             ///< the first of the three
    bool within;

    /// `at` is in spacings from the first node. Beyond the cube the outermost polynomial is extended.
    constexpr explicit basis(scalar at) noexcept
        : node(at < scalar(1.5) ? 0 : 1), within(at >= scalar(0.5) && at <= scalar(2.5)) {
      const scalar t = at - scalar(static_cast<int>(node + 1));  // from the middle one of the three
      const scalar before = scalar(0.5) - t, after = scalar(0.5) + t;
      weight = {before * before / scalar(2), scalar(0.75) - t * t, after * after / scalar(2)};
      slope = {-before, scalar(-2) * t, after};
    }
    [[nodiscard]] constexpr scalar blend(const scalar* row) const noexcept {
      return weight[0] * row[0] + weight[1] * row[1] + weight[2] * row[2];
    }
    [[nodiscard]] constexpr scalar blend_slopes(const scalar* row) const noexcept {
      return slope[0] * row[0] + slope[1] * row[1] + slope[2] * row[2];
    }
  };
};

static_assert(surface_for<distance_brick<space<float, 3>>, space<float, 3>>);

}  // namespace v0
}  // namespace passive_haptics
