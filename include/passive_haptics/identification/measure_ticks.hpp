// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Measures the lengths of the ticks of a loop.
// Run it with zero force for a minute, under the load that the loop will have, before you state longest_tick:
//
//     ph::tick_lengths ticks;
//     while (ticks.count() < 60000) { device.exchange(0); ticks.book(clock.lap()); }
//     ph::loop_limits{.longest_tick = 1.2 * ticks.longest()}
//
// A longer tick than that may still come: it raises event::late_tick, and its energy is booked.

#include <passive_haptics/base/kernels.hpp>

#include <cstdint>

namespace passive_haptics {
inline namespace v0 {

/// The lengths of ticks so far [s]. A length that is not > 0 and finite is only counted, by refused().
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
  /// The number of lengths that were not finite and > 0, because the clock stood still or stepped back.
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
