// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The step of a position sensor, from the positions that it shows.
//
// Positions with steps q lie on a lattice, so two of them differ by a multiple of q: the least difference
// seen is a multiple of q, never less, and q itself once the device has turned round slowly. Whether they
// do lie on a lattice is asked of every position; where they do not (noise, kinematics behind the
// encoders), the largest second difference at rest is what a position may be off by.

#include <passive_haptics/kernels.hpp>

#include <cmath>
#include <limits>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

class encoder_step {
 public:
  /// `rounding` is that of the scalar in which positions come.
  explicit encoder_step(double rounding = std::numeric_limits<double>::epsilon()) noexcept
      : rounding_(rounding) {}

  /// A position [m]; `slow` says that the device is at rest or next to it.
  void book(double position, bool slow) noexcept {
    ++count_;
    const double moved = kernels::magnitude(position - last_);
    const double blur =
        2.0 * rounding_ * (kernels::magnitude(position) + kernels::magnitude(last_));
    if (count_ > 1 && moved > blur && moved < least_ * (1.0 - 0.05)) {
      least_ = moved;
      blur_ = blur;
      misfits_ = asked_ = 0;
    }
    if (count_ > 1 && moved > blur) look(position);
    slow_ = slow ? slow_ + 1 : 0;
    if (slow_ > 3) {
      largest_turn_ =
          kernels::larger(largest_turn_, kernels::magnitude(position - 2.0 * last_ + before_));
    }
    before_ = last_;
    last_ = position;
  }

  /// The positions lie on a lattice.
  [[nodiscard]] bool has_step() const noexcept {
    return asked_ >= 20 && misfits_ * 50 <= asked_ && kernels::is_finite(least_);
  }
  /// q [m], an upper bound; 0 if there is no lattice.
  [[nodiscard]] double step() const noexcept { return has_step() ? least_ + blur_ : 0.0; }
  /// What a position may be off by beside the step, from end to end [m].
  [[nodiscard]] double noise() const noexcept {
    return has_step() ? kernels::larger(largest_turn_ - 2.0 * least_, 0.0) : largest_turn_;
  }
  /// To go on with while nothing is known for sure [m].
  [[nodiscard]] double so_far() const noexcept {
    return has_step() ? least_ : kernels::larger(largest_turn_, 0.0);
  }

 private:
  /// Is it a multiple of the least difference away from the first?
  void look(double position) noexcept {
    const double steps = (position - last_) / least_;
    ++asked_;
    const double off = kernels::magnitude(steps - std::round(steps));
    if (off > 0.02 + 1e-4 * kernels::magnitude(steps)) ++misfits_;
  }

  double rounding_, last_ = 0.0, before_ = 0.0, blur_ = 0.0;
  double least_ = std::numeric_limits<double>::infinity();
  double largest_turn_ = 0.0;
  long count_ = 0, asked_ = 0, misfits_ = 0;
  int slow_ = 0;
};

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
