// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The impedance side of a two-port: force out to the device, measured displacement back.

#include <passive_haptics/concepts.hpp>
#include <passive_haptics/loop.hpp>
#include <passive_haptics/two_port/packet.hpp>

#include <array>

namespace passive_haptics {
inline namespace v0 {

/// What a tick of the impedance side knows.
template <class Space>
struct impedance_result {
  typename Space::vector force;   ///< on the device [N]
  typename Space::scalar energy;  ///< E1 [J]
  event what = event::nominal;    ///< the worst that happened
  bool limited = false;           ///< the bound changed the desired force
};

/// The device's end of the channel: displays the newest force that has arrived, as far as the
/// ledger covers the worst motion of the coming tick. What it promises, `passivity`, is the sum of
/// both ports ≥ 0 with any other side that keeps E1 ≥ 0, under the assumptions of its bound.
///     ph::impedance_side master{scene{}, ph::two_port_energy<scene>{.damping = 2.0},
///                               ph::strict_bound<scene>{}};
///     master.receive(packet);                                // as many as have come, in any order
///     device.command(master.tick(sample).force);
///     channel.send(master.packet());                         // {E_in, position}
/// A channel that falls silent holds the last force, until the ledger is spent.
template <class Space, class Observer, class Bound>
class impedance_side {
 public:
  using space_type = Space;
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  using packet_type = port_packet<scalar, typename Space::coordinates>;
  static constexpr guarantee passivity = std::min(Observer::passivity, Bound::passivity);

  static_assert(energy_observer_for<Observer, Space>,
                "passive_haptics: the observer does not model energy_observer_for: "
                "see concepts.hpp");
  static_assert(force_bound_for<Bound, Space>,
                "passive_haptics: the bound does not model force_bound_for: see concepts.hpp");
  static_assert(
      !Bound::traits.needs_local_model,
      "passive_haptics: impedance_side has no local model for this bound to compare with");

  constexpr impedance_side(Space /*scene*/, const Observer& observer, const Bound& bound,
                           const loop_limits<Space>& limits = {}) noexcept
      : observer_(observer), bound_(bound), limits_(limits) {
    held_.fill(Space::zero());
    sound_ = !check();
  }

  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept {
    if (const auto fault = limits_.check()) return fault;
    if (const auto fault = observer_.check()) return fault;
    return bound_.check();
  }

  /// A packet {E_in, force} from the other side. A force that is not finite is not taken over.
  constexpr void receive(const packet_type& packet) noexcept {
    observer_.receive(packet.energy);
    if (packet.number <= newest_ || !Space::is_finite(packet.payload)) return;
    newest_ = packet.number;
    desired_ = packet.payload;
  }

  /// One tick: the device is at `position` [m], `dt` [s] after the last one.
  [[nodiscard]] constexpr impedance_result<Space> tick(const vector& position, scalar dt) noexcept {
    return tick(position, dt, held_.back(), desired_);
  }
  /// The same for a device that reports the force it really held.
  [[nodiscard]] constexpr impedance_result<Space> tick(
      const device_sample<Space>& sample) noexcept {
    return tick(sample, desired_);
  }
  /// The same for a desired force of your own making.
  [[nodiscard]] constexpr impedance_result<Space> tick(const device_sample<Space>& sample,
                                                       const vector& desired) noexcept {
    if (!sample.valid) return refuse(event::rejected_sample, sample.dt);
    return tick(sample.position, sample.dt, sample.held, desired);
  }

  /// {E_in, position} for the other side, to send after each tick.
  [[nodiscard]] constexpr packet_type packet() noexcept {
    if (seen_) ++number_;  // 0: no position yet
    return {observer_.outgoing(), number_, position_};
  }
  [[nodiscard]] constexpr scalar energy() const noexcept { return observer_.value(); }  ///< E1 [J]
  [[nodiscard]] constexpr const Observer& observer() const noexcept { return observer_; }

 private:
  static constexpr std::size_t latency = static_cast<std::size_t>(Bound::traits.latency);

  // The guards and the bookkeeping of bad, late and lost ticks are local_model's.
  constexpr impedance_result<Space> tick(const vector& position, scalar dt, const vector& held,
                                         const vector& desired) noexcept {
    if (!sound_) return refuse(event::rejected_parameters, dt);
    const vector last = position_;
    const vector travel = seen_ ? vector(position - last) : Space::zero();
    if (!trusted(position, travel, held, dt) || !Space::is_finite(desired)) {
      return refuse(event::rejected_sample, dt);
    }
    event what = dt > limits_.longest_tick ? event::late_tick : event::nominal;
    if (newest_ == 0) what = worse(what, event::no_target);
    const bool known = seen_ && !(blind_ > scalar(0));
    const vector displacement = known ? travel : Space::zero();
    if (known) {
      if (!book(displacement, held, dt)) return refuse(event::rejected_sample, dt);
    } else {
      observer_.forfeit(held, limits_.longest_tick);
    }
    position_ = position;
    seen_ = true;
    blind_ = scalar(0);
    if (observer_.value() < scalar(0)) what = worse(what, event::debt);

    const scalar asked = Space::norm(desired);
    scalar in_flight(0);
    for (std::size_t j = 0; j < latency; ++j) {
      in_flight += observer_.damping.worst_outflow(held_[j], limits_.longest_tick);
    }
    in_flight *= scalar(1) + kernels::rounding<scalar>();
    using state_type = tick_state<Space, decltype(observer_.damping)>;
    const state_type state{.damping = observer_.damping,
                           .energy = observer_.value(),
                           .in_flight = in_flight,
                           .dt = dt,
                           .longest_tick = limits_.longest_tick,
                           .held = held,
                           .displacement = displacement,
                           .motion_known = known,
                           .normal = asked > scalar(0) ? vector(desired / asked) : Space::zero(),
                           .stiffness = scalar(0),
                           .depth = scalar(0),
                           .target_depth = scalar(0),
                           .local_force = scalar(0),
                           .target_changed = false};
    vector force = bound_.limit(desired, state);
    if (!Space::is_finite(force)) {
      force = Space::zero();
      what = worse(what, event::rejected_sample);
    }
    hold(force);
    return {force, observer_.value(), what, !(force == desired)};
  }

  /// A late tick may have let a watchdog drop the force part of the way: the worse of the two, and
  /// nothing that may not have come in is promised. The ledger may show a debt the port has not.
  /// False, and nothing is booked, if the energy is no number.
  constexpr bool book(const vector& displacement, const vector& held, scalar dt) noexcept {
    if (dt <= limits_.longest_tick) return observer_.update(displacement, held, dt);
    Observer dropped = observer_;
    dropped.forfeit(held, limits_.longest_tick);
    if (!observer_.update(displacement, held, dt)) return false;
    if (dropped.value() < observer_.value()) observer_ = dropped;
    return true;
  }
  [[nodiscard]] constexpr bool trusted(const vector& position, const vector& travel,
                                       const vector& held, scalar dt) const noexcept {
    if (!(dt > scalar(0)) || !kernels::is_finite(dt)) return false;
    if (!Space::is_finite(position) || !Space::is_finite(held)) return false;
    const scalar farthest = limits_.top_speed * (blind_ + dt);
    const scalar square = Space::dot(travel, travel);
    return kernels::is_finite(square) && square <= farthest * farthest;
  }
  constexpr void hold(const vector& force) noexcept {
    for (std::size_t j = latency; j > 0; --j) held_[j] = held_[j - 1];
    held_[0] = force;
  }
  constexpr impedance_result<Space> refuse(event why, scalar dt) noexcept {
    if (sound_) observer_.forfeit(held_.back(), limits_.longest_tick);
    blind_ += dt > scalar(0) && kernels::is_finite(dt) ? dt : limits_.longest_tick;
    hold(Space::zero());
    return {Space::zero(), observer_.value(), why, false};
  }

  [[no_unique_address]] Observer observer_;
  [[no_unique_address]] Bound bound_;
  loop_limits<Space> limits_;
  std::array<typename Space::coordinates, latency + 1> held_{};  ///< newest first; the last is held
  typename Space::coordinates position_{};                       ///< of the last good sample
  typename Space::coordinates desired_{};                        ///< the newest force received
  std::uint64_t newest_ = 0;                                     ///< its number, 0 before the first
  std::uint64_t number_ = 0;                                     ///< of the last packet made
  scalar blind_{};                                               ///< time without a good sample [s]
  bool seen_ = false;
  bool sound_ = true;
};

}  // namespace v0
}  // namespace passive_haptics
