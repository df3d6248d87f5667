// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The ticks in which the axis moves, kept for disturbance_search.hpp.

#include <passive_haptics/base/language.hpp>

#include <cstddef>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

/// A tick: the position [m] at its beginning, the force commanded for it [N], its length [s], and its time [s].
struct kept_tick {
  double x = 0.0, force = 0.0, length = 0.0, time = 0.0;
  bool first = false;  ///< true if there is a gap before it
  bool even = false;   ///< true if the axis crosses slowly, at a speed that hardly changes
};

/// It allocates when it is made, and drops what comes after it is full.
class motion_record {
 public:
  explicit motion_record(std::size_t most = 40000) { ticks_.reserve(most); }

  /// Takes the position [m] at the end of a tick of that length [s].
  void sample(double x, double length) noexcept {
    time_ += length;
    if (!ticks_.empty() && !gap_) ticks_.back().length = length;
    next_ = x;
  }
  /// Takes the force commanded for the tick that begins now [N], and whether it crosses slowly.
  void commanded(double force, bool even) noexcept {
    if (ticks_.size() == ticks_.capacity()) return;
    ticks_.push_back({next_, force, 0.0, time_, gap_, even});
    gap_ = false;
  }
  /// The ticks to come do not follow on the last one; they lasted `length` [s].
  void leave_out(double length) noexcept {
    time_ += length;
    gap_ = true;
  }
  [[nodiscard]] const std::vector<kept_tick>& ticks() const noexcept { return ticks_; }

 private:
  std::vector<kept_tick> ticks_;
  double next_ = 0.0, time_ = 0.0;
  bool gap_ = true;
};

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
