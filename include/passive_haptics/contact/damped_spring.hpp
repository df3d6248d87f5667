// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The contact law that settles (the menu is in spring.hpp).

#include <passive_haptics/contact/sampled_spring.hpp>
#include <passive_haptics/port/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

/// f* = max(0, K_s d − D_s max(0, v_out)) [N]: damping on the way OUT only, so it never adds force.
///     K_s = min(K, κ m/T²)            [N/m], at which a mass sampled every T settles
///     D_s = min(2ζ√(K_s m), β m/T)    [N·s/m]
/// Static stiffness is K exactly, up to the cap κ m/T² (10 kN/m for 0.1 kg at 1 kHz). Source:
/// docs/design/mathematics.md § 9; the defaults settle on an ideal device, κ = 0.3 does not.
///
/// Deeper than F/K_s, with F the `force_limit`, the spring is the secant F/d, so that a heavy device comes out at a
/// speed from which F can stop it:  f* = max(0, F − min(D_s, 2ζ√(F m/d)) max(0, v_out)).
struct damped_spring {
  double mass{};                    ///< m, apparent mass of the device [kg], a lower bound
  double stiffness_fraction = 0.1;  ///< κ, of m/T²
  double damping_ratio = 1.0;       ///< ζ
  double damping_fraction = 0.5;    ///< β, of m/T
  double force_limit = std::numeric_limits<double>::infinity();  ///< F, limit of the motors [N]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    return detail::sampled_fault(*this);
  }
  template <class Space>
  class on;
};

template <class Space>
class damped_spring::on {
 public:
  using scalar = typename Space::scalar;

  constexpr explicit on(const damped_spring& p) noexcept { set(p); }
  /// New parameters take effect at the next adopt().
  constexpr void set(const damped_spring& p) noexcept { rule_ = detail::damped_mass<scalar>(p); }
  [[nodiscard]] constexpr damped_spring parameters() const noexcept {
    damped_spring p;
    rule_.state(p);
    return p;
  }

  constexpr void adopt(scalar K, scalar T, int late = 0) noexcept {
    stiffness_ = rule_.stiffness(K, scalar(0), T, late);
    damping_ = rule_.damping(stiffness_, T, detail::late_limits<scalar>(late, scalar(6)));
  }
  static constexpr softened_by softener = softened_by::mass_and_tick;
  [[nodiscard]] constexpr scalar stiffness() const noexcept { return stiffness_; }  ///< K_s [N/m]
  [[nodiscard]] constexpr scalar damping() const noexcept { return damping_; }  ///< D_s [N·s/m]
  /// √(K_s/m) [1/s].
  [[nodiscard]] constexpr scalar natural() const noexcept {
    return kernels::square_root(stiffness_ / rule_.mass());
  }

  [[nodiscard]] constexpr scalar force(scalar depth, scalar outward_speed) const noexcept {
    if (!(depth > scalar(0))) return scalar(0);
    const scalar pressed = stiffness_ * depth;
    if (pressed > rule_.force_limit()) return saturated(depth, outward_speed);
    return kernels::larger(pressed - resistance(outward_speed), scalar(0));
  }
  /// Below the force limit the inverse of force(), above it F/K_s.
  [[nodiscard]] constexpr scalar depth(scalar force, scalar outward_speed) const noexcept {
    return force > scalar(0) ? kernels::depth_bound(force + resistance(outward_speed), stiffness_)
                             : scalar(0);
  }

 private:
  [[nodiscard]] constexpr scalar saturated(scalar depth, scalar outward_speed) const noexcept {
    const scalar secant = rule_.critical(rule_.force_limit() * rule_.mass() / depth);
    const scalar speed = kernels::larger(outward_speed, scalar(0));
    return kernels::larger(rule_.force_limit() - kernels::smaller(damping_, secant) * speed,
                           scalar(0));
  }
  [[nodiscard]] constexpr scalar resistance(scalar outward_speed) const noexcept {
    return damping_ * kernels::larger(outward_speed, scalar(0));
  }

  detail::damped_mass<scalar> rule_;
  scalar stiffness_{}, damping_{};
};

static_assert(contact_law_for<damped_spring, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
