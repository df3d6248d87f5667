// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// To and fro by a force that only changes its sign, whatever the mass: a relay (Åström and Hägglund, 1984).
//
// The force pushes across the middle and then brakes. Where it changes over is moved by a share of how far
// the last turn fell short of the stroke, so the swing comes to the stroke with friction, a load, a
// latency, none of which has to be known.

#include <passive_haptics/base/kernels.hpp>

#include <algorithm>
#include <array>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

class relay_motion {
 public:
  /// The force of the next tick at x [m] and v [m/s]. It has turned once it is `retreat` [m] back.
  double tick(double x, double v, double force, double stroke, double retreat) noexcept {
    ++ticks_;
    const double along = way_ * x;
    peak_ = kernels::larger(peak_, along);
    double& over = over_[way_ > 0.0 ? 1 : 0];
    if (!braking_ && along + lead * kernels::larger(way_ * v, 0.0) > over) braking_ = true;
    if (braking_ && peak_ - along > retreat && way_ * v < 0.0) {
      over = std::clamp(over + 0.4 * (stroke - peak_), -0.9 * stroke, 0.7 * stroke);
      reached_[way_ > 0.0 ? 1 : 0] = peak_;
      turned_at_ = way_ * peak_;
      way_ = -way_;
      peak_ = -along;
      braking_ = false;
      last_ = ticks_;
      ticks_ = 0;
      ++sweeps_;
    }
    return (braking_ ? -way_ : way_) * force;
  }
  /// The force will be another: by so much the change-over moves on a device of that friction and load [N].
  void change(double from, double to, double friction, double load, double stroke) noexcept {
    const double share = stroke * (1.0 / to - 1.0 / from);
    over_[1] = std::clamp(over_[1] + share * (friction - load), -0.9 * stroke, 0.7 * stroke);
    over_[0] = std::clamp(over_[0] + share * (friction + load), -0.9 * stroke, 0.7 * stroke);
  }
  /// Begins anew from here; what it has learned stays.
  void restart(double x) noexcept {
    way_ = x > 0.0 ? -1.0 : 1.0;
    peak_ = way_ * x;
    braking_ = false;
    ticks_ = 0;
  }

  [[nodiscard]] double turned_at() const noexcept { return turned_at_; }  ///< the last time [m]
  [[nodiscard]] int sweeps() const noexcept { return sweeps_; }           ///< so far
  [[nodiscard]] int ticks_of_last() const noexcept { return last_; }      ///< sweep
  /// The shorter of the last two turns [m].
  [[nodiscard]] double reached() const noexcept {
    return kernels::smaller(reached_[0], reached_[1]);
  }

 private:
  static constexpr double lead = 3e-3;  // what a latency and the estimate of v cost, roughly [s]

  std::array<double, 2> over_{}, reached_{};
  double way_ = 1.0, peak_ = 0.0, turned_at_ = 0.0;
  bool braking_ = false;
  int ticks_ = 0, last_ = 0, sweeps_ = 0;
};

/// For how long nothing has moved, and where that was, once it had come to rest.
class rest_watch {
 public:
  static constexpr double quiet = 0.08;  ///< [s] before positions count for the mean

  void restart() noexcept { time_ = -1.0; }
  /// [s] for which x [m] has stayed within `tolerance` [m] of where it was.
  double still(double x, double dt, double tolerance) noexcept {
    if (time_ < 0.0 || x - least_ > tolerance || most_ - x > tolerance) {
      count_ = 0;
      time_ = sum_ = 0.0;
      least_ = most_ = x;
    }
    least_ = kernels::smaller(least_, x);
    most_ = kernels::larger(most_, x);
    time_ += dt;
    last_ = x;
    if (time_ > quiet) {
      ++count_;
      sum_ += x;
    }
    return time_;
  }
  [[nodiscard]] double mean() const noexcept { return count_ > 0 ? sum_ / count_ : last_; }

 private:
  double time_ = -1.0, least_ = 0.0, most_ = 0.0, sum_ = 0.0, last_ = 0.0;
  int count_ = 0;
};

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
