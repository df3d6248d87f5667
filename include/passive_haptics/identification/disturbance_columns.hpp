// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What each disturbance adds to the motion of a rigid device, as columns of a least squares over motion_windows.hpp.
//
// They are computed from a = (f(t − d) − b ẋ − c sgn ẋ + w)/m of the rigid fit:
//
//     hand       ∬ x, or what is left of x behind a high-pass                  g = −k/m                    τ
//     mode       y: ÿ + 2ζω ẏ + ω² y = a          g = (1 − σ)/σ, σ the share of the mass at the encoder    ω, ζ
//     backlash   side of the gap, −1 to 1: where a body is that is thrown to and fro between two stops
//                by a                             g = (1 − σ) gap/2                                       σ gap, back
//     fraction   ∬ (f(t − d ∓ T) − f(t − d))/m    g = the fraction                                        ∓
//     filter     ∬ (f behind a low-pass)/m − …    g = 1                                                   θ, d
//     cogging    ∬ sin 2πx/L, ∬ cos 2πx/L, the means over ticks   √(g₁² + g₂²) m = its amplitude           1/L
//     drift      ∬ t sgn ẋ, ∬ t                                                g = ċ/m, ẇ/m
//     uneven     cogging times sgn ẋ: friction that ripples along the way                                  1/L
//     swung      where a body is that the axis swings by a spring: a mode, told without the rigid fit      ω, ζ
//
// Source: ours (docs/design/identification.md).

#include <passive_haptics/identification/motion_windows.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

/// The first seven are those of `disturbance`, in its order.
enum class column_of : std::uint8_t {
  hand,
  mode,
  backlash,
  fraction,
  filter,
  cogging,
  drift,
  uneven,
  swung
};

/// A disturbance with the one or two numbers in which it is not linear.
struct shaped_disturbance {
  column_of is = column_of::uneven;
  double p1 =
      0.0;  ///< hand: τ [s]; mode, swung: ω/2π [Hz]; backlash: σ gap [m]; fraction: ±1 tick; filter: θ [s];
            ///< cogging, uneven: 1/L [1/m]; drift: 0 of friction, 1 of a force
  double p2 =
      0.0;  ///< mode, swung: ζ; backlash: the share of its speed with which it comes back; filter: d [ticks]
};

class disturbance_columns {
 public:
  using column = motion_windows::column;
  /// A mode that the device is known to have: what moves it moves the mode, too.
  struct known_mode {
    double hz = 0.0, zeta = 0.0, g = 0.0;
  };

  /// The ticks and their windows are kept by reference.
  disturbance_columns(const std::vector<kept_tick>& ticks, const motion_windows& over)
      : ticks_(ticks), over_(over) {
    a.assign(ticks.size(), 0.0);
    for (const kept_tick& t : ticks) place.push_back(t.x);
    drive.assign(ticks.size(), 0.0);
  }

  // The rigid fit, of which whoever fits keeps these up to date.
  double mass = 0.0;            ///< m [kg]
  std::vector<double> drive{};  ///< the force that acts in each tick [N]
  std::vector<double> a{};      ///< the acceleration in each tick [m/s²]
  std::vector<double> place{};  ///< the position at the beginning of each tick [m]

  [[nodiscard]] Eigen::MatrixXd of(const shaped_disturbance& c,
                                   const std::optional<known_mode>& beside) const {
    if (c.is == column_of::mode) return ring(c.p1, c.p2, a);
    if (c.is == column_of::swung) return swung(c.p1, c.p2);
    if (c.is == column_of::backlash) return thrown(c.p1, c.p2);
    if (c.is == column_of::filter) {
      const auto y = filtered(c.p1, c.p2);
      return moved([&](std::size_t n) { return (y[n] - drive[n]) / mass; }, beside);
    }
    if (c.is == column_of::hand && c.p1 > 0.0) {
      const auto left = followed(c.p1);
      return moved([&](std::size_t n) { return left[n]; }, beside);
    }
    const bool two = c.is == column_of::cogging || c.is == column_of::uneven;
    Eigen::MatrixXd all(over_.rows(), two ? 2 : 1);
    for (Eigen::Index k = 0; k < all.cols(); ++k) {
      all.col(k) = moved([&](std::size_t n) { return acceleration(c, n, k); }, beside);
    }
    return all;
  }
  /// The acceleration of column k of a disturbance that is a force, in tick n.
  [[nodiscard]] double acceleration(const shaped_disturbance& c, std::size_t n,
                                    Eigen::Index k) const noexcept {
    const double middle = (place[n] + place[n + 1]) / 2.0;
    const double end = ticks_.back().time;
    switch (c.is) {
      case column_of::hand:
        return middle - over_.middle();
      case column_of::fraction: {
        const auto i = static_cast<std::ptrdiff_t>(n) - static_cast<std::ptrdiff_t>(c.p1);
        if (i < 0 || i >= static_cast<std::ptrdiff_t>(drive.size())) return 0.0;
        return (drive[static_cast<std::size_t>(i)] - drive[n]) / mass;
      }
      case column_of::cogging:
      case column_of::uneven: {
        // The mean over the way of a tick, which may be longer than a wave: sin u/u of what is in its middle.
        const double at = 2.0 * std::numbers::pi * c.p1 * middle,
                     u = std::numbers::pi * c.p1 * (place[n + 1] - place[n]);
        const double mean = std::abs(u) > 1e-3 ? std::sin(u) / u : 1.0;
        return mean * (k == 0 ? std::sin(at) : std::cos(at)) *
               (c.is == column_of::uneven ? over_.way(n) : 1.0);
      }
      case column_of::drift:
        return (c.p1 == 0.0 ? over_.way(n) : 1.0) * (ticks_[n].time / end - 0.5);
      default:
        return 0.0;
    }
  }
  /// The force commanded `late` ticks before tick n [N].
  [[nodiscard]] double command(std::size_t n, int late) const noexcept {
    const auto i = static_cast<std::ptrdiff_t>(n) - late;
    return i >= 0 && i < static_cast<std::ptrdiff_t>(ticks_.size())
               ? ticks_[static_cast<std::size_t>(i)].force
               : 0.0;
  }
  /// The commands behind a low-pass of `lag` [s], d ticks late, whole or not; the mean over each tick [N].
  [[nodiscard]] std::vector<double> filtered(double lag, double d) const {
    std::vector<double> y(ticks_.size());
    double f = 0.0;
    const int whole = static_cast<int>(d);
    const double part = d - whole;
    for (std::size_t n = 0; n < ticks_.size(); ++n) {
      const double h = (std::max)(ticks_[n].length, 1e-9);
      for (const bool before : {true, false}) {
        const double share = before ? part : 1.0 - part;
        const double now = command(n, before ? whole + 1 : whole), e = std::exp(-h * share / lag);
        y[n] += share * now + (f - now) * lag / h * (1.0 - e);
        f = now + (f - now) * e;
      }
    }
    return y;
  }

 private:
  /// What is left of the position behind a high-pass.
  [[nodiscard]] std::vector<double> followed(double tau) const {
    std::vector<double> left(ticks_.size());
    double mean = 0.0;
    for (std::size_t n = 0; n < ticks_.size(); ++n) {
      if (ticks_[n].first) mean = ticks_[n].x;
      mean += (ticks_[n].x - mean) * over_.tick() / (tau + over_.tick());
      left[n] = ticks_[n].x - mean;
    }
    return left;
  }
  /// What an acceleration moves: a force swings the mode that is known, too.
  template <class Value>
  [[nodiscard]] column moved(Value acceleration, const std::optional<known_mode>& beside) const {
    column c = over_.twice(acceleration);
    if (!beside) return c;
    std::vector<double> forced(ticks_.size());
    for (std::size_t n = 0; n + 1 < forced.size(); ++n) forced[n] = acceleration(n);
    c += beside->g * ring(beside->hz, beside->zeta, forced);
    return c;
  }
  /// A resonator that is driven by an acceleration, exact for one that is held for each tick.
  [[nodiscard]] column ring(double hz, double zeta, const std::vector<double>& by) const {
    std::vector<double> y(ticks_.size());
    const double w = 2.0 * std::numbers::pi * hz, wd = w * std::sqrt(1.0 - zeta * zeta);
    const double k = zeta * w / wd;
    double x = 0.0, v = 0.0, h = 0.0, C = 1.0, S = 0.0;
    for (std::size_t n = 0; n < ticks_.size(); ++n) {
      if (ticks_[n].first) x = v = 0.0;
      y[n] = x;
      if (ticks_[n].length != h) {
        h = ticks_[n].length;
        const double e = std::exp(-zeta * w * h);
        C = e * std::cos(wd * h);
        S = e * std::sin(wd * h);
      }
      const double s = by[n] / (w * w), off = x - s;
      x = off * (C + k * S) + v * S / wd + s;
      v = v * (C - k * S) - off * S * w * w / wd;
    }
    return over_.placed([&](std::size_t n) { return y[n]; });
  }
  /// Less than nothing where a body is that the axis swings by a spring, exact for an axis that goes at an even speed
  /// within a tick. Nothing of the rigid fit is in it.
  [[nodiscard]] column swung(double hz, double zeta) const {
    std::vector<double> y(ticks_.size());
    const double w = 2.0 * std::numbers::pi * hz, wd = w * std::sqrt(1.0 - zeta * zeta);
    const double k = zeta * w / wd;
    double off = 0.0, v = 0.0;
    for (std::size_t n = 0; n < ticks_.size(); ++n) {
      if (ticks_[n].first) off = v = 0.0;
      y[n] = -ticks_[n].x - off;
      const double h = ticks_[n].length;
      if (n + 1 == ticks_.size() || ticks_[n + 1].first || !(h > 0.0)) continue;
      const double e = std::exp(-zeta * w * h), C = e * std::cos(wd * h), S = e * std::sin(wd * h);
      const double speed = (ticks_[n + 1].x - ticks_[n].x) / h, u = v - speed, x = off;
      off = x * (C + k * S) + u * S / wd;
      v = u * (C - k * S) - x * S * w * w / wd + speed;
    }
    return over_.placed([&](std::size_t n) { return y[n]; });
  }
  /// The side of a gap on which a body is that the acceleration throws to and fro; it comes back with the
  /// share `back` of its speed.
  [[nodiscard]] column thrown(double gap, double back) const {
    std::vector<double> y(ticks_.size());
    double r = 0.0, v = 0.0;
    for (std::size_t n = 0; n < ticks_.size(); ++n) {
      if (ticks_[n].first) r = v = 0.0;
      y[n] = 2.0 * r / gap;
      constexpr int parts = 4;
      const double h = ticks_[n].length / parts;
      for (int i = 0; i < parts; ++i) {
        v += a[n] * h;
        r += v * h;
        if (std::abs(r) >= gap / 2.0) {
          r = std::copysign(gap / 2.0, r);
          v *= v * r > 0.0 ? -back : 1.0;
        }
      }
    }
    return over_.placed([&](std::size_t n) { return y[n]; });
  }

  const std::vector<kept_tick>& ticks_;
  const motion_windows& over_;
};

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
