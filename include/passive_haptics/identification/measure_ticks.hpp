// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How long are the ticks of this loop? Let it run with force zero for a minute, under the load that it
// will have, before a promise is made on it:
//
//     ph::tick_lengths ticks;
//     while (ticks.count() < 60000) { device.exchange(0); ticks.book(clock.lap()); }
//     ph::loop_limits{.longest_tick = 1.2 * ticks.longest()}
//
// What was not seen in that minute may still come: it is then an event::late_tick, and booked.

#include <passive_haptics/base/kernels.hpp>

#include <cstdint>

namespace passive_haptics {
inline namespace v0 {

/// The lengths of ticks so far [s]. What is no length, 0, negative, infinite or NaN, is only counted.
class tick_lengths {
 public:
  constexpr void book(double dt) noexcept {
    if (!(dt > 0.0) || !kernels::is_finite(dt)) {
      ++refused_;
      return;
    }
    ++count_;
    sum_ += dt;
    longest_ = kernels::larger(longest_, dt);
    shortest_ = count_ == 1 ? dt : kernels::smaller(shortest_, dt);
  }

  [[nodiscard]] constexpr std::uint64_t count() const noexcept { return count_; }
  /// Of the clock: it stood still, stepped back, or gave no number.
  [[nodiscard]] constexpr std::uint64_t refused() const noexcept { return refused_; }
  [[nodiscard]] constexpr double longest() const noexcept {
    return longest_;
  }  ///< [s], 0 before any
  [[nodiscard]] constexpr double shortest() const noexcept {
    return shortest_;
  }                                                       ///< [s], 0 before any
  [[nodiscard]] constexpr double mean() const noexcept {  ///< [s], 0 before any
    return count_ > 0 ? sum_ / static_cast<double>(count_) : 0.0;
  }

 private:
  std::uint64_t count_ = 0, refused_ = 0;
  double sum_ = 0.0, longest_ = 0.0, shortest_ = 0.0;
};

}  // namespace v0
}  // namespace passive_haptics
