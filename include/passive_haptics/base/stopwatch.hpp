// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// stopwatch measures the length dt [s] of each tick, which a sample of your own device or driver has to state.
//
//     ph::stopwatch watch;  …  return {.position = read(), .held = f, .dt = watch.lap(), .valid = true};
//     port.tick(x, ph::seconds{watch.lap(1e-3)});        // the first tick counts as 1 ms

#include <passive_haptics/base/language.hpp>

#include <chrono>
#include <concepts>
#include <utility>

namespace passive_haptics {
inline namespace v0 {

/// A monotonic clock, which is never set back or forth.
template <class C>
concept measuring_clock = requires(C c) {
  { c.now() } -> std::same_as<std::chrono::nanoseconds>;
  requires noexcept(c.now());
};

/// The computer's std::chrono::steady_clock.
struct steady_time {
  [[nodiscard]] static std::chrono::nanoseconds now() noexcept {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(
        std::chrono::steady_clock::now().time_since_epoch());
  }
};

template <measuring_clock Clock>
class basic_stopwatch {
 public:
  constexpr explicit basic_stopwatch(Clock clock = {}) noexcept
      : clock_(clock), last_(clock_.now()) {}

  /// The time since the last lap, or since the beginning [s].
  [[nodiscard]] constexpr double lap() noexcept {
    lapped_ = true;
    const std::chrono::nanoseconds now = clock_.now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }
  /// The same, except that the first lap returns `first` [s], because no force has been held before it.
  [[nodiscard]] constexpr double lap(double first) noexcept {
    const bool measured = lapped_;
    const double dt = lap();
    return measured ? dt : first;
  }
  /// Begins again, now.
  constexpr void reset() noexcept {
    last_ = clock_.now();
    lapped_ = false;
  }

 private:
  Clock clock_;
  std::chrono::nanoseconds last_;
  bool lapped_ = false;
};

using stopwatch = basic_stopwatch<steady_time>;

}  // namespace v0
}  // namespace passive_haptics
