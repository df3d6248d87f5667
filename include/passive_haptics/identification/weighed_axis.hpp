// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// An axis that a spring pulls to and fro across the same way, and the load that this takes; weigh_in.hpp uses it.
//
// From one turn to the next the device goes D [m] and is at rest at both ends. So the mean of the commands f along that
// way is
//
//     F± = Σ f Δx/D = (L ± c)/g     L: load, c: friction and damping [N], g: newtons delivered for each commanded
//
// and (F₊ + F₋)/2 = L/g has neither friction in it, as both sides are approached alike, nor inertia. The way differs
// from cycle to cycle by up to a third, so that what depends on it shows in the spread.

#include <passive_haptics/identification/axis_record.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

/// Means over some cycles, in newtons commanded.
struct weighed_load {
  int cycles = 0;
  double load = 0.0, friction = 0.0;  ///< [N]
  double stiffness = 0.0;             ///< of what holds it, ∂f/∂x [N/m]
  double squares = 0.0;               ///< of what the load of a cycle is off by, summed [N²]

  /// The standard deviation of a cycle [N].
  [[nodiscard]] double deviation() const noexcept {
    return cycles > 1 ? std::sqrt(squares / (cycles - 1)) : 0.0;
  }
};

class weighed_axis {
 public:
  /// Begins a weighing about the place where it is, or about that of the last one.
  void begin(bool here) noexcept {
    if (here) centre_ = end_ = record_.x();
    found_ = {};
    restart();
  }
  /// The force of the next tick [N], at most `most`, after a position at the end of a tick of that length. `mass` [kg] is
  /// roughly that of the axis. It goes up to `way` [m] to either side if it weighs, and else keeps to the middle.
  double tick(double position, double dt, double mass, double way, double most,
              bool weighs) noexcept {
    record_.book(position, dt, false);
    const double x = record_.x(), moved = x - record_.before(), fast = way / 0.15;
    now_ = {x, now_.work + force_ * moved,
            now_.moment + force_ * moved * (x - 0.5 * moved - centre_)};
    lasted_ += dt;
    if (x < turns_[0].x) turns_[0] = now_;
    if (x > turns_[1].x) turns_[1] = now_;
    const double share = 1.0 - 0.05 * static_cast<double>((3 * found_.cycles) % 8);
    if (weighs && way_ * (x - centre_) > share * way) turn();
    end_ += (weighs ? way_ * fast : std::clamp((centre_ - x) / 0.3, -fast, fast)) * dt;
    const double omega = std::clamp(12.0 / std::sqrt(mass), 12.0, 40.0), k = mass * omega * omega;
    const int window = std::clamp(static_cast<int>(8.0 * std::sqrt(mass / 0.1)), 6, 24);
    end_ = std::clamp(end_, x - most / k, x + most / k);
    const double wanted = k * (end_ - x) - 1.6 * mass * omega * record_.velocity(window);
    force_ = std::clamp(wanted, -most, most);
    limited_ = kernels::magnitude(wanted) < 0.999 * most ? 0.0 : limited_ + dt;
    record_.commanded(force_);
    return force_;
  }
  void lost() noexcept {
    record_.interrupt();
    force_ = 0.0;
    restart();
  }

  [[nodiscard]] const weighed_load& found() const noexcept { return found_; }
  /// A sentence if it does not go to and fro as it should, or null.
  [[nodiscard]] const char* problem(double way) const noexcept {
    if (record_.too_few()) return "the device gave too few good samples";
    if (limited_ > 1.0) {
      return "the largest force does not move it: hang less, or allow more force";
    }
    if (lasted_ > 5.0)
      return "it does not get across: let go of the device, and keep off its stops";
    if (halves_ > 1 && kernels::magnitude(now_.x - centre_) > 5.0 * way) {
      return "it does not stay at its pose: let go of the device, or state what it moves";
    }
    return nullptr;
  }

 private:
  /// A place, and Σ f Δx and Σ f (x − centre) Δx up to there.
  struct mark {
    double x = 0.0, work = 0.0, moment = 0.0;
  };
  void restart() noexcept {
    halves_ = 0;
    limited_ = lasted_ = 0.0;
    now_ = {record_.x(), 0.0, 0.0};
    turns_ = {now_, now_};
  }
  /// It is across, so the turn behind it is known, and the way up to there from the turn before.
  void turn() noexcept {
    mark& behind = turns_[way_ > 0.0 ? 0 : 1];
    if (++halves_ > 3) {
      const double D = behind.x - from_.x, work = behind.work - from_.work;
      const double middle = 0.5 * (behind.x + from_.x) - centre_;
      const double f = work / D;
      const double slope = 12.0 * (behind.moment - from_.moment - middle * work) / (D * D * D);
      if (halves_ % 2 == 1) book(f, slope);
      before_ = {f, slope};
    }
    from_ = behind;
    behind = now_;
    way_ = -way_;
    lasted_ = 0.0;
  }
  void book(double f, double slope) noexcept {
    const int n = ++found_.cycles;
    const double load = 0.5 * (f + before_[0]), off = load - found_.load;
    found_.load += off / n;
    found_.squares += off * (load - found_.load);
    found_.friction += (0.5 * kernels::magnitude(f - before_[0]) - found_.friction) / n;
    found_.stiffness += (0.5 * (slope + before_[1]) - found_.stiffness) / n;
  }

  axis_record record_;
  weighed_load found_{};
  mark now_{}, from_{};
  std::array<mark, 2> turns_{};     // the lowest and the highest place since the last turn there
  std::array<double, 2> before_{};  // mean force [N] and slope [N/m] of the way before
  double centre_ = 0.0, end_ = 0.0, way_ = 1.0, force_ = 0.0, limited_ = 0.0, lasted_ = 0.0;
  int halves_ = 0;
};

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
