// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// `event` says what happened in a tick; `guarantee` is the passivity that a type guarantees.

#include <passive_haptics/base/language.hpp>

#include <cstdint>

namespace passive_haptics {
inline namespace v0 {

/// What happened in a tick. A tick reports its worst event, ordered by worse(). The numbers rise with the severity,
/// except for three that were added later, and are stable from 1.0 on. Remedies: docs/events.md.
enum class event : std::uint8_t {
  nominal,            ///< nothing is wrong
  debt,               ///< the ledger is negative: the device gave the hand more energy than it took
  late_tick,          ///< dt is longer than loop_limits::longest_tick, on which the bound relies
  repeated_sample,    ///< the sensor is slower than the loop, so velocities are overestimated
  no_target,          ///< the environment has published no constraint yet: force zero
  rejected_target,    ///< the published constraint is unusable: the last good one stays
  stale_target,       ///< no good constraint came within stale_after: the contact fades out
  outside_workspace,  ///< farther from the origin than loop_limits::workspace: force zero
  rejected_sample,  ///< NaN, infinity, dt ≤ 0, an impossible jump: force zero, worst outflow booked
  rejected_parameters,  ///< check() names the parameter: force zero until set() mends it
  outside_force,        ///< the stated mass and hand force cannot cause this motion: strict bound
  untold_latency,       ///< the device holds forces later or sooner than stated: zero until reset()
  wrong_sign,           ///< the device holds the opposite of the command: force zero until reset()
  started_inside,       ///< in contact from the start, with no energy in the ledger: force zero
  forces_off,           ///< enable_forces(false): force zero, and the ledger books no motion
  wall_lost,  ///< a fault has emptied the ledger: the force is reduced until it is refilled (forgiving.hpp)
  wall_back,  ///< the first tick after wall_lost in which the ledger is refilled
};

/// The text of an event, for logs.
[[nodiscard]] constexpr const char* to_string(event e) noexcept {
  constexpr const char* names[] = {"nominal",         "debt",
                                   "late tick",       "repeated sample",
                                   "no target",       "rejected target",
                                   "stale target",    "outside workspace",
                                   "rejected sample", "rejected parameters",
                                   "outside force",   "untold latency",
                                   "wrong sign",      "started inside",
                                   "forces off",      "wall lost",
                                   "wall back"};
  static_assert(sizeof(names) / sizeof(*names) == static_cast<int>(event::wall_back) + 1);
  return e <= event::wall_back ? names[static_cast<int>(e)] : "unknown event";
}

/// The more severe of two events. wall_back and started_inside are no faults, so they are the least severe after
/// nominal; wall_lost stands just above debt, which it explains.
[[nodiscard]] constexpr event worse(event a, event b) noexcept {
  const auto severity = [](event e) {
    if (e == event::wall_back) return 1;
    if (e == event::started_inside) return 2;
    return e == event::wall_lost ? 5 : 4 * static_cast<int>(e);
  };
  return severity(a) < severity(b) ? b : a;
}

namespace detail {
/// worse() for events other than wall_lost and wall_back, which only the observer adds; it costs fewer instructions.
[[nodiscard]] constexpr event worse_yet(event a, event b) noexcept {
  const auto severity = [](event e) {
    return e == event::started_inside ? 1 : 2 * static_cast<int>(e);
  };
  return severity(a) < severity(b) ? b : a;
}
/// The event of a force that is NaN or infinite, which is rare.
[[nodiscard, gnu::cold]] constexpr event unusable(event so_far) noexcept {
  return worse_yet(so_far, event::rejected_target);
}
}  // namespace detail

/// How far a policy, or a composition, is passive at the device port.
///   strict       E1 ≥ 0 for every motion, every environment, every schedule of updates
///   conditional  the same under assumptions named where the policy is defined
///   none         no guarantee; the header shows the energy that it may create
enum class guarantee : std::uint8_t { none, conditional, strict };

[[nodiscard]] constexpr const char* to_string(guarantee g) noexcept {
  constexpr const char* names[] = {"none", "conditional", "strict"};
  return g <= guarantee::strict ? names[static_cast<int>(g)] : "unknown guarantee";
}

}  // namespace v0
}  // namespace passive_haptics
