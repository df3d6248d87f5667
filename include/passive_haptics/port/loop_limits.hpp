// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The limits of the loop around a port, on which the guarantee rests.
//
//   loop_limits               a force is held from its command on
//   late_loop_limits<k>       it is held k ticks later, as with every device that communicates in packets
//   watched_loop_limits<k>    the same; a sensor that is slower than the loop is reported
//   learning_loop_limits<k>   T is the longest tick but one of late, growing tenfold at most in one tick: conditional
//   trusted_loop_limits<k>    samples are not checked, because the caller has: conditional, half the code
//
// The latency is a property of the loop, so it is stated once, here. A force bound either covers it or does not
// compile with it. identification/measure_latency.hpp and measure_ticks.hpp measure the numbers of a loop.

#include <passive_haptics/base/no_unique_address.hpp>
#include <passive_haptics/port/guard.hpp>

#include <limits>

namespace passive_haptics {
inline namespace v0 {

/// Properties of a loop that are known at compile time.
struct loop_traits {
  bool watched = false;  ///< event::repeated_sample reports a sensor that is slower than the loop
  bool learns = false;   ///< T is the longest tick but one of late (detail::lessons)
};

namespace detail {
/// What a loop that learns has been taught. One tick alone that is longer than T is late, and may be a debugger: nothing
/// is learned from it. Of two within 10 s T becomes the shorter one. It is what was stated again once no tick has been
/// longer than T/2 for 10 s.
template <class Scalar>
class lessons {
 public:
  constexpr explicit lessons(Scalar stated) noexcept : stated_(stated) {}
  /// T after a tick of dt [s], where it was T before.
  [[nodiscard]] constexpr Scalar after(Scalar dt, Scalar T) noexcept {
    since_ += dt;
    idle_ = dt > T / Scalar(2) ? Scalar(0) : idle_ + dt;
    if (idle_ > memory) return stated_;
    if (!(dt > T && dt <= Scalar(10) * T)) return T;  // above that it was no tick of a loop
    const Scalar before = since_ > memory ? Scalar(0) : last_;
    last_ = dt;
    since_ = Scalar(0);
    return kernels::larger(T, kernels::smaller(before, dt));
  }

 private:
  static constexpr Scalar memory = Scalar(10);  // [s]
  Scalar stated_;                               ///< [s]
  Scalar last_{}, since_{};  ///< the last tick that was longer than T, and the time since [s]
  Scalar idle_{};            ///< the time since the last one longer than T/2 [s]
};
}  // namespace detail

/// A guarantee holds while the loop keeps these limits; a tick that does not is reported. The cost of a late tick is
/// known, because its force was held to its end: the ledger books it, which leaves a debt at worst. If the driver may
/// drop the force by itself, the cost is not known, and `watchdog` has to be stated.
///
/// `Latency` is the exact number of whole ticks from a command to the first instant at which it is held, because the
/// ledger pairs each motion with the force held during it (§ 3). A sample that is one tick old on arrival adds one. With
/// a number that is too small or too large a hand can draw energy; measure_latency.hpp measures it.
template <int Latency, loop_traits Traits = loop_traits{}>
struct late_loop_limits {
  static_assert(Latency >= 0,
                "passive_haptics: late_loop_limits: Latency counts ticks and cannot be negative");
  static constexpr int latency = Latency;
  static constexpr loop_traits traits = Traits;
  /// A loop that learns is conditional, because the force of a new longest tick was bounded for a shorter T.
  static constexpr guarantee passivity = Traits.learns ? guarantee::conditional : guarantee::strict;
  template <class Port>
  using guard_type = guard<Port, Latency>;  ///< checks the samples
  static constexpr double never = std::numeric_limits<double>::infinity();

  double longest_tick{};    ///< T [s], > 0: the worst tick of YOUR loop
  double top_speed = 5.0;   ///< a faster sample is rejected [m/s]; joints: [rad/s]
  double workspace = 2.0;   ///< largest distance from the origin [m]; not for joints
  double watchdog = never;  ///< time after a command when the driver drops the force [s]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!detail::positive(longest_tick)) {
      return {"longest_tick", longest_tick,
              "finite and > 0 s: your loop's worst; NaN: .latency is not that of late_loop_limits"};
    }
    if (!detail::positive(top_speed)) return {"top_speed", top_speed, "finite and > 0 m/s"};
    if (!(workspace > 0.0)) return {"workspace", workspace, "> 0 m"};
    if (!(watchdog >= longest_tick)) return {"watchdog", watchdog, "≥ longest_tick, in s"};
    return {};
  }

  template <class Port>
  struct on {
    using scalar = typename Port::scalar;
    struct nothing {
      constexpr explicit nothing(scalar /*stated*/) noexcept {}
    };
    scalar longest_tick;
    scalar top_speed;
    scalar workspace;
    scalar watchdog;
    PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS
    std::conditional_t<Traits.learns, detail::lessons<scalar>, nothing> taught;

    constexpr explicit on(const late_loop_limits& p) noexcept
        : longest_tick(detail::number<scalar>(p.longest_tick)),
          top_speed(detail::number<scalar>(p.top_speed)),
          workspace(detail::number<scalar>(p.workspace)),
          watchdog(detail::number<scalar>(p.watchdog)),
          taught(longest_tick) {}
    [[nodiscard]] constexpr late_loop_limits parameters() const noexcept {
      return {.longest_tick = static_cast<double>(longest_tick),
              .top_speed = static_cast<double>(top_speed),
              .workspace = static_cast<double>(workspace),
              .watchdog = static_cast<double>(watchdog)};
    }
    /// The longest time [s] for which a force may have been held in a tick of `dt` [s].
    [[nodiscard]] constexpr scalar held_for(scalar dt) const noexcept {
      return kernels::clamped(dt, longest_tick, watchdog);
    }
  };
};

/// A loop with checked samples, ticks from a timer and a watchdog: a tick consists of the ledger, the bound and their
/// rounding only. No sample is checked, so a jump of the sensor is booked as work of the hand, and a lost or late tick
/// is not noticed: the guarantee is conditional on one good sample per tick. A sample that is not finite is still
/// rejected, because no ledger can book it, but the outflow of the force before it is not written off.
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
