// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Swings any mass to and fro by a force that only changes its sign: a relay (Åström and Hägglund, 1984).
//
// The force pushes across the middle and then brakes. The point of change-over moves by 0.4 of the distance by
// which the last turn fell short of the stroke, so friction, load and latency need not be known.
//
// A relay excites an axis at the frequency of its swing only. So a shaken one adds blocks + − − +, their elements 1 to 16
// ticks long and of a height that falls with the square root of the length: a block neither pushes nor moves the axis
// on balance, and all of them together have power from 15 Hz to half the rate of the loop.

#include <passive_haptics/base/kernels.hpp>
#include <passive_haptics/identification/axis_record.hpp>

#include <algorithm>
#include <array>
#include <cstdint>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

class relay_motion {
 public:
  /// The next force, ±`force` [N], at x [m] and v [m/s], for a swing of `stroke` [m]. A turn is detected once the
  /// axis has come back by `retreat` [m].
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
  /// Moves the points of change-over for a force `to` instead of `from` [N], on a device of that friction and load [N].
  void change(double from, double to, double friction, double load, double stroke) noexcept {
    const double share = stroke * (1.0 / to - 1.0 / from);
    over_[1] = std::clamp(over_[1] + share * (friction - load), -0.9 * stroke, 0.7 * stroke);
    over_[0] = std::clamp(over_[0] + share * (friction + load), -0.9 * stroke, 0.7 * stroke);
  }
  /// Begins anew from x [m], and keeps the points of change-over.
  void restart(double x) noexcept {
    way_ = x > 0.0 ? -1.0 : 1.0;
    peak_ = way_ * x;
    braking_ = false;
    ticks_ = 0;
  }

  [[nodiscard]] double turned_at() const noexcept { return turned_at_; }  ///< last turn [m]
  [[nodiscard]] int sweeps() const noexcept { return sweeps_; }           ///< number so far
  [[nodiscard]] int ticks_of_last() const noexcept { return last_; }      ///< last sweep [ticks]
  /// The shorter of the last two turns [m].
  [[nodiscard]] double reached() const noexcept {
    return kernels::smaller(reached_[0], reached_[1]);
  }

 private:
  static constexpr double lead = 3e-3;  // delay of latency and of the estimate of v, roughly [s]

  std::array<double, 2> over_{}, reached_{};
  double way_ = 1.0, peak_ = 0.0, turned_at_ = 0.0;
  bool braking_ = false;
  int ticks_ = 0, last_ = 0, sweeps_ = 0;
};

/// The relay of a recorded axis. Its force goes to a smaller one step by step, at most a fifth less at each turn,
/// and each step moves the change-over accordingly.
class eased_relay {
 public:
  /// Begins with that force [N]; `stroke` [m] is to either side of the start of the axis.
  eased_relay(double force, double stroke) noexcept : force_(force), stroke_(stroke) {}

  /// The force of the next tick [N], for a swing of that amplitude [m].
  double tick(const axis_record& seen, double amplitude) noexcept {
    return relay_.tick(seen.x(), seen.velocity(6), force_, amplitude, 1.5 * seen.step() + 20e-6);
  }
  /// The same, on the way to the force `wanted` [N].
  double tick(const axis_record& seen, double amplitude, double wanted) noexcept {
    if (relay_.sweeps() != eased_at_) {
      eased_at_ = relay_.sweeps();
      const double force = kernels::larger(wanted, 0.8 * force_);
      if (force != force_) relay_.change(force_, force, friction_, load_, stroke_);
      force_ = force;
    }
    return tick(seen, amplitude);
  }
  /// Takes rough values of the device's friction and load [N].
  void expect(double friction, double load) noexcept {
    friction_ = friction;
    load_ = load;
  }
  /// Begins anew from x [m], and keeps the points of change-over.
  void restart(double x) noexcept { relay_.restart(x); }

  [[nodiscard]] const relay_motion& motion() const noexcept { return relay_; }
  [[nodiscard]] int sweeps() const noexcept { return relay_.sweeps(); }  ///< number so far

 private:
  relay_motion relay_;
  double force_, stroke_, friction_ = 0.0, load_ = 0.0;
  int eased_at_ = 0;  // sweep of the last change of force
};

/// The sequence of blocks, each value between −1 and 1.
class block_sequence {
 public:
  double tick() noexcept {
    constexpr int lengths[]{1, 1, 2, 3, 4, 6, 8, 12, 16};
    constexpr double heights[]{1.0, 1.0, 0.707, 0.577, 0.5, 0.408, 0.354, 0.289, 0.25};
    if (left_ == 0) {
      which_ = static_cast<int>(draw() % 9);
      sign_ = draw() % 2 == 0 ? 1.0 : -1.0;
      left_ = 4 * lengths[which_];
    }
    const int part = (4 * lengths[which_] - left_) / lengths[which_];
    --left_;
    return (part == 0 || part == 3 ? sign_ : -sign_) * heights[which_];
  }

 private:
  /// A linear congruential generator (Knuth's MMIX), so that every run is the same.
  std::uint32_t draw() noexcept {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<std::uint32_t>(state_ >> 33);
  }
  std::uint64_t state_ = 1;
  int which_ = 0, left_ = 0;
  double sign_ = 1.0;
};

/// A relay with blocks on top. The relay takes at most 0.6 of the force allowed, and a block no more than the relay.
class shaken_relay {
 public:
  shaken_relay() noexcept = default;
  /// For sweeps with `force`, of at most `most` [N].
  shaken_relay(double force, double most) noexcept
      : most_(most),
        swing_((std::min)(force, 0.6 * most)),
        height_((std::min)(swing_, most - swing_)) {}

  /// The force of the next tick [N].
  double tick(const axis_record& seen, eased_relay& relay, double amplitude) noexcept {
    const double force = relay.tick(seen, amplitude, swing_) + height_ * blocks_.tick();
    return std::clamp(force, -most_, most_);  // the relay comes down step by step
  }

 private:
  double most_ = 0.0, swing_ = 0.0, height_ = 0.0;
  block_sequence blocks_;
};

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
