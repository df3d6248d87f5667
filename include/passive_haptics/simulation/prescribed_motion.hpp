// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A hand that is a velocity source: the device goes where the caller says, whatever the actuators do.
// It needs no mass and no integration, and it is the worst case of every proof without a mass.

#include <passive_haptics/port/concepts.hpp>
#include <passive_haptics/simulation/driver.hpp>
#include <passive_haptics/simulation/friction_model.hpp>
#include <passive_haptics/simulation/meter.hpp>

#include <array>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {

/// Models haptic_device_for<Space>: each exchange travels from one position to the next at constant
/// velocity while the force is held. The meter books exactly
///     E += b ‖Δx‖²/T − f·Δx   [J]
/// which is lemma L1 of mathematics.md with equality. In a period T longer than the watchdog w the force is zero after w, so it
/// works over w/T of the way; move_via() chooses the position at that instant. Dry friction, f_c Σ|Δxᵢ|
/// or the work against a model of friction.hpp, is booked beside E, as in device.
///
/// It uses the parameters damping, friction, force_limit, latency, quantum, period, watchdog and start,
/// and ignores the others. In float the sample's position is rounded and the true one is not; give
/// positions that are exact in float, so that observer and meter can be compared.
template <class Space, device_friction Friction = coulomb_friction>
class prescribed_motion {
 public:
  using space_type = Space;
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  using state = typename physical<Space>::vector;
  using parameters_type = device_parameters<Space>;

  explicit prescribed_motion(const parameters_type& parameters = {},
                             const Friction& friction = {}) noexcept
      : parameters_(parameters),
        friction_(friction),
        driver_(parameters),
        position_(parameters.start),
        next_(parameters.start),
        dropped_at_(parameters.start),
        sound_(!parameters.check() && !fault_of(friction, parameters.friction)),
        period_(static_cast<scalar>(parameters.period)) {
    memory_.fill(friction.begin());
  }

  /// Sets the position at the end of the next exchange [m]. A position that is not finite is ignored.
  void move_to(const state& next) noexcept {
    if (!physical<Space>::is_finite(next)) return;
    next_ = next;
    straight_ = true;
  }
  /// The same, and sets the position [m] at which the watchdog drops the force. In a period that the
  /// watchdog does not cut short, `dropped_at` is ignored.
  void move_via(const state& dropped_at, const state& next) noexcept {
    if (!physical<Space>::is_finite(dropped_at) || !physical<Space>::is_finite(next)) return;
    dropped_at_ = dropped_at;
    next_ = next;
    straight_ = false;
  }

  device_sample<Space> exchange(const vector& force) noexcept {
    if (!sound_) return {};
    const vector held = driver_.next(force);
    const double T = static_cast<double>(period_);
    const double driven = driven_time<Space>(period_, parameters_.watchdog);
    if (!(driven < T)) {
      travel(next_, T, to_physical<Space>(held));
    } else {
      if (straight_) dropped_at_ = state(position_ + (next_ - position_) * (driven / T));
      travel(dropped_at_, driven, to_physical<Space>(held));
      travel(next_, T - driven, physical<Space>::zero());
    }
    straight_ = true;  // until the next move_via()
    time_ += T;
    return {measured<Space>(position_, parameters_.quantum), held, period_, true};
  }

  /// Sets the length of the coming periods [s], for jitter. Returns false, and changes nothing, unless T is
  /// finite and > 0.
  bool set_period(double T) noexcept {
    const scalar rounded = static_cast<scalar>(T);
    if (!(rounded > scalar(0)) || !kernels::is_finite(rounded)) return false;
    period_ = rounded;
    return true;
  }

  [[nodiscard]] parameter_fault check() const noexcept {
    if (const auto fault = parameters_.check()) return fault;
    return fault_of(friction_, parameters_.friction);
  }
  /// The energy [J], friction included, that exchange(command) would book at the port if the device went straight
  /// to `next` [m] in a period that the watchdog does not cut short.
  [[nodiscard]] double price(const state& next, const vector& command) const noexcept {
    auto trial = *this;
    trial.parameters_.watchdog = device_parameters<Space>::infinity;
    trial.move_to(next);
    trial.meter_ = {};
    trial.exchange(command);
    return trial.meter_.with_friction();
  }
  /// The force that exchange(command) would hold [N].
  [[nodiscard]] vector upcoming(const vector& command) const noexcept {
    return driver_.upcoming(command);
  }
  [[nodiscard]] const state& position() const noexcept { return position_; }  ///< true [m]
  [[nodiscard]] double time() const noexcept { return time_; }                ///< virtual [s]
  [[nodiscard]] const port_energy_meter& meter() const noexcept { return meter_; }
  [[nodiscard]] const parameters_type& parameters() const noexcept { return parameters_; }

 private:
  /// Moves to `there` [m] at constant velocity in `time` [s], under a constant force of the actuators [N].
  void travel(const state& there, double time, const state& force) noexcept {
    const state step = there - position_;
    const double damped = parameters_.damping * physical<Space>::dot(step, step) / time;
    const double work = physical<Space>::dot(force, step);
    const friction_work rubbed = rub(step, time);
    meter_.book({.damping = damped,
                 .friction = rubbed.dissipated,
                 .actuator = work,
                 .hand = damped + rubbed.work - work,
                 .stored = rubbed.work - rubbed.dissipated});
    position_ = there;
  }

  friction_work rub(const state& step, double time) noexcept {
    friction_work sum;
    if constexpr (friction_model<Friction>) {
      for (int i = 0; i < Space::dof; ++i) {
        const friction_work took =
            friction_.slide(memory_[static_cast<std::size_t>(i)], component(position_, i),
                            component(step, i), time);
        sum.work += took.work;
        sum.dissipated += took.dissipated;
      }
    } else {
      double way = 0.0;
      for (int i = 0; i < Space::dof; ++i) way += std::abs(component(step, i));
      sum.work = sum.dissipated = parameters_.friction * way;
    }
    return sum;
  }

  parameters_type parameters_;
  Friction friction_;
  std::array<typename Friction::state, Space::dof> memory_{};  ///< of the friction on each axis
  driver<Space> driver_;
  state position_, next_, dropped_at_;
  bool straight_ = true;
  bool sound_;
  scalar period_;
  port_energy_meter meter_;
  compensated_sum<double> time_;
};

static_assert(haptic_device_for<prescribed_motion<space<float, 1>>, space<float, 1>>);

}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
