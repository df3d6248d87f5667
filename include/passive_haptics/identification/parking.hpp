// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Brings the device to rest at a place, where its friction alone then holds it.
//
//     park      f = −w − m ω² (x − target) − 1.6 m ω v      until it has been at rest for 0.1 s
//     balance   f comes back to −w within 60 ms             until it has been at rest for 0.2 s
//
// m [kg] and the load w [N] are those of the swing, ω = 12 √(1 kg/m) [1/s], 12 to 40; the damping is 0.8 of the
// critical one. If friction does not hold the device against the error of w, the device moves on and is parked
// anew where it is, up to eight times.

#include <passive_haptics/identification/axis_record.hpp>
#include <passive_haptics/identification/timed_phase.hpp>

#include <algorithm>
#include <cmath>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

/// The time for which the device has been at rest, and its mean position since then.
class rest_watch {
 public:
  static constexpr double quiet = 0.08;  ///< time at rest before positions count for the mean [s]

  void restart() noexcept { time_ = -1.0; }
  /// Adds a position x [m]; returns the time [s] for which all have stayed within `tolerance` [m].
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

class parking {
 public:
  parking() noexcept = default;
  /// For a device of that mass [kg] and load [N], with `stroke` [m] to either side of its start.
  parking(double mass, double load, double stroke) noexcept
      : mass_(mass), load_(load), stroke_(stroke) {}

  /// Begins to park the device at x [m].
  void begin(double x) noexcept {
    target_ = x;
    watch_anew();
    phase_.enter(phase::park);
  }
  /// Begins to park it where it is, or at half the stroke if it is farther out.
  void begin_here(const axis_record& seen) noexcept {
    begin(std::clamp(seen.x(), -0.5 * stroke_, 0.5 * stroke_));
  }
  /// Parks a device again that has moved on; returns the force of the next tick [N].
  double begin_again(const axis_record& seen) noexcept {
    if (++slipped_ > 8) return give_up();
    begin_here(seen);
    return balanced(0.0);
  }

  /// The force of the next tick [N].
  double tick(const axis_record& seen) noexcept {
    phase_.lasts(seen.dt());
    return phase_ == phase::park ? park(seen) : balance(seen);
  }
  /// True once it stays where it is, held by friction alone.
  [[nodiscard]] bool parked() const noexcept { return phase_ == phase::parked; }
  /// A sentence if the device cannot be parked, else null.
  [[nodiscard]] const char* problem() const noexcept { return problem_; }

  /// The command [N] that balances the load and leaves `force` [N] to friction.
  [[nodiscard]] double balanced(double force) const noexcept { return force - load_; }
  /// The time for which it has been at rest [s], ringing on friction's spring apart; call it once a tick.
  [[nodiscard]] double resting(const axis_record& seen) noexcept {
    return rest_.still(seen.x(), seen.dt(), 1.01 * seen.step() + elastic);
  }
  /// Lets resting() begin from zero.
  void watch_anew() noexcept { rest_.restart(); }
  /// The mean position at rest [m].
  [[nodiscard]] double place() const noexcept { return rest_.mean(); }

 private:
  enum class phase : std::uint8_t { park, balance, parked };
  static constexpr double elastic = 120e-6;  // motion that does not count as a slip [m]

  double give_up() noexcept {
    problem_ = "dry friction: not found, it does not hold the device at rest";
    return 0.0;
  }
  double park(const axis_record& seen) noexcept {
    const int window = std::clamp(static_cast<int>(8.0 * std::sqrt(mass_ / 0.1)), 6, 24);
    const double m = mass_;
    const double omega = std::clamp(12.0 / std::sqrt(m), 12.0, 40.0);
    const double v = seen.velocity(window);
    const double force = balanced(-m * omega * omega * (seen.x() - target_) - 1.6 * m * omega * v);
    if (resting(seen) > 0.1) {
      parked_force_ = force;
      phase_.enter(phase::balance);
      watch_anew();
    } else if (phase_.lasted() > 3.0) {
      return give_up();
    }
    return force;
  }
  /// Takes the spring of park() away over 60 ms, and waits whether friction alone holds the device.
  double balance(const axis_record& seen) noexcept {
    const double share = (std::min)(phase_.lasted() / 0.06, 1.0);
    const double force = balanced((1.0 - share) * (parked_force_ + load_));
    if (resting(seen) > 0.2 && phase_.lasted() > 0.2) {
      phase_.enter(phase::parked);
    } else if (phase_.lasted() > 1.0) {
      return begin_again(seen);
    }
    return force;
  }

  timed_phase<phase> phase_{phase::park};
  double mass_ = 0.0, load_ = 0.0, stroke_ = 0.0, target_ = 0.0, parked_force_ = 0.0;
  rest_watch rest_;
  int slipped_ = 0;
  const char* problem_ = nullptr;
};

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
