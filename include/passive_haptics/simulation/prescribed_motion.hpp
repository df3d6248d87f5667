// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A hand that is a velocity source: it goes where the caller says, whatever the actuators do. It
// needs no mass and no integration, and it is the worst case of every proof that names no mass.

#include <passive_haptics/concepts.hpp>
#include <passive_haptics/simulation/driver.hpp>
#include <passive_haptics/simulation/meter.hpp>

namespace passive_haptics::inline v0::simulation {

/// Models haptic_device_for<Space>: each exchange travels from one position to the next at constant
/// velocity while the force is held. The meter books exactly
///     E += b ‖Δx‖²/T − f·Δx
/// the equality of lemma L1. Of the parameters it takes damping, force_limit, latency, quantum,
/// period and start; the rest means nothing to it. In float, the sample's position is rounded and
/// the true one is not: next positions that are exact in float keep observer and meter comparable.
template <class Space>
class prescribed_motion {
 public:
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  using state = typename physical<Space>::vector;
  using parameters_type = device_parameters<Space>;

  explicit prescribed_motion(const parameters_type& parameters = {}) noexcept
      : parameters_(parameters),
        driver_(parameters),
        position_(parameters.start),
        next_(parameters.start),
        sound_(!parameters.check()),
        period_(static_cast<scalar>(parameters.period)) {}

  /// Where to be at the end of the next exchange [m]. One that is not finite is ignored.
  void move_to(const state& next) noexcept {
    if (physical<Space>::is_finite(next)) next_ = next;
  }

  device_sample<Space> exchange(const vector& force) noexcept {
    if (!sound_) return {};
    const vector held = driver_.next(force);
    const state step = next_ - position_;
    const double T = static_cast<double>(period_);
    const double damped = parameters_.damping * physical<Space>::dot(step, step) / T;
    const double work = physical<Space>::dot(to_physical<Space>(held), step);
    meter_.book({.damping = damped, .actuator = work, .hand = damped - work});
    position_ = next_;
    time_ += T;
    return {measured<Space>(position_, parameters_.quantum), held, period_, true};
  }

  /// The length of the coming periods [s], for jitter. False, and nothing changes, unless it is
  /// finite and > 0.
  bool set_period(double T) noexcept {
    const scalar rounded = static_cast<scalar>(T);
    if (!(rounded > scalar(0)) || !kernels::is_finite(rounded)) return false;
    period_ = rounded;
    return true;
  }

  [[nodiscard]] parameter_fault<double> check() const noexcept { return parameters_.check(); }
  [[nodiscard]] const state& position() const noexcept { return position_; }  ///< true [m]
  [[nodiscard]] double time() const noexcept { return time_; }                ///< virtual [s]
  [[nodiscard]] const port_energy_meter& meter() const noexcept { return meter_; }
  [[nodiscard]] const parameters_type& parameters() const noexcept { return parameters_; }

 private:
  parameters_type parameters_;
  driver<Space> driver_;
  state position_, next_;
  bool sound_;
  scalar period_;
  port_energy_meter meter_;
  compensated_sum<double> time_;
};

static_assert(haptic_device_for<prescribed_motion<space<float, 1>>, space<float, 1>>);

}  // namespace passive_haptics::inline v0::simulation
