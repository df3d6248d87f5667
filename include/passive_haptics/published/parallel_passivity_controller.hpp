// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Time-domain passivity for an admittance-type device, which takes a velocity and measures the hand's force.
//
//   parallel_passivity_controller   v = v* + β f   force in, velocity out       NOT passive

#include <passive_haptics/port/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

struct parallel_controller_parameters {
  double max_mobility{};  ///< largest β [m/(N·s)], > 0
  double threshold{};     ///< E_thr [J]; below zero it is a loan
  double least_force{};   ///< no action for ‖f̄‖ below this [N], the noise of the sensor
  double loan{};          ///< E at the start [J]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    using detail::not_negative, detail::positive;
    if (!positive(max_mobility)) return {"max_mobility", max_mobility, "finite and > 0 m/(N·s)"};
    if (!kernels::is_finite(threshold)) return {"threshold", threshold, "finite, in J"};
    if (!not_negative(least_force)) return {"least_force", least_force, "finite and ≥ 0 N"};
    if (!not_negative(loan)) return {"loan", loan, "finite and ≥ 0 J"};
    return {};
  }
};

/// Adds a velocity that dissipates the energy E < E_thr that the port has generated (parallel form, admittance
/// causality), for a device that takes a velocity and measures the force of the hand. It is no force bound and no
/// part of a port; call it once per tick, as the last step before the velocity is sent.
///     E(n) = E(n−1) + dt v_held·f̄(n)
///     v = v* + β f̄,   β = (E_thr − E − dt v*·f̄) / (dt ‖f̄‖²)  in [0, max_mobility]
/// f̄(n) [N] is the MEAN force of the hand over the tick that has just ended, the one over which v_held was held: with
/// it E is the energy at the port exactly. Sources: Hannaford and Ryu 2002 (β); for the pairing § 2(c).
///
/// It is NOT passive: a constant force cannot draw energy, but one that turns round within a tick can. The controller
/// assumes that the robot holds the commanded velocity, or that the held velocity is passed.
template <class Space>
class parallel_passivity_controller {
 public:
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;

  constexpr explicit parallel_passivity_controller(const parallel_controller_parameters& p) noexcept
      : parameters_(p),
        max_mobility_(detail::number<scalar>(p.max_mobility)),
        threshold_(detail::number<scalar>(p.threshold)),
        least_force_(detail::number<scalar>(p.least_force)) {
    reset();
  }
  constexpr void reset() noexcept {
    energy_ = detail::number<scalar>(parameters_.loan);
    held_ = Space::zero();
  }
  [[nodiscard]] constexpr parameter_fault check() const noexcept { return parameters_.check(); }
  [[nodiscard]] constexpr scalar energy() const noexcept { return energy_; }  ///< E [J]

  /// Returns the velocity to hold next [m/s], given the desired velocity [m/s], the mean force of the hand
  /// on the device over the last tick [N] and the length dt of that tick [s]. It assumes that the velocity
  /// it returned last has been held.
  [[nodiscard]] constexpr vector velocity(const vector& desired, const vector& force,
                                          scalar dt) noexcept {
    return velocity(desired, force, dt, held_);
  }
  /// The same for a robot that reports the velocity it really held [m/s]. If a value is not finite or dt ≤ 0,
  /// the velocity is zero and all credit is written off.
  [[nodiscard]] constexpr vector velocity(const vector& desired, const vector& force, scalar dt,
                                          const vector& held) noexcept {
    const scalar gained = dt * Space::dot(held, force);
    const scalar square = Space::dot(force, force);
    const scalar predicted = energy_ + gained + dt * Space::dot(desired, force);
    if (!(dt > scalar(0)) || !kernels::is_finite(predicted) || !kernels::is_finite(square)) {
      energy_ = kernels::smaller(energy_, scalar(0));
      held_ = Space::zero();
      return Space::zero();
    }
    energy_ += gained;
    vector next = desired;
    if (predicted < threshold_ && square > scalar(0) && square >= least_force_ * least_force_) {
      next += force * kernels::smaller((threshold_ - predicted) / (dt * square), max_mobility_);
    }
    held_ = next;
    return next;
  }

 private:
  parallel_controller_parameters parameters_;
  scalar max_mobility_, threshold_, least_force_;
  scalar energy_{};                     ///< E [J]
  typename Space::coordinates held_{};  ///< velocity returned last [m/s]
};

}  // namespace v0
}  // namespace passive_haptics
