// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Stretches of a recorded motion in which a rigid device with one friction is linear in its parameters, and columns of
// a least squares over them.
//
// A window is at most 64 ticks long. In it the device goes one way, faster than the Stribeck part of friction, and has
// left the place where it turned by more than friction is elastic. The constant and the slope of each window are free,
// so both are taken out of every column: the error of x is then the encoder's and white, and the beginning of a window
// does not matter. disturbance_search.hpp fits over them.

#include <passive_haptics/identification/motion_record.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

class motion_windows {
 public:
  using column = Eigen::VectorXd;
  /// `ticks` of the record, from tick `from` on.
  struct window {
    std::size_t from = 0, ticks = 0;
  };

  /// For positions in steps of `step` [m]. The ticks are kept by reference.
  motion_windows(const std::vector<kept_tick>& ticks, double step) : ticks_(ticks), step_(step) {
    find_speeds();
    find_windows();
  }

  [[nodiscard]] const std::vector<window>& all() const noexcept { return windows_; }
  [[nodiscard]] Eigen::Index rows() const noexcept { return rows_; }  ///< ticks in all windows
  [[nodiscard]] double tick() const noexcept { return tick_; }  ///< the mean length of a tick [s]
  [[nodiscard]] double middle() const noexcept { return middle_; }  ///< the mean position [m]
  [[nodiscard]] double speed(std::size_t n) const noexcept { return speed_[n]; }  ///< [m/s]
  /// The sign of the speed, smoothed where steps do not tell it.
  [[nodiscard]] double way(std::size_t n) const noexcept { return way_[n]; }

  /// value(n) of each tick n of the windows.
  template <class Value>
  [[nodiscard]] column placed(Value value) const {
    column c(rows_);
    Eigen::Index row = 0;
    for (const window& w : windows_) {
      for (std::size_t i = 0; i < w.ticks; ++i) c(row++) = value(w.from + i);
    }
    straighten(c);
    return c;
  }
  /// The double integral of acceleration(n), held for each tick n.
  template <class Value>
  [[nodiscard]] column twice(Value acceleration) const {
    column c(rows_);
    Eigen::Index row = 0;
    for (const window& w : windows_) {
      double x = 0.0, v = 0.0;
      for (std::size_t i = 0; i < w.ticks; ++i) {
        c(row++) = x;
        const double h = ticks_[w.from + i].length, a = acceleration(w.from + i);
        x += v * h + a * h * h / 2.0;
        v += a * h;
      }
    }
    straighten(c);
    return c;
  }
  /// The double integral of the speed, or of its size: a single one of the position, under the accelerations `a`.
  [[nodiscard]] column once(bool size, const std::vector<double>& a) const {
    column c(rows_);
    Eigen::Index row = 0;
    for (const window& w : windows_) {
      const double sign = size && speed_[w.from] < 0.0 ? -1.0 : 1.0;
      double sum = 0.0;
      for (std::size_t i = w.from; i < w.from + w.ticks; ++i) {
        c(row++) = sign * sum;
        const double h = ticks_[i].length;
        sum += h * ((ticks_[i].x + ticks_[i + 1].x) / 2.0 - ticks_[w.from].x - a[i] * h * h / 12.0);
      }
    }
    straighten(c);
    return c;
  }

 private:
  static constexpr std::size_t longest = 64, shortest = 12, warm_up = 12;  // [ticks]

  /// Takes the straight line out of each window.
  void straighten(column& c) const {
    Eigen::Index row = 0;
    for (const window& w : windows_) {
      const auto n = static_cast<Eigen::Index>(w.ticks);
      const column t = column::LinSpaced(n, -1.0, 1.0);
      auto part = c.segment(row, n);
      part.array() -= part.mean();
      part -= t * (t.dot(part) / t.squaredNorm());
      row += n;
    }
  }
  void find_speeds() {
    const std::size_t all = ticks_.size();
    speed_.assign(all, 0.0);
    way_.assign(all, 0.0);
    for (const kept_tick& t : ticks_) {
      tick_ += t.length / static_cast<double>(all);
      middle_ += t.x / static_cast<double>(all);
    }
    const double slow = (std::max)(5e-3, step_ / (5.0 * tick_));
    for (std::size_t n = 10; n + 11 < all; ++n) {
      speed_[n] = even(n) ? (ticks_[n + 11].x - ticks_[n - 10].x) / (21.0 * tick_)
                          : (ticks_[n + 3].x - ticks_[n - 2].x) / (5.0 * tick_);
      way_[n] = std::tanh(speed_[n] / (even(n) ? (std::max)(5e-3, step_ / (21.0 * tick_)) : slow));
    }
  }
  /// True where the speed hardly changes in 21 ticks, which tell it better than five.
  [[nodiscard]] bool even(std::size_t n) const noexcept {
    return n >= 10 && n + 11 < ticks_.size() && ticks_[n - 10].even && ticks_[n + 11].even;
  }
  void find_windows() {
    const double slow = 0.03 + step_ / (5.0 * tick_), elastic = 0.4e-3 + step_;
    std::size_t since = 0, kept = 0;  // ticks since the last gap, and kept so far
    double turn = 0.0;
    for (std::size_t n = 0; n + 4 < ticks_.size(); ++n) {
      since = ticks_[n].first ? 0 : since + 1;
      const bool fast = std::abs(speed_[n]) > (even(n) ? 0.015 + step_ / (21.0 * tick_) : slow);
      const bool same = n > 0 && speed_[n] * speed_[n - 1] > 0.0;
      if (since == 0 || !same) turn = ticks_[n].x;
      const bool counts = fast && same && since >= warm_up && !ticks_[n + 3].first &&
                          !ticks_[n + 2].first && !ticks_[n + 1].first &&
                          std::abs(ticks_[n].x - turn) > elastic;
      kept = counts ? kept + 1 : 0;
      if (kept == 0) continue;
      if (kept == 1 || kept > longest) {
        drop_short();
        windows_.push_back({n, 0});
        kept = 1;
      }
      ++windows_.back().ticks;
    }
    drop_short();
    for (const window& w : windows_) rows_ += static_cast<Eigen::Index>(w.ticks);
  }
  void drop_short() {
    if (!windows_.empty() && windows_.back().ticks < shortest) windows_.pop_back();
  }

  const std::vector<kept_tick>& ticks_;
  double step_, tick_ = 0.0, middle_ = 0.0;
  std::vector<double> speed_{}, way_{};
  std::vector<window> windows_{};
  Eigen::Index rows_ = 0;
};

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
