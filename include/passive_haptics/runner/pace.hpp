// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Waits until the next tick is due, and measures the time since the last [ns].
//
//   due      0        T        2T        3T                    wakes are measured, never assumed
//   wake     │        │·       │··       │        ········│        │
//   dt               T+late …  from wake to wake           lost    T after the late wake
//
// The sleep is absolute, so neither the work of a tick nor a wake that is a little late adds up to a drift.
// A wake that is a whole period late or more begins the grid anew: the lost periods are given up, because a
// force for an instant that has passed is of no use. Linux sleeps with clock_nanosleep;
// elsewhere std::this_thread::sleep_until does.

#include <passive_haptics/base/stopwatch.hpp>

#include <chrono>
#include <concepts>
#include <cstdint>
#include <utility>

#if defined(__linux__)
#include <cerrno>
#include <time.h>
#else
#include <thread>
#endif

namespace passive_haptics {
inline namespace v0 {

/// A monotonic clock, and a sleep until one of its instants.
template <class C>
concept pacing_clock = measuring_clock<C> && requires(C c, std::chrono::nanoseconds t) {
  c.sleep_until(t);
  requires noexcept(c.sleep_until(t));
};

/// The monotonic clock of the computer: on Linux std::chrono::steady_clock is CLOCK_MONOTONIC.
struct monotonic_clock : steady_time {
#if defined(__linux__)
  static void sleep_until(std::chrono::nanoseconds due) noexcept {
    const auto whole = std::chrono::duration_cast<std::chrono::seconds>(due);
    timespec t{};
    t.tv_sec = static_cast<decltype(t.tv_sec)>(whole.count());
    t.tv_nsec = static_cast<decltype(t.tv_nsec)>((due - whole).count());
    while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, nullptr) == EINTR) {
    }
  }
#else
  static void sleep_until(std::chrono::nanoseconds due) noexcept {
    using clock = std::chrono::steady_clock;
    std::this_thread::sleep_until(
        clock::time_point(std::chrono::duration_cast<clock::duration>(due)));
  }
#endif
};

/// The times at the beginning of a tick.
struct wake {
  std::chrono::nanoseconds dt{};    ///< time since the wake before
  std::chrono::nanoseconds late{};  ///< time since it was due
  std::uint64_t lost = 0;           ///< whole periods that were given up

  [[nodiscard]] constexpr double seconds() const noexcept {  ///< dt [s]
    return std::chrono::duration<double>(dt).count();
  }
};

/// begin() starts the grid of ticks, next() waits until a tick is due. The loop's thread calls both.
template <class P>
concept pace = requires(P p) {
  p.begin();
  { p.next() } -> std::same_as<wake>;
  { std::as_const(p).period() } -> std::same_as<std::chrono::nanoseconds>;
  requires noexcept(p.begin())&& noexcept(p.next())&& noexcept(std::as_const(p).period());
};

template <pacing_clock Clock>
class basic_pace {
 public:
  constexpr explicit basic_pace(std::chrono::nanoseconds period, Clock clock = {}) noexcept
      : clock_(clock), period_(period) {}

  [[nodiscard]] constexpr std::chrono::nanoseconds period() const noexcept { return period_; }

  constexpr void begin() noexcept { last_ = due_ = clock_.now(); }

  [[nodiscard]] constexpr wake next() noexcept {
    due_ += period_;
    if (clock_.now() < due_) clock_.sleep_until(due_);
    const std::chrono::nanoseconds now = clock_.now();
    const wake w{.dt = now - last_,
                 .late = now - due_,
                 .lost = static_cast<std::uint64_t>((now - due_) / period_)};
    last_ = now;
    if (w.lost > 0) due_ = now;
    return w;
  }

 private:
  Clock clock_;
  std::chrono::nanoseconds period_, due_{}, last_{};
};

using steady_pace = basic_pace<monotonic_clock>;

}  // namespace v0
}  // namespace passive_haptics
