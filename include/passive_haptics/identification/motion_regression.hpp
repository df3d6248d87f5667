// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Mass, damping, friction, constant load and latency of one axis, from positions and commands alone.
//
//     m ẍ = f(t − d) − b± ẋ − c sgn ẋ + w − k (x − x₀)
//
// Positions with steps cannot be differentiated twice. So the equation is multiplied by φ(u) = (1 − u²)²
// over a window of N ticks, u from −1 to 1, and summed; φ and its slope vanish at both ends, and summation by
// parts puts every derivative on φ (Shinbrot, 1957; modulating functions, Preisig and Rippin, 1993):
//
//     Σ φ Δv = (1/m) (Σ φ f h − b± Σ φ Δx − c Σ φ sgn h + w Σ φ h − k Σ φ x h)
//
// With this φ the left side is that of a least-squares parabola through the N + 1 positions. The tick lengths h
// [s] are the measured ones, so ticks may vary. The error of the steps is on the left alone, so ordinary least squares
// has no bias from it. Only windows count in which the device goes one way, faster than the Stribeck part of friction.
// The latency d [ticks] is the shift of the commands that explains the left side best. The deviation is that of the
// jackknife, which leaves out one of twelve stretches of time after the other (Miller, 1974) and needs no white errors.

#include <passive_haptics/base/kernels.hpp>
#include <passive_haptics/identification/trust.hpp>

#include <Eigen/Cholesky>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

/// The result of the regression. It does not count while `windows` is 0.
struct motion_found {
  estimate mass{};                    ///< m [kg]
  std::array<estimate, 2> damping{};  ///< b+ and b−, going forward and backward [N·s/m]
  estimate friction{};                ///< c, kinetic, the mean of both ways [N]
  estimate load{};                    ///< w, constant [N]
  estimate stiffness{};               ///< k of a spring that holds the device [N/m]
  int latency = 0;                    ///< d [ticks]
  estimate exactly{};                 ///< d with its fraction [ticks]
  double explained = 0.0;  ///< share of the changes of velocity that the equation explains, ≤ 1
  int windows = 0;         ///< windows that were booked
};

/// Call sample() and commanded() once a tick, and book() for each window that shall count. It needs no heap.
class motion_regression {
 public:
  static constexpr int longest_window = 96;  ///< [ticks]
  static constexpr int groups = 12;          ///< of the jackknife

  /// `elastic` [m] is the way after a turn that is left out, because friction is elastic there.
  explicit motion_regression(double elastic = 0.4e-3) noexcept : elastic_(elastic) {}

  /// Adds the position [m] at the end of a tick of that length [s].
  void sample(double position, double length) noexcept {
    ++newest_;
    at(newest_).position = position;
    at(newest_ - 1).length = length;
    if (kept_ < capacity) ++kept_;
  }
  /// Adds the force commanded for the tick that begins now [N].
  void commanded(double force) noexcept { at(newest_).command = force; }
  /// Adds a missing sample: no window spans it.
  void interrupt() noexcept { kept_ = 0; }
  /// Forgets all windows.
  void clear() noexcept {
    sums_.fill(table::Zero());
    windows_ = 0;
  }

  /// Books the window of the last `ticks` ticks in group `group`, and returns true, if in it the device went one
  /// way, in no quarter slower than `slowest` [m/s] by positions known to `step` [m], and had left the position
  /// `turn` [m] of its last turn by more than friction is elastic.
  bool book(int ticks, int group, double slowest, double step, double turn) noexcept {
    if (ticks < 6 || ticks > longest_window || kept_ < ticks + latencies + 1) return false;
    if (!(kernels::magnitude(at(newest_ - ticks).position - turn) > elastic_ + step)) return false;
    const int sign = direction(ticks, slowest, step);
    if (sign == 0) return false;
    double whole = 0.0;
    for (int j = newest_ - ticks; j < newest_; ++j) whole += at(j).length;
    row z = row::Zero();
    double t = 0.0;
    for (int j = newest_ - ticks + 1; j < newest_; ++j) {
      const tick& before = at(j - 1);
      const tick& now = at(j);
      t += before.length;
      const double u = 2.0 * t / whole - 1.0;
      const double phi = (1.0 - u * u) * (1.0 - u * u);
      const double next = at(j + 1).position;
      const double changed =
          (next - now.position) / now.length - (now.position - before.position) / before.length;
      const double lasted = (now.length + before.length) / 2.0;
      for (int d = 0; d < latencies; ++d) {
        z(d) +=
            phi * (now.length * at(j - d).command + before.length * at(j - 1 - d).command) / 2.0;
      }
      z(sign > 0 ? forward : backward) -= phi * (next - before.position) / 2.0;
      z(rubbed) -= phi * lasted * sign;
      z(loaded) += phi * lasted;
      z(sprung) -= phi * lasted * now.position;
      z(turned) += phi * changed;
    }
    z *= std::pow(static_cast<double>(ticks),
                  1.5);  // gives windows of all lengths equal variance
    sums_[static_cast<std::size_t>(group % groups)] += z * z.transpose();
    ++windows_;
    return true;
  }

  [[nodiscard]] motion_found conclude() const noexcept {
    motion_found found;
    table all = table::Zero();
    for (const table& one : sums_) all += one;
    double best = std::numeric_limits<double>::infinity();
    for (int d = 0; d < latencies; ++d) {
      solution s;
      if (!solve(all, d, s) || !(s.left < best)) continue;
      best = s.left;
      found.latency = d;
      found.explained = 1.0 - s.left / all(turned, turned);
    }
    if (!kernels::is_finite(best)) return found;
    found.windows = windows_;
    const int d = found.latency;
    solution whole;
    static_cast<void>(solve(all, d, whole));
    jackknife<7> of;
    of.whole = {whole.of[0], whole.of[1], whole.of[2],         whole.of[3],
                whole.of[4], whole.of[5], d + fraction(all, d)};
    for (const table& one : sums_) {
      if (!(one(turned, turned) > 0.0)) continue;
      const table rest = all - one;
      solution s;
      if (solve(rest, d, s)) {
        of.book({s.of[0], s.of[1], s.of[2], s.of[3], s.of[4], s.of[5], d + fraction(rest, d)});
      }
    }
    found.mass = of.estimated(0);
    found.damping = {of.estimated(1), of.estimated(2)};
    found.friction = of.estimated(3);
    found.load = of.estimated(4);
    found.stiffness = of.estimated(5);
    found.exactly = of.estimated(6);
    return found;
  }

  [[nodiscard]] int windows() const noexcept { return windows_; }

 private:
  static constexpr int capacity = 128;  // ticks kept, a power of two
  static constexpr int latencies = 9;   // tried: 0 to 8
  // The columns of a row are the commands 0 to 8 ticks late, followed by those below.
  static constexpr int forward = latencies, backward = forward + 1, rubbed = forward + 2,
                       loaded = forward + 3, sprung = forward + 4, turned = forward + 5,
                       columns = forward + 6;
  using row = Eigen::Matrix<double, columns, 1>;
  using table = Eigen::Matrix<double, columns, columns>;

  struct tick {
    double position = 0.0, length = 0.0, command = 0.0;
  };
  /// m, b+, b−, c, w, k, and the residual sum of squares.
  struct solution {
    std::array<double, 6> of{};
    double left = 0.0;
  };
  /// Estimates of N numbers, and their changes when one group after the other is left out.
  template <std::size_t N>
  struct jackknife {
    std::array<double, N> whole{}, sum{}, squares{};
    int count = 0;

    void book(const std::array<double, N>& without) noexcept {
      ++count;
      for (std::size_t i = 0; i < N; ++i) {
        const double off = without[i] - whole[i];
        sum[i] += off;
        squares[i] += off * off;
      }
    }
    [[nodiscard]] estimate estimated(std::size_t i) const noexcept {
      if (count < 4) return {whole[i]};
      const double spread = squares[i] - sum[i] * sum[i] / count;
      return {whole[i], std::sqrt(kernels::larger(spread, 0.0) * (count - 1) / count)};
    }
  };

  [[nodiscard]] tick& at(int i) noexcept { return ring_[static_cast<std::size_t>(i) % capacity]; }
  [[nodiscard]] const tick& at(int i) const noexcept {
    return ring_[static_cast<std::size_t>(i) % capacity];
  }

  /// ±1 if each quarter of the window goes that way faster than `slowest` [m/s]; 0 if not.
  [[nodiscard]] int direction(int ticks, double slowest, double step) const noexcept {
    const bool up = at(newest_).position > at(newest_ - ticks).position;
    const double sign = up ? 1.0 : -1.0;
    for (int part = 0; part < 4; ++part) {
      const int from = newest_ - ticks + part * ticks / 4;
      const int to = newest_ - ticks + (part + 1) * ticks / 4;
      double lasted = 0.0;
      for (int j = from; j < to; ++j) lasted += at(j).length;
      const double way = sign * (at(to).position - at(from).position);
      if (!(way > slowest * lasted + step)) return 0;
    }
    const int last = ticks / 8 > 2 ? ticks / 8 : 2;  // ticks at its end, where it may turn
    double lasted = 0.0;
    for (int j = newest_ - last; j < newest_; ++j) lasted += at(j).length;
    const double way = sign * (at(newest_).position - at(newest_ - last).position);
    if (!(way > slowest * lasted + step)) return 0;
    return up ? 1 : -1;
  }

  template <int Extra>
  using square = Eigen::Matrix<double, 6 + Extra, 6 + Extra>;

  /// Least squares by Eigen's LDLT of the scaled normal equations.
  template <int Extra>
  [[nodiscard]] static bool least_squares(
      const table& z, const std::array<int, static_cast<std::size_t>(6 + Extra)>& which,
      Eigen::Matrix<double, 6 + Extra, 1>& share) noexcept {
    constexpr int n = 6 + Extra;
    square<Extra> a;
    Eigen::Matrix<double, n, 1> r, scale;
    for (int i = 0; i < n; ++i) {
      const double own = z(which[static_cast<std::size_t>(i)], which[static_cast<std::size_t>(i)]);
      scale(i) = own > 0.0 ? 1.0 / std::sqrt(own) : 0.0;
    }
    for (int i = 0; i < n; ++i) {
      r(i) = z(which[static_cast<std::size_t>(i)], turned) * scale(i);
      for (int j = 0; j < n; ++j)
        a(i, j) = z(which[static_cast<std::size_t>(i)], which[static_cast<std::size_t>(j)]) *
                  scale(i) * scale(j);
      if (scale(i) == 0.0) a(i, i) = 1.0;
    }
    const Eigen::LDLT<square<Extra>> factors(a);
    if (factors.info() != Eigen::Success || !(factors.vectorD().minCoeff() > 1e-12)) return false;
    share = factors.solve(r).cwiseProduct(scale);
    return share.allFinite();
  }
  [[nodiscard]] static bool solve(const table& z, int d, solution& s) noexcept {
    const std::array<int, 6> which{d, forward, backward, rubbed, loaded, sprung};
    Eigen::Matrix<double, 6, 1> share;
    if (!(z(turned, turned) > 0.0) || !least_squares<0>(z, which, share)) return false;
    s.left = z(turned, turned);
    for (int i = 0; i < 6; ++i) s.left -= share(i) * z(which[static_cast<std::size_t>(i)], turned);
    if (!(share(0) > 0.0)) return false;
    s.of[0] = 1.0 / share(0);
    for (int i = 1; i < 6; ++i) s.of[static_cast<std::size_t>(i)] = share(i) / share(0);
    return true;
  }
  /// The share of the force that comes a tick later than d, or if < 0 a tick earlier.
  [[nodiscard]] static double fraction(const table& z, int d) noexcept {
    double most = 0.0;
    for (const int other : {d - 1, d + 1}) {
      if (other < 0 || other >= latencies) continue;
      const std::array<int, 7> which{d, forward, backward, rubbed, loaded, sprung, other};
      Eigen::Matrix<double, 7, 1> share;
      if (!least_squares<1>(z, which, share)) continue;
      const double part = share(6) / (share(0) + share(6));
      if (std::abs(part) > std::abs(most)) most = other > d ? part : -part;
    }
    return most;
  }

  double elastic_;
  std::array<tick, capacity> ring_{};
  std::array<table, groups> sums_ = zeros();
  int newest_ = capacity, kept_ = 0, windows_ = 0;

  [[nodiscard]] static std::array<table, groups> zeros() noexcept {
    std::array<table, groups> all;
    all.fill(table::Zero());
    return all;
  }
};

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
