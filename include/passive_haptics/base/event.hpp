// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What one tick has to tell its caller, and how much a type promises.

#include <passive_haptics/base/language.hpp>

#include <cstdint>

namespace passive_haptics {
inline namespace v0 {

/// What happened in a tick; a tick reports the worst, by worse(). The numbers rise with the severity, but for those that
/// came later, and are stable from 1.0 on. What each means and what to do: docs/events.md.
enum class event : std::uint8_t {
  nominal,            ///< all is well
  debt,               ///< the ledger is negative: the hand has been fed more than it paid
  late_tick,          ///< dt is longer than loop_limits::longest_tick, on which the bound relies
  repeated_sample,    ///< the sensor is slower than the loop: its motions seem faster than they are
  no_target,          ///< the environment has published nothing yet: force zero
  rejected_target,    ///< the published constraint is unusable: the last good one stays
  stale_target,       ///< no good constraint for too long: the contact is fading out
  outside_workspace,  ///< beyond loop_limits::workspace, as of millimetres for metres: force zero
  rejected_sample,  ///< NaN, infinity, dt ≤ 0, an impossible jump: force zero, its worst forfeited
  rejected_parameters,  ///< check() names the fault: force zero until set() mends it
  outside_force,   ///< it moves as what was stated of mass and hand cannot move it: strict bound
  untold_latency,  ///< it holds a force later, or sooner, than was stated: force zero until reset()
  wrong_sign,      ///< it does the opposite of what it is told: force zero until reset()
  started_inside,  ///< it should push, and nothing has been paid in yet: force zero
  forces_off,      ///< enable_forces(false): force zero, and the ledger waits
  wall_lost,  ///< a fault has taken what the ledger had: less than is asked for, until amends are made
  wall_back,  ///< amends are made: the first tick in which it is no longer lost
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

/// That a wall is back, and a start inside, are no faults, so the least of what is not nominal; a lost wall says more
/// than a debt.
[[nodiscard]] constexpr event worse(event a, event b) noexcept {
  const auto severity = [](event e) {
    if (e == event::wall_back) return 1;
    if (e == event::started_inside) return 2;
    return e == event::wall_lost ? 5 : 4 * static_cast<int>(e);
  };
  return severity(a) < severity(b) ? b : a;
}

namespace detail {
/// The same within a tick, before its observer says of a wall that it is lost or back; as cheap as can be.
[[nodiscard]] constexpr event worse_yet(event a, event b) noexcept {
  const auto severity = [](event e) {
    return e == event::started_inside ? 1 : 2 * static_cast<int>(e);
  };
  return severity(a) < severity(b) ? b : a;
}
/// The event of a force that is NaN or infinite. It is a cold function, so that this rare case costs the
/// ordinary tick no instructions.
[[nodiscard, gnu::cold, gnu::noinline]] constexpr event unusable(event so_far) noexcept {
  return worse_yet(so_far, event::rejected_target);
}
}  // namespace detail

/// How far a policy, or a composition, is passive at the device port.
///   strict       E1 ≥ 0 for every motion, every environment, every schedule of updates
///   conditional  the same under assumptions named where the policy is defined
///   none         no promise; the header shows the loss
enum class guarantee : std::uint8_t { none, conditional, strict };

[[nodiscard]] constexpr const char* to_string(guarantee g) noexcept {
  constexpr const char* names[] = {"none", "conditional", "strict"};
  return g <= guarantee::strict ? names[static_cast<int>(g)] : "unknown guarantee";
}

}  // namespace v0
}  // namespace passive_haptics
