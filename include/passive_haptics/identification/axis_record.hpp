// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The record of one axis while it is identified.
// It has position and velocity, the lengths of the ticks, the steps of the sensor, and the missing samples.
//
//     v = (x(n) − x(n−k)) / Σ h        over the last k ticks, h their measured lengths [m/s]
//
// Steps and noise are found by step_finder.hpp.

#include <passive_haptics/identification/axis_found.hpp>
#include <passive_haptics/identification/measure_ticks.hpp>
#include <passive_haptics/identification/step_finder.hpp>

#include <algorithm>
#include <array>
#include <cstddef>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

class axis_record {
 public:
  /// `rounding` is the epsilon of the scalar of the positions.
  explicit axis_record(double rounding = std::numeric_limits<double>::epsilon()) noexcept
      : steps_(rounding) {}

  /// Adds the position [m] at the end of a tick of that length [s]; `at_rest` says that the device rests.
  void book(double position, double length, bool at_rest) noexcept {
    missing_ = 0;
    ++samples_;
    if (samples_ == 1) start_ = position;
    position_ = position;
    before_ = x_;
    x_ = position - start_;
    ticks_.book(length);
    recent_[static_cast<std::size_t>(++seen_) % recent_.size()] = {x_, length};
    steps_.book(position, at_rest, unchanged_ > 12);
  }
  /// Adds the force commanded for the tick that begins now [N].
  void commanded(double force) noexcept {
    unchanged_ = force == force_ ? unchanged_ + 1 : 0;
    force_ = force;
  }
  /// Adds a missing sample: no velocity and no difference spans it.
  void interrupt() noexcept {
    ++missed_;
    ++missing_;
    steps_.interrupt();
    seen_ = unchanged_ = 0;
  }
  /// True if more than 50 samples in a row are missing, or more than 200 and a twentieth of all.
  [[nodiscard]] bool too_few() const noexcept {
    return missing_ > 50 || (missed_ > 200 && missed_ * 20 > samples_);
  }

  [[nodiscard]] int samples() const noexcept { return samples_; }       ///< so far
  [[nodiscard]] double position() const noexcept { return position_; }  ///< as read [m]
  [[nodiscard]] double x() const noexcept { return x_; }                ///< from its start [m]
  [[nodiscard]] double before() const noexcept { return before_; }      ///< x a sample earlier [m]
  /// The length of the last tick [s].
  [[nodiscard]] double dt() const noexcept { return recent(0).length; }
  /// v [m/s] over `ticks` ticks, at most 31, or over as many as there are without a gap.
  [[nodiscard]] double velocity(int ticks) const noexcept {
    const int back = (std::min)(seen_ - 1, ticks);
    double lasted = 0.0;
    for (int j = 0; j < back; ++j) lasted += recent(j).length;
    return lasted > 0.0 ? (x_ - recent(back).position) / lasted : 0.0;
  }
  /// The resolution of the positions [m], as far as it is known by now.
  [[nodiscard]] double step() const noexcept { return steps_.so_far(); }

  /// States the bounds of the sensor and of the loop.
  void state(axis_found& found) const noexcept {
    found.quantum = steps_.step();
    found.noise = steps_.noise();
    found.longest_tick = ticks_.longest();
  }

 private:
  struct sample {
    double position = 0.0, length = 0.0;
  };
  /// The sample that came `back` samples before the last.
  [[nodiscard]] const sample& recent(int back) const noexcept {
    return recent_[static_cast<std::size_t>(seen_ - back) % recent_.size()];
  }

  tick_lengths ticks_;
  step_finder steps_;
  std::array<sample, 32> recent_{};
  int seen_ = 0, samples_ = 0, missed_ = 0, missing_ = 0;
  double start_ = 0.0, position_ = 0.0, x_ = 0.0, before_ = 0.0, force_ = 0.0;
  int unchanged_ = 0;  // ticks for which the force has not changed
};

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
