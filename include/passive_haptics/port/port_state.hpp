// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The input and the output of a force bound.
//
//   port_state   the state of the port and its ledger, without normal, depth and stiffness of a contact
//   tick_fate    whether the last tick was on time, late or lost; decided here only
//   share        the factor of the desired effort, returned by a bound that only reduces
//
// A part that reads the contact is a shaper, and acts before the bound (contact/shaped.hpp).

#include <passive_haptics/base/ledger.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>

namespace passive_haptics {
inline namespace v0 {

/// A factor in [0, 1] of the desired effort, whose direction is kept; NaN counts as 0. A bound that adds force, or
/// turns it, returns an effort instead.
template <class Scalar>
struct share {
  Scalar factor;
};
template <class Scalar>
share(Scalar) -> share<Scalar>;

/// The fate of the last tick. The port decides it once, and other parts read it in port_state.
enum class tick_fate : std::uint8_t {
  on_time,  ///< no longer than the longest tick, and its motion is known
  late,     ///< longer than T, so that its force was bounded for a shorter one
  lost      ///< the sample before it was missing or rejected, so its motion is unknown
};
/// The rule for late ticks: a tick of dt [s] is late if dt > T, the longest tick [s] that the bound assumed.
template <class Scalar>
[[nodiscard]] constexpr bool is_late(Scalar dt, Scalar T) noexcept {
  return dt > T;
}

/// The ticks since a force was last not cut: a bound that followed the length of each would tremble. (L6)
template <class Scalar, bool Exact = true>
struct recent_ticks {
  Scalar longest{};  ///< [s], T at most
  constexpr void see(Scalar dt, Scalar T) noexcept {
    longest = kernels::larger(longest, kernels::smaller(dt, T));
  }
};
/// The same, for an error of the travel, which counts for most in a short tick.
template <class Scalar>
struct recent_ticks<Scalar, false> : recent_ticks<Scalar> {
  Scalar shortest = kernels::largest<Scalar>();  ///< [s], T/4 at least
  constexpr void see(Scalar dt, Scalar T) noexcept {
    recent_ticks<Scalar>::see(dt, T);
    shortest = kernels::smaller(shortest, kernels::larger(dt, T / Scalar(4)));
  }
};

namespace detail {
/// Satisfied by a damping that bounds the error of the work of a turn.
template <class D, class P>
concept knows_turns = requires(const D d, const typename P::motion m, const typename P::effort f,
                               typename P::scalar s) {
  { d.unsure(m, f, s) } -> std::same_as<typename P::scalar>;
  requires noexcept(d.unsure(m, f, s));
};
}  // namespace detail

/// The state of a port in one tick, in m, N, J and s; for joints rad and N·m.
template <class Port, class Damping, int Latency = 0, bool Exact = true, bool Spends = true>
struct port_state {
  using port_type = Port;
  using damping_type = Damping;
  using scalar = typename Port::scalar;
  using effort = typename Port::effort;
  using motion = typename Port::motion;
  static constexpr int latency = Latency;  ///< ticks from a command until it is held
  static constexpr bool exact = Exact;     ///< the measured Δx is exact
  /// The commands that are not yet held, newest first, and after them the one that was held.
  using commands = std::array<typename Port::stored_effort, static_cast<std::size_t>(Latency) + 1>;

  const Damping& damping;  ///< damping of the device, as stated to the observer
  const commands& commanded;
  scalar energy;                             ///< E1(n), with the last tick booked
  scalar dt;                                 ///< length of the last tick
  scalar longest_tick;                       ///< T, upper bound of the next tick
  recent_ticks<scalar, Exact> recent{};      ///< kept by ports whose bound reckons with them
  const typename Port::stored_effort& held;  ///< effort held over the last tick
  motion travel;                             ///< measured Δx over the last tick
  scalar travel_error;                       ///< largest distance of the true Δx from it
  bool motion_known = true;  ///< false if the last sample was lost; Δx is then given as zero
  bool late = false;         ///< dt was longer than T

  /// The command that is held in the j-th coming tick, 1 ≤ j ≤ Latency.
  [[nodiscard]] constexpr const typename Port::stored_effort& coming(int j) const noexcept {
    return commanded[static_cast<std::size_t>(Latency - j)];
  }
  /// The shortest of the last tick and the recent ones [s]; with an exact Δx, the last one.
  [[nodiscard]] constexpr scalar shortest_tick() const noexcept {
    if constexpr (!Exact) return kernels::smaller(dt, recent.shortest);
    return dt;
  }
  [[nodiscard]] constexpr tick_fate fate() const noexcept {
    if (!motion_known) return tick_fate::lost;
    return late ? tick_fate::late : tick_fate::on_time;
  }

  /// ¼ Σ fᵀB⁻¹f over the commands not yet held [J], rounded up (§ 3), and what elastic friction may store meanwhile.
  [[nodiscard]] constexpr scalar in_flight() const noexcept {
    scalar promised = held_back();
    for (std::size_t j = 0; j < static_cast<std::size_t>(Latency); ++j) {
      promised += damping.worst_outflow(commanded[j], longest_tick);
    }
    return promised * (scalar(1) + kernels::rounding<scalar>());
  }
  /// The energy that elastic friction may store while those commands are held, 2 c p in each tick [J] (§ 6).
  [[nodiscard]] constexpr scalar held_back() const noexcept {
    if constexpr (Latency > 0 && Damping::rubs) return scalar(4 * Latency) * damping.most_stored();
    return scalar(0);
  }
  /// The credit that a new effort may spend [J]: E1 less what is on its way already.
  [[nodiscard]] constexpr scalar credit() const noexcept {
    if constexpr (Latency == 0) return energy;
    return energy - in_flight();
  }
  /// The same, and as much left for each of the k efforts after it: at rest all are then cut alike (§ 3).
  [[nodiscard]] constexpr scalar fair_credit() const noexcept {
    if constexpr (Latency == 0) return energy;
    return kernels::smaller(credit(), (energy - held_back()) / scalar(Latency + 1));
  }
  /// How far a surface may move outwards in a tick, against a force of that size [N], in m. Of the way E1/f that the
  /// ledger still pays for, all but `kept` and two ticks of the device's way is used up with a time constant `time` [s]: so
  /// the surface stops before a bound has to cut the force at once.
  [[nodiscard]] constexpr scalar paid_way(scalar force, scalar kept, scalar time) const noexcept {
    if (!Spends || !(force > scalar(0))) return kernels::largest<scalar>();
    kept += scalar(2) * kernels::square_root(Port::squared(travel));
    return kernels::larger(energy / force - kept, scalar(0)) * dt / time;
  }
  /// The same where the hand took `spent` [J] in the last tick: less than an eighth of what is paid does not limit it,
  /// as long as a way of `kept` more is paid for. Nearer to the end a device slower than `calm` [m/s] does not go on at once.
  [[nodiscard]] constexpr scalar paid_way(scalar force, scalar kept, scalar time, scalar spent,
                                          scalar calm = kernels::largest<scalar>()) const noexcept {
    const scalar paid = paid_way(force, kept, time), any = kernels::largest<scalar>();
    const bool nears =
        paid * time < kept * dt && !(kernels::square_root(Port::squared(travel)) / dt > calm);
    return paid < any && (nears || scalar(8) * spent > paid * force) ? paid : any;
  }
  /// Δxᵀ(b/dt)Δx − f_held·Δx [J], the least energy gained in the last tick, rounded down.
  [[nodiscard]] constexpr scalar gain() const noexcept {
    scalar brought = detail::sure_gain<Port>(damping.dissipated(travel, dt), held, travel);
    if constexpr (detail::knows_turns<Damping, Port>) {
      brought -= damping.unsure(travel, held, dt);
    }
    return brought;
  }
};

}  // namespace v0
}  // namespace passive_haptics
