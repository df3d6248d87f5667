// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The stiffness that a contact displays, what limits it, and what would raise it:
//
//     const ph::explanation e = touch.explain();           // not in every tick: it computes anew
//     std::printf("%.0f of %.0f N/m: %s\n", e.shown, e.asked, e.because());
//     std::printf("steps by up to %.3f N at rest\n", e.floor);        // K q: no law of the depth steps by less
//
// `shown` is the least of K_s of the law (sampled_spring.hpp), the stiffness budget (design/stiffness_budget.hpp)
// and 2b/((k + 1) T) of strict_bound, as far as the composition has them.

#include <passive_haptics/base/language.hpp>

#include <cstdint>
#include <limits>

namespace passive_haptics {
inline namespace v0 {

/// The reason why a stiffness, or a force, is below the desired one.
enum class softened_by : std::uint8_t {
  nothing,
  parameters,        ///< a parameter is out of its range: force zero
  refuted,           ///< the motion has refuted a stated parameter: force zero until reset()
  no_surface,        ///< no surface was told by update() or touch(), or release() ended it
  mass_and_tick,     ///< κ m/T², the largest stiffness at which a sampled mass settles (§ 9)
  damping_and_tick,  ///< 2b/((k + 1) T), strict, from an empty ledger (L4); a torque: 4b_ω/T
  encoder_steps,     ///< the stiffness whose encoder steps dry friction and damping pay for
  coupling,          ///< the law's own spring stands in series with the surface
  news,     ///< the surface moved, or appeared around the device: force follows at a limited rate
  silence,  ///< no update within stale_after, or release(): the contact fades
  motors,   ///< the force has reached the motors' limit
  ledger,   ///< the energy E1 covers no larger force, or no further way of a surface that has moved
  started_inside,  ///< in contact from the start, with no energy in the ledger
  forces_off,      ///< enable_forces(false) was called
  sample,          ///< the last sample was refused or missing, as the event says: force zero
};

[[nodiscard]] constexpr const char* to_string(softened_by why) noexcept {
  constexpr const char* names[] = {
      "nothing",          "parameters",    "refuted",        "no surface", "mass and tick",
      "damping and tick", "encoder steps", "coupling",       "news",       "silence",
      "motors",           "ledger",        "started inside", "forces off", "sample"};
  return why <= softened_by::sample ? names[static_cast<int>(why)] : "unknown reason";
}

struct explanation {
  double asked{};  ///< K of the world's surface [N/m]; ∞ for a given force, whose K is unknown
  double shown{};  ///< the stiffness displayed at rest, below the motors' limit [N/m]
  double floor{};  ///< of an encoder step q at rest [N]: K q, or f² q/E1 ≤ f where E1 limits f
  softened_by stiffness = softened_by::nothing;  ///< why `shown` is less than `asked`
  double depth{};  ///< penetration into the world's surface at the last sample [m]; 0 outside
  double force{};  ///< the last commanded force [N]
  softened_by now = softened_by::nothing;  ///< why `force` is less than `shown` times `depth`
  double torque{};             ///< of a handle that turns, the last commanded torque [N·m]; else 0
  const char* crossings = "";  ///< of known_crossings, whether they pay here, and why; else empty

  /// Lowers `shown` to `most` [N/m] if it is larger by more than a float may round, and notes the reason.
  constexpr void soften(double most, softened_by why) noexcept {
    if (!(most < shown * (1.0 - 1e-6))) return;
    shown = most;
    stiffness = why;
  }
  /// Notes the motors as the reason if `force`, set before, has reached 95 % of their limit `most` [N].
  constexpr void saturate(double most) noexcept {
    const bool asks = shown * depth > most || !(asked < std::numeric_limits<double>::infinity());
    if (asks && force > 0.95 * most) now = softened_by::motors;
  }
  /// The same of a tool, by its force or its torque, of which the point that is explained may give a part; `most` and
  /// `most_torque` are the limits [N], [N·m].
  constexpr void saturate(double most, double most_torque) noexcept {
    if (force > 0.95 * most || torque > 0.95 * most_torque) now = softened_by::motors;
  }
  /// One sentence on what limits the force now, or else the stiffness, and what would raise it.
  [[nodiscard]] constexpr const char* because() const noexcept {
    constexpr const char* sentences[] = {
        "The surface is shown as it is.",
        "A parameter is out of its range, so the force is zero: check() names it.",
        "The motion has refuted what was stated, as the event says: mend that, and reset().",
        "There is no surface: tell one by update(), or a mesh by source().touch().",
        "A mass that is sampled every T can be held with so much and no more, and it grows with "
        "m/T^2: a faster loop, behind a guard a faster renderer, a longest tick that is no longer "
        "than it has to be, a heavier grip, or behind a cable in a late loop a slow fastest_mode "
        "that is stated raises it.",
        "So much is sure of this damping and tick, of a force under a strict bound from an empty "
        "ledger, and of any torque: more damping or a shorter longest tick raises it, and of a "
        "force reachable_bound, where mass and hand are known.",
        "Dry friction and damping pay for no more on these steps: finer encoders, more sure "
        "friction or less presliding raise it; stiffness_budget(device).because() says which.",
        "The coupling's own spring stands in series with the surface: a stiffer one shows more.",
        "The surface has moved, or appeared round the device: its force follows at a limited rate, "
        "and is there within a second.",
        "The world has said nothing for longer than its freshness allows, or has released the "
        "surface, so the contact fades.",
        "The motors hold no more than their limit.",
        "The energy that the hand has paid in covers no more; it comes back as the hand presses or "
        "moves. If this lasts, mass, damping, hand force or encoder steps are not what was stated, "
        "or the longest tick is too long.",
        "It was inside when the surface came, and nothing has been paid in to push it out: move "
        "it, start outside, or state a loan.",
        "The forces are off: enable_forces(true) switches them on.",
        "The last sample was refused or missing, as the event says: positions are in metres, "
        "within the workspace, and no faster than top_speed."};
    static_assert(sizeof sentences / sizeof *sentences == int(softened_by::sample) + 1);
    const softened_by why = now != softened_by::nothing ? now : stiffness;
    return why <= softened_by::sample ? sentences[static_cast<int>(why)] : "";
  }
};

}  // namespace v0
}  // namespace passive_haptics
