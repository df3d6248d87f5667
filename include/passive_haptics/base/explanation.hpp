// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How stiff a surface is shown, why it is no stiffer, and what would raise it:
//
//     const ph::explanation e = touch.explain();           // not in every tick: it looks anew
//     std::printf("%.0f of %.0f N/m: %s\n", e.shown, e.asked, e.because());
//     std::printf("steps by up to %.3f N at rest\n", e.floor);        // no law of a depth is quieter
//
// Shown is K_s of the law (sampled_spring.hpp), the budget (design/stiffness_budget.hpp), or 2b/T (strict_bound).

#include <passive_haptics/base/language.hpp>

#include <cstdint>
#include <limits>

namespace passive_haptics {
inline namespace v0 {

/// What keeps a stiffness, or a force, below what was asked for.
enum class softened_by : std::uint8_t {
  nothing,
  parameters,        ///< one of them is out of its range: force zero
  refuted,           ///< the motion has refuted what was stated: force zero until reset()
  no_surface,        ///< nothing has been told, or it is released
  mass_and_tick,     ///< κ m/T², what a sampled mass can be held with
  damping_and_tick,  ///< 2b/((k + 1) T), what a strict bound shows while the ledger is empty
  encoder_steps,     ///< what dry friction and damping pay for on steps of that size
  coupling,          ///< the law's own spring stands in series
  news,     ///< the surface has moved, or appeared inside: it is made up for at a limited rate
  silence,  ///< the world has said nothing for too long, or released it: it fades
  motors,   ///< they hold no more
  ledger,   ///< E1 covers no more
  started_inside,  ///< nothing has been paid in yet
  forces_off,      ///< enable_forces(false)
};

[[nodiscard]] constexpr const char* to_string(softened_by why) noexcept {
  constexpr const char* names[] = {
      "nothing",          "parameters",    "refuted",        "no surface", "mass and tick",
      "damping and tick", "encoder steps", "coupling",       "news",       "silence",
      "motors",           "ledger",        "started inside", "forces off"};
  return why <= softened_by::forces_off ? names[static_cast<int>(why)] : "unknown reason";
}

struct explanation {
  double asked{};  ///< K of the world's surface [N/m]; ∞ of a force of your own: nobody knows it
  double shown{};  ///< what is felt of it, at rest, as long as the motors hold it [N/m]
  double floor{};  ///< K q [N]: the force at rest may step by it on encoders; 0 of exact positions
  softened_by stiffness = softened_by::nothing;  ///< why `shown` is less than `asked`
  double
      depth{};  ///< of the device in the world's surface, as the port takes it to be [m]; 0 outside
  double force{};                          ///< commanded last [N]
  softened_by now = softened_by::nothing;  ///< why `force` is less than `shown` times `depth`

  /// The stiffness is no more than `most` [N/m], and why.
  constexpr void soften(double most, softened_by why) noexcept {
    if (!(most < shown)) return;
    shown = most;
    stiffness = why;
  }
  /// The motors hold no more than `most` [N]; `force` is known.
  constexpr void saturate(double most) noexcept {
    const bool asks = shown * depth > most || !(asked < std::numeric_limits<double>::infinity());
    if (asks && force > 0.95 * most) now = softened_by::motors;
  }
  /// A sentence: what binds now, else what binds the stiffness, and what would raise it.
  [[nodiscard]] constexpr const char* because() const noexcept {
    switch (now != softened_by::nothing ? now : stiffness) {
      case softened_by::nothing:
        return "The surface is shown as it is.";
      case softened_by::parameters:
        return "A parameter is out of its range, so the force is zero: check() names it.";
      case softened_by::refuted:
        return "The motion has refuted what was stated, as the event says: mend that, and reset().";
      case softened_by::no_surface:
        return "There is no surface: update() tells one.";
      case softened_by::mass_and_tick:
        return "A mass that is sampled every T can be held with so much and no more, and it grows "
               "with m/T^2: a faster loop, a longest tick that is no longer than it has to be, or "
               "a heavier grip raises it.";
      case softened_by::damping_and_tick:
        return "So much is sure under a strict bound, from an empty ledger: more damping or a "
               "shorter longest tick raises it, and reachable_bound, where mass and hand are "
               "known.";
      case softened_by::encoder_steps:
        return "Dry friction and damping pay for no more on these steps: finer encoders, more sure "
               "friction or less presliding raise it; stiffness_budget(device).because() says "
               "which.";
      case softened_by::coupling:
        return "The coupling's own spring stands in series with the surface: a stiffer one shows "
               "more.";
      case softened_by::news:
        return "The surface has moved, or appeared round the device: its force follows at a "
               "limited rate, and is there within a second.";
      case softened_by::silence:
        return "The world has said nothing for longer than its freshness allows, or has released "
               "the surface, so the contact fades.";
      case softened_by::motors:
        return "The motors hold no more than their limit.";
      case softened_by::ledger:
        return "The energy that the hand has paid in covers no more; it comes back as the hand "
               "presses or moves. If this lasts, mass, damping or hand force are not what was "
               "stated, or the longest tick is too long.";
      case softened_by::started_inside:
        return "It was inside when the surface came, and nothing has been paid in to push it out: "
               "move it, start outside, or state a loan.";
      case softened_by::forces_off:
        return "The forces are off: enable_forces(true) switches them on.";
    }
    return "";
  }
};

}  // namespace v0
}  // namespace passive_haptics
