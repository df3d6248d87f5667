// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The step of a position sensor, from the positions that it shows.
//
// Positions with steps q [m] lie on a lattice, so two of them differ by a multiple of q: the least difference seen
// is a multiple of q, and q itself once the device has turned round slowly. Every position tests whether there is
// a lattice. If there is none (noise, kinematics behind the encoders), third differences show the error of a
// position: under a constant force those of the motion are small, and those of errors of deviation s have the
// variance 20 s². A sum of three uniform errors, as three encoders make it, is at most 6 s wide; a fifth is added.

#include <passive_haptics/base/kernels.hpp>

#include <array>
#include <cmath>
#include <limits>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

class step_finder {
 public:
  /// `rounding` is the epsilon of the scalar of the positions.
  explicit step_finder(double rounding = std::numeric_limits<double>::epsilon()) noexcept
      : rounding_(rounding) {}

  /// Adds a position [m]; `resting` says that the device is at rest, `steady` that the force on it has not changed
  /// for some ticks.
  void book(double position, bool resting, bool steady) noexcept {
    ++count_;
    const double moved = kernels::magnitude(position - last_[0]);
    const double blur =
        2.0 * rounding_ * (kernels::magnitude(position) + kernels::magnitude(last_[0]));
    if (count_ > 1 && moved > blur) {
      if (moved < 0.95 * least_) {
        least_ = moved;
        blur_ = blur;
        misfits_ = asked_ = 0;
      }
      look(moved);
    }
    at_rest_ = resting ? at_rest_ + 1 : 0;
    if (at_rest_ > 3) {
      largest_turn_ =
          kernels::larger(largest_turn_, kernels::magnitude(position - 2.0 * last_[0] + last_[1]));
    }
    if (steady && count_ > 3) {
      const double third = position - 3.0 * last_[0] + 3.0 * last_[1] - last_[2];
      thirds_ += third * third;
      ++steady_;
    }
    last_ = {position, last_[0], last_[1]};
  }
  /// Adds a missing sample.
  void interrupt() noexcept { count_ = at_rest_ = 0; }

  /// True if the positions lie on a lattice.
  [[nodiscard]] bool has_step() const noexcept {
    return asked_ >= 20 && misfits_ * 50 <= asked_ && kernels::is_finite(least_);
  }
  /// q [m], an upper bound; 0 if there is no lattice.
  [[nodiscard]] double step() const noexcept { return has_step() ? least_ + blur_ : 0.0; }
  /// The width of the error of a position besides its step, from end to end [m].
  [[nodiscard]] double noise() const noexcept {
    if (has_step()) return kernels::larger(largest_turn_ - 2.0 * (least_ + blur_), 0.0);
    return kernels::larger(largest_turn_, 7.2 * deviation());
  }
  /// The resolution by now [m], for use while the experiments run.
  [[nodiscard]] double so_far() const noexcept { return has_step() ? least_ : 3.5 * deviation(); }

 private:
  /// Tests whether the difference `moved` [m] is a multiple of the least difference.
  void look(double moved) noexcept {
    const double steps = moved / least_;
    const double blurred = 0.02 + 2.0 * steps * blur_ / least_;
    if (blurred > 0.2) return;
    ++asked_;
    if (kernels::magnitude(steps - std::round(steps)) > blurred) ++misfits_;
  }
  [[nodiscard]] double deviation() const noexcept {
    return steady_ > 20 ? std::sqrt(thirds_ / (20.0 * static_cast<double>(steady_))) : 0.0;
  }

  double rounding_, blur_ = 0.0;
  double least_ = std::numeric_limits<double>::infinity();
  double largest_turn_ = 0.0, thirds_ = 0.0;
  std::array<double, 3> last_{};
  long count_ = 0, asked_ = 0, misfits_ = 0, steady_ = 0;
  int at_rest_ = 0;
};

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
