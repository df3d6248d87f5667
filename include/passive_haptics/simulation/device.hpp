// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A simulated haptic device: position out, force in, one period per exchange, exact physics.
//
//   command ─▶ driver ─▶ held for T ─┐
//              refuse, saturate,     ├─▶ m ẍ + b ẋ = f + load + F_hand, per axis ─▶ encoders ─▶ sample
//              delay      load, hand ┘   friction, end stops, exactly │             quantum
//                                                                     └─▶ meter: E = ∫ b v² dt − Σ f·Δx
//
// The force is held over T, or until the watchdog drops it. The hand's force is held over 1/substeps of each
// of these two parts, or over a whole part with no_hand. Between those instants the motion is exact, so the
// energy balance closes to rounding. Dry friction is rigid by default. With a model of elastic friction as third
// argument (friction.hpp) the motion is approximated in fine steps, and the balance closes all the same.

#include <passive_haptics/port/concepts.hpp>
#include <passive_haptics/simulation/axis.hpp>
#include <passive_haptics/simulation/driver.hpp>
#include <passive_haptics/simulation/friction_axis.hpp>
#include <passive_haptics/simulation/hand.hpp>
#include <passive_haptics/simulation/meter.hpp>

#include <array>
#include <concepts>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {

/// Models haptic_device_for<Space>. A device whose check() names a fault answers with samples that are not
/// valid, and does not move.
///     device<scene, impedance_hand<scene>> falcon{{.mass = 0.15, .force_limit = 9.0}, {.limit = 5.0}};
///     sample = falcon.exchange(force);
template <class Space, class Hand = no_hand<Space>, device_friction Friction = coulomb_friction>
class device {
 public:
  using space_type = Space;
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  using state = typename physical<Space>::vector;
  using parameters_type = device_parameters<Space>;

  static_assert(hand_for<Hand, Space>,
                "passive_haptics: the hand does not model hand_for: see simulation/hand.hpp");

  explicit device(const parameters_type& parameters = {}, const Hand& hand = {},
                  const Friction& friction = {}) noexcept
      : parameters_(parameters),
        hand_(hand),
        friction_(friction),
        driver_(parameters),
        position_(parameters.start),
        velocity_(parameters.start_velocity),
        moving_mass_(parameters.mass + hand.mass()),
        meter_(kinetic()) {
    memory_.fill(friction.begin());
    const bool has_period = set_period(parameters.period);
    sound_ = has_period && !check();
  }

  /// Takes the command [N], holds the force that is due for one period, and returns the position at its end, the
  /// force held during it and its length.
  device_sample<Space> exchange(const vector& force) noexcept {
    if (!sound_) return {};
    const vector held = driver_.next(force);
    state actuator = to_physical<Space>(held);
    for (int i = 0; i < Space::dof; ++i) component(actuator, i) *= component(parameters_.gain, i);
    const state load = parameters_.load;
    hold(time(), driven_, actuator, load);
    if (coasting_.duration() > 0.0) {
      hold(time() + driven_.duration() * pieces(), coasting_, physical<Space>::zero(), load);
    }
    time_ += static_cast<double>(period_);
    return {measured<Space>(position_, parameters_.quantum), held, period_, true};
  }

  /// Sets the length of the coming periods [s], for jitter. Returns false, and changes nothing, unless T is
  /// finite and > 0.
  bool set_period(double T) noexcept {
    const scalar rounded = static_cast<scalar>(T);
    if (!(rounded > scalar(0)) || !kernels::is_finite(rounded)) return false;
    if (!(rounded == period_)) {
      const double rate = parameters_.damping / moving_mass_;
      const double driven = driven_time<Space>(rounded, parameters_.watchdog);
      driven_ = flow{rate, driven / pieces()};
      coasting_ = flow{rate, (static_cast<double>(rounded) - driven) / pieces()};
    }
    period_ = rounded;
    return true;
  }

  /// The first parameter that is out of its range, if any.
  [[nodiscard]] parameter_fault check() const noexcept {
    if (const auto fault = parameters_.check()) return fault;
    if (const auto fault = fault_of(friction_, parameters_.friction)) return fault;
    return hand_.check();
  }

  [[nodiscard]] const state& position() const noexcept { return position_; }  ///< true [m]
  [[nodiscard]] const state& velocity() const noexcept { return velocity_; }  ///< true [m/s]
  [[nodiscard]] double time() const noexcept { return time_; }                ///< virtual [s]
  [[nodiscard]] Hand& hand() noexcept { return hand_; }
  [[nodiscard]] const Hand& hand() const noexcept { return hand_; }
  [[nodiscard]] const port_energy_meter& meter() const noexcept { return meter_; }
  [[nodiscard]] const parameters_type& parameters() const noexcept { return parameters_; }
  /// ½ (m + m_hand) ‖v‖² [J], with the mass that the hand had at the start.
  [[nodiscard]] double kinetic() const noexcept {
    return moving_mass_ * physical<Space>::dot(velocity_, velocity_) / 2.0;
  }
  /// The energy missing from the balance [J]. It is zero up to rounding; if not, the simulation is wrong.
  [[nodiscard]] double residual() const noexcept { return meter_.residual(kinetic()); }

 private:
  [[nodiscard]] int pieces() const noexcept {
    if constexpr (std::same_as<Hand, no_hand<Space>>) return 1;
    return parameters_.substeps > 1 ? parameters_.substeps : 1;
  }

  /// Moves under one force of the actuators [N] for pieces() holds of the hand's force.
  void hold(double from, const flow& step, const state& actuator, const state& load) noexcept {
    for (int i = 0; i < pieces(); ++i) {
      const double t = from + i * step.duration();
      const state asked = hand_.force(t, position_, velocity_);
      const state push = physical<Space>::is_finite(asked) ? asked : physical<Space>::zero();
      meter_.book(move(step, actuator, push, load));
    }
  }

  /// Moves all axes through one hold of the hand's force.
  energy_flows move(const flow& step, const state& actuator, const state& push,
                    const state& load) noexcept {
    energy_flows flows;
    for (int i = 0; i < Space::dof; ++i) {
      const axis along{moving_mass_, parameters_.damping, parameters_.friction,
                       component(parameters_.lower, i), component(parameters_.upper, i)};
      const double f = component(actuator, i);
      const double pushed = component(push, i);
      const double weight = component(load, i);
      axis_state here{component(position_, i), component(velocity_, i)};
      const axis_motion moved = advance(along, i, here, f + pushed + weight, step);
      component(position_, i) = here.position;
      component(velocity_, i) = here.velocity;
      flows.damping += moved.damping;
      flows.friction += moved.friction;
      flows.stored += moved.stored;
      flows.stops += moved.stops;
      flows.actuator += f * moved.displacement;
      flows.hand += pushed * moved.displacement;
      flows.load += weight * moved.displacement;
    }
    return flows;
  }

  axis_motion advance(const axis& along, int i, axis_state& here, double force,
                      const flow& step) noexcept {
    if constexpr (friction_model<Friction>) {
      auto& memory = memory_[static_cast<std::size_t>(i)];
      return advance_with_friction(friction_, memory, along, here, force, step);
    } else {
      return along.advance(here, force, step);
    }
  }

  parameters_type parameters_;
  Hand hand_;
  Friction friction_;
  std::array<typename Friction::state, Space::dof> memory_{};  ///< of the friction on each axis
  driver<Space> driver_;
  state position_, velocity_;
  double moving_mass_;
  port_energy_meter meter_;
  flow driven_;    ///< one hold of the hand's force before the watchdog drops the force
  flow coasting_;  ///< one hold of the hand's force after that
  scalar period_{};
  compensated_sum<double> time_;
  bool sound_ = false;  ///< true if check() names no fault
};

static_assert(haptic_device_for<device<space<float, 1>>, space<float, 1>>);

}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
