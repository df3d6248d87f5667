// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a force bound may look at, and what it answers.
//
//   port_state   the port and its ledger: no normal, no depth, no stiffness
//   tick_fate    whether the last tick was on time, late or lost; judged here and nowhere else
//   share        how much of the desired effort is left, from a bound that only reduces
//
// Whatever looks at the contact is a shaper and stands on the contact's side (contact/shaped.hpp).

#include <passive_haptics/base/ledger.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>

namespace passive_haptics {
inline namespace v0 {

/// A factor in [0, 1], where NaN counts as 0: the desired effort keeps its direction. A bound that adds
/// force, or turns it, answers with another effort instead.
template <class Scalar>
struct share {
  Scalar factor;
};
template <class Scalar>
share(Scalar) -> share<Scalar>;

/// What became of the last tick. The port judges it, once; whoever has to know reads it in port_state.
enum class tick_fate : std::uint8_t {
  on_time,  ///< no longer than the longest tick, and its motion is known
  late,     ///< longer than that: the force that was held in it was bounded for less
  lost      ///< the sample before it was none, or a bad one: its motion is unknown
};
/// The rule for late ticks: of a tick of dt [s], where T [s] was the longest that was allowed for.
template <class Scalar>
[[nodiscard]] constexpr bool is_late(Scalar dt, Scalar T) noexcept {
  return dt > T;
}

namespace detail {
/// A damping that says how much less than its ends show a turn may have brought.
template <class D, class P>
concept knows_turns = requires(const D d, const typename P::motion m, const typename P::effort f,
                               typename P::scalar s) {
  { d.unsure(m, f, s) } -> std::same_as<typename P::scalar>;
  requires noexcept(d.unsure(m, f, s));
};
}  // namespace detail

/// The port in one tick. Motions [m], efforts [N], energies [J], times [s]; of joints [rad], [N·m].
template <class Port, class Damping, int Latency = 0, bool Exact = true>
struct port_state {
  using port_type = Port;
  using damping_type = Damping;
  using scalar = typename Port::scalar;
  using effort = typename Port::effort;
  using motion = typename Port::motion;
  static constexpr int latency = Latency;  ///< ticks from a command to its holding
  static constexpr bool exact = Exact;     ///< the true Δx is the one shown
  /// Commanded and not yet held, newest first; after them comes the one that was held.
  using commands = std::array<typename Port::stored_effort, static_cast<std::size_t>(Latency) + 1>;

  const Damping& damping;  ///< of the device, as the observer knows it
  const commands& commanded;
  scalar energy;                             ///< E1(n), this tick's motion included
  scalar dt;                                 ///< length of the last tick
  scalar longest_tick;                       ///< T, bound on the length of the next
  const typename Port::stored_effort& held;  ///< over the last tick
  motion travel;                             ///< Δx over the last tick, as shown
  scalar travel_error;                       ///< the true Δx is no farther from it than this
  bool motion_known;  ///< false: the last sample was lost, Δx is unknown and given as zero
  bool late;          ///< dt is longer than was allowed for

  /// The command that is held in the j-th coming tick, 1 ≤ j ≤ Latency.
  [[nodiscard]] constexpr const typename Port::stored_effort& coming(int j) const noexcept {
    return commanded[static_cast<std::size_t>(Latency - j)];
  }
  [[nodiscard]] constexpr tick_fate fate() const noexcept {
    if (!motion_known) return tick_fate::lost;
    return late ? tick_fate::late : tick_fate::on_time;
  }

  /// ¼ Σ fᵀB⁻¹f over the commands that are still on their way to the motors [J], rounded up (§ 3), with
  /// what elastic friction may hold back meanwhile.
  [[nodiscard]] constexpr scalar in_flight() const noexcept {
    scalar promised = held_back();
    for (std::size_t j = 0; j < static_cast<std::size_t>(Latency); ++j) {
      promised += damping.worst_outflow(commanded[j], longest_tick);
    }
    return promised * (scalar(1) + kernels::rounding<scalar>());
  }
  /// What friction that is counted on may hold back while those commands are held, 2 c p in each tick [J]
  /// (§ 6).
  [[nodiscard]] constexpr scalar held_back() const noexcept {
    if constexpr (Latency > 0 && Damping::rubs) return scalar(4 * Latency) * damping.most_stored();
    return scalar(0);
  }
  /// The credit that a new effort may spend [J]: E1 less what is on its way already.
  [[nodiscard]] constexpr scalar credit() const noexcept {
    if constexpr (Latency == 0) return energy;
    return energy - in_flight();
  }
  /// What the last tick brought, Δxᵀ(b/dt)Δx − f_held·Δx [J], rounded down, at least.
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
