// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A lower bound of the inertia of a handle that moves and turns, which limits its motion within a tick.
//
//   rigid_inertia   mass, least moment of inertia, spread of the moments, offset of the centre of mass

#include <passive_haptics/base/parameter.hpp>
#include <passive_haptics/device/space.hpp>

namespace passive_haptics {
inline namespace v0 {

/// A body of mass m whose centre of mass lies off the handle point by c. The norm of a wrench there is
///     ‖w‖² = |f|²/m + (|τ| + |c||f|)²/I ≥ wᵀM⁻¹w
/// As the body turns at ω, the centrifugal force m ω × (ω × c) and the gyroscopic torque ω × Iω also act on it.
/// Together they have a norm of at most |ω|² √(m|c|² + (I_max − I_min)²/(4I)).
///
/// In no pose may the device's own inertia matrix at the handle be below that of this body. If the `mass` stated is
/// below the true one, raise `offset` by the square root of their ratio, or more. (docs/design/six_dof.md § 4)
struct rigid_inertia {
  double mass{};    ///< m [kg], > 0
  double least{};   ///< I, the smallest principal moment about the centre of mass [kg·m²], > 0
  double spread{};  ///< I_max − I_min, of the principal moments, an upper bound [kg·m²], ≥ 0
  double offset{};  ///< |c|, centre of mass to handle point, an upper bound [m], ≥ 0

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!detail::positive(mass)) return {"mass", mass, "finite and > 0 kg"};
    if (!detail::positive(least)) return {"least", least, "finite and > 0 kg·m²"};
    if (!detail::not_negative(spread)) return {"spread", spread, "finite and ≥ 0 kg·m²"};
    if (!detail::not_negative(offset)) return {"offset", offset, "finite and ≥ 0 m"};
    return {};
  }
  /// The largest r with M ⪰ r diag(m, I), M the inertia matrix at the handle. With the centre of mass off the handle
  /// by |c| it is r = 1/(1 + q/2 + √(q + q²/4)), q = m|c|²/I. (mathematics.md, Theorem 4)
  [[nodiscard]] constexpr double at_handle() const noexcept {
    const double q = mass * offset * offset / least;
    return 1.0 / (1.0 + q / 2.0 + kernels::square_root(q + q * q / 4.0));
  }
  template <class Port>
  class on;
};

template <class Port>
class rigid_inertia::on {
 public:
  using scalar = typename Port::scalar;

  constexpr explicit on(const rigid_inertia& p) noexcept
      : mass_(detail::number<scalar>(p.mass)),
        least_(detail::number<scalar>(p.least)),
        spread_(detail::number<scalar>(p.spread)),
        offset_(detail::number<scalar>(p.offset)),
        per_mass_(scalar(1) / mass_),
        per_least_(scalar(1) / least_),
        rate_(kernels::square_root(per_least_)),
        pace_(kernels::square_root(scalar(per_mass_ + offset_ * offset_ * per_least_))),
        swing_(kernels::square_root(scalar(scalar(1) + spread_ * per_least_))),
        turning_(kernels::square_root(
            scalar(mass_ * offset_ * offset_ + spread_ * spread_ / (scalar(4) * least_)))) {}
  [[nodiscard]] constexpr rigid_inertia parameters() const noexcept {
    return {.mass = static_cast<double>(mass_),
            .least = static_cast<double>(least_),
            .spread = static_cast<double>(spread_),
            .offset = static_cast<double>(offset_)};
  }

  /// The largest ‖w‖ [√J/s] over all directions of a force and a torque of these lengths [N], [N·m].
  [[nodiscard]] constexpr scalar norm(scalar force, scalar torque) const noexcept {
    const scalar about_centre = torque + offset_ * force;
    return kernels::square_root(
        scalar(force * force * per_mass_ + about_centre * about_centre * per_least_));
  }
  /// ‖w‖ [√J/s] of a wrench.
  [[nodiscard]] constexpr scalar norm(const typename Port::effort& w) const noexcept {
    const scalar force = squared<0>(w), torque = squared<3>(w);
    if (!(offset_ > scalar(0))) {
      return kernels::square_root(scalar(force * per_mass_ + torque * per_least_));
    }
    return norm(kernels::square_root(force), kernels::square_root(torque));
  }
  /// The norm [√J/s] of centrifugal force and gyroscopic torque at an angular velocity of up to `rate` [rad/s].
  [[nodiscard]] constexpr scalar of_turning(scalar rate) const noexcept {
    return rate * rate * turning_;
  }
  /// The largest angular acceleration that a wrench of this norm can cause [rad/s²].
  [[nodiscard]] constexpr scalar turning_by(scalar norm) const noexcept { return norm * rate_; }
  /// The largest acceleration of the handle point that a wrench of this norm can cause [m/s²].
  [[nodiscard]] constexpr scalar moving_by(scalar norm) const noexcept { return norm * pace_; }
  /// |c| [m]; and √(1 + (I_max − I_min)/I), the largest factor by which a free body's angular velocity can grow.
  [[nodiscard]] constexpr scalar offset() const noexcept { return offset_; }
  [[nodiscard]] constexpr scalar swing() const noexcept { return swing_; }
  /// The length of the three components from `First` on: |f| or |Δp| from 0, |τ| or |θ| from 3.
  template <int First>
  [[nodiscard]] static constexpr scalar length(const typename Port::effort& w) noexcept {
    return kernels::square_root(squared<First>(w));
  }
  /// The square of that length.
  template <int First>
  [[nodiscard]] static constexpr scalar squared(const typename Port::effort& w) noexcept {
    return detail::squared_from<Port, First>(w);
  }

 private:
  scalar mass_, least_, spread_, offset_;
  scalar per_mass_, per_least_;
  scalar rate_;     ///< 1/√I [1/√(kg·m²)]
  scalar pace_;     ///< √(1/m + |c|²/I) [1/√kg]
  scalar swing_;    ///< √(1 + spread/I)
  scalar turning_;  ///< √(m|c|² + spread²/(4I))
};

}  // namespace v0
}  // namespace passive_haptics
