// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The device brought to rest at a place, and left there to its friction alone.
//
//     park      f = −w − m ω² (x − target) − 1.6 m ω v      until it has moved nowhere for 0.1 s
//     balance   f comes back to −w within 60 ms             until it has moved nowhere for 0.2 s
//
// m [kg] and the load w [N] are those of the swing, ω = 12 √(1 kg/m) [1/s], 12 to 40; the damping is 0.8 of
// the critical one. A device that friction does not hold against what is left of the load moves on: it is
// parked anew where it is, eight times in all.

#include <passive_haptics/identification/axis_record.hpp>
#include <passive_haptics/identification/timed_phase.hpp>

#include <algorithm>
#include <cmath>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

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

class parking {
 public:
  parking() noexcept = default;
  /// Of a device of that mass [kg] and load [N]; `stroke` to either side of where it began [m].
  parking(double mass, double load, double stroke) noexcept
      : mass_(mass), load_(load), stroke_(stroke) {}

  /// Parks it at x [m].
  void begin(double x) noexcept {
    target_ = x;
    watch_anew();
    phase_.enter(phase::park);
  }
  /// Parks it where it is, or where the stroke ends.
  void begin_here(const axis_record& seen) noexcept {
    begin(std::clamp(seen.x(), -0.5 * stroke_, 0.5 * stroke_));
  }
  /// The same, because it did not stay. The force of the next tick [N].
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
  /// It stays where it is, held by nothing but friction.
  [[nodiscard]] bool parked() const noexcept { return phase_ == phase::parked; }
  /// It does not stay: why; null if it may yet.
  [[nodiscard]] const char* problem() const noexcept { return problem_; }

  /// The force that puts `force` on friction beside the load [N].
  [[nodiscard]] double balanced(double force) const noexcept { return force - load_; }
  /// For how long it has been at rest [s], but for what friction's spring rings; once a tick.
  [[nodiscard]] double resting(const axis_record& seen) noexcept {
    return rest_.still(seen.x(), seen.dt(), 1.01 * seen.step() + elastic);
  }
  /// resting() begins from zero.
  void watch_anew() noexcept { rest_.restart(); }
  /// Where it has been at rest, in the mean [m].
  [[nodiscard]] double place() const noexcept { return rest_.mean(); }

 private:
  enum class phase : std::uint8_t { park, balance, parked };
  static constexpr double elastic = 120e-6;  // motion that is no slip [m]

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
  /// The spring is let go; friction holds the device, or does not.
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
