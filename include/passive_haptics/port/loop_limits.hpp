// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The loop around a port: what it has to keep to.
//
//   loop_limits               a command is held from the moment it is given
//   late_loop_limits<k>       it is held k ticks later, as every device that talks in packets does
//   watched_loop_limits<k>    the same, and a sensor that is slower than the loop is reported
//
// The delay is a property of the loop, so it is stated once, here. Every force bound honours it, or is
// refused for it.

#include <passive_haptics/parameter.hpp>

namespace passive_haptics {
inline namespace v0 {

/// A guarantee holds while the loop keeps to these; a tick that does not is reported.
///
/// `Latency` counts whole ticks from a command to the first instant it is held, no more and no fewer:
/// the ledger pairs each motion with the force that was there (§ 3). Told wrong, either way, it pairs
/// wrongly, and a bound that is not what it says draws joules: measure_latency.hpp finds the number.
template <int Latency, bool Watched = false>
struct late_loop_limits {
  static_assert(Latency >= 0,
                "passive_haptics: late_loop_limits: Latency counts ticks and cannot be negative");
  static constexpr int latency = Latency;
  static constexpr bool watched = Watched;  ///< event::repeated_sample

  double longest_tick{};   ///< T [s], > 0: the worst tick of YOUR loop
  double top_speed = 5.0;  ///< faster than this is a sensor fault [m/s]; joints: [rad/s]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!detail::positive(longest_tick)) {
      return {"longest_tick", longest_tick, "finite and > 0 s: the worst tick of your loop"};
    }
    if (!detail::positive(top_speed)) return {"top_speed", top_speed, "finite and > 0 m/s"};
    return {};
  }

  template <class Port>
  struct on {
    using scalar = typename Port::scalar;
    scalar longest_tick;
    scalar top_speed;

    constexpr explicit on(const late_loop_limits& p) noexcept
        : longest_tick(detail::number<scalar>(p.longest_tick)),
          top_speed(detail::number<scalar>(p.top_speed)) {}
    [[nodiscard]] constexpr late_loop_limits parameters() const noexcept {
      return {.longest_tick = static_cast<double>(longest_tick),
              .top_speed = static_cast<double>(top_speed)};
    }
  };
};

using loop_limits = late_loop_limits<0>;
template <int Latency = 0>
using watched_loop_limits = late_loop_limits<Latency, true>;

}  // namespace v0
}  // namespace passive_haptics
