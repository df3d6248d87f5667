// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The loop around a port: what it has to keep to.
//
//   loop_limits               a command is held from the moment it is given
//   late_loop_limits<k>       it is held k ticks later, as every device that talks in packets does
//   watched_loop_limits<k>    the same, and a sensor that is slower than the loop is reported
//   learning_loop_limits<k>   the longest tick is the longest so far, tenfold at most at once: conditional
//   trusted_loop_limits<k>    somebody else answers for every sample: conditional, half the code
//
// The delay is a property of the loop, so it is stated once, here. Every force bound honours it, or is
// refused for it. measure_latency.hpp and measure_ticks.hpp find the numbers of a loop.

#include <passive_haptics/port/guard.hpp>

#include <limits>

namespace passive_haptics {
inline namespace v0 {

/// What a loop has besides its numbers, known to the compiler.
struct loop_traits {
  bool watched = false;  ///< event::repeated_sample tells of a sensor that is slower than the loop
  bool learns = false;   ///< the longest tick is the longest so far, tenfold at most at once
};

/// A guarantee holds while the loop keeps to these; a tick that does not is reported. What a late tick
/// cost is known, since its force was held to its end: the ledger books it, and shows a debt at worst.
/// It is known no longer where a driver drops a force by itself: state the `watchdog` then.
///
/// `Latency` counts whole ticks from a command to the first instant it is held, no more and no fewer, because the
/// ledger pairs each motion with the force that was there (§ 3). A sample that is one tick old when it arrives counts
/// as one, too. Told wrong, either way, joules are drawn: measure_latency.hpp finds the number.
template <int Latency, loop_traits Traits = loop_traits{}>
struct late_loop_limits {
  static_assert(Latency >= 0,
                "passive_haptics: late_loop_limits: Latency counts ticks and cannot be negative");
  static constexpr int latency = Latency;
  static constexpr loop_traits traits = Traits;
  /// A tick longer than all before it comes with a force that was bounded for a shorter one.
  static constexpr guarantee passivity = Traits.learns ? guarantee::conditional : guarantee::strict;
  template <class Port>
  using guard_type = guard<Port, Latency>;  ///< what looks at the samples
  static constexpr double never = std::numeric_limits<double>::infinity();

  double longest_tick{};    ///< T [s], > 0: the worst tick of YOUR loop
  double top_speed = 5.0;   ///< faster than this is a sensor fault [m/s]; joints: [rad/s]
  double workspace = 2.0;   ///< farther from the origin is no position [m]; joints: not asked
  double watchdog = never;  ///< the driver drops a force that long after its command [s]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!detail::positive(longest_tick)) {
      return {"longest_tick", longest_tick, "finite and > 0 s: the worst tick of your loop"};
    }
    if (!detail::positive(top_speed)) return {"top_speed", top_speed, "finite and > 0 m/s"};
    if (!(workspace > 0.0)) return {"workspace", workspace, "> 0 m"};
    if (!(watchdog >= longest_tick)) return {"watchdog", watchdog, "≥ longest_tick, in s"};
    return {};
  }

  template <class Port>
  struct on {
    using scalar = typename Port::scalar;
    scalar longest_tick;
    scalar top_speed;
    scalar workspace;
    scalar watchdog;

    constexpr explicit on(const late_loop_limits& p) noexcept
        : longest_tick(detail::number<scalar>(p.longest_tick)),
          top_speed(detail::number<scalar>(p.top_speed)),
          workspace(detail::number<scalar>(p.workspace)),
          watchdog(detail::number<scalar>(p.watchdog)) {}
    [[nodiscard]] constexpr late_loop_limits parameters() const noexcept {
      return {.longest_tick = static_cast<double>(longest_tick),
              .top_speed = static_cast<double>(top_speed),
              .workspace = static_cast<double>(workspace),
              .watchdog = static_cast<double>(watchdog)};
    }
    /// How long a force may have been held in a tick that took `dt` [s].
    [[nodiscard]] constexpr scalar held_for(scalar dt) const noexcept {
      return kernels::clamped(dt, longest_tick, watchdog);
    }
  };
};

/// A loop whose samples somebody else has looked at, whose ticks a timer makes and whose end a watchdog
/// sees: the ledger, the bound and their rounding are all that is left to a tick. No sample is doubted, so a
/// jump of the sensor is booked as the work of a hand, and a tick that is lost or late goes unnoticed: the
/// guarantee is conditional on samples that are good, one a tick. What is no number is refused still, since
/// no ledger takes it, but what the force before it has done is not written off.
template <int Latency = 0>
struct trusted_loop_limits {
  static constexpr int latency = late_loop_limits<Latency>::latency;
  static constexpr loop_traits traits{};
  static constexpr guarantee passivity = guarantee::conditional;
  template <class Port>
  using guard_type = trusting_guard<Port, Latency>;

  double longest_tick{};  ///< T [s], > 0: the worst tick of YOUR loop

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    return late_loop_limits<Latency>{.longest_tick = longest_tick}.check();
  }

  template <class Port>
  struct on {
    using scalar = typename Port::scalar;
    scalar longest_tick;

    constexpr explicit on(const trusted_loop_limits& p) noexcept
        : longest_tick(detail::number<scalar>(p.longest_tick)) {}
    [[nodiscard]] constexpr trusted_loop_limits parameters() const noexcept {
      return {.longest_tick = static_cast<double>(longest_tick)};
    }
  };
};

using loop_limits = late_loop_limits<0>;
template <int Latency = 0>
using watched_loop_limits = late_loop_limits<Latency, loop_traits{.watched = true}>;
template <int Latency = 0>
using learning_loop_limits = late_loop_limits<Latency, loop_traits{.learns = true}>;

}  // namespace v0
}  // namespace passive_haptics
