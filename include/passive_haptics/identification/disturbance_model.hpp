// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A rigid device with one friction, and the disturbances that have been taken for true: the least squares of a motion.
//
//     x = ∬ (f(t − d) − b ẋ − c sgn ẋ + w)/m  +  Σ g · (column of a disturbance)         in windows of 64 ticks
//
// A column that is to be tried is freed of those that the model has, and so is x, so what is left gives the coefficient
// and the drop of the residual that the whole least squares would give (Frisch and Waugh, 1933). The covariance V is
// the one that lets errors within a sweep depend on each other (Liang and Zeger, Biometrika 1986), and gᵀ V⁻¹ g is χ²
// with the number of columns as degrees of freedom where there is nothing.

#include <passive_haptics/identification/disturbance_columns.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

class disturbance_model {
 public:
  using column = motion_windows::column;
  struct candidate : shaped_disturbance {
    Eigen::MatrixXd columns{};
    std::array<double, 2> g{};  ///< the coefficients
    double drop = 0.0;          ///< of the sum of squares [m²]
    double wald = 0.0;          ///< gᵀ V⁻¹ g
    double deviation = 0.0;     ///< no less than that of an amplitude
  };
  /// All that was fitted.
  struct explanation {
    std::vector<candidate> parts{};
    int latency = 0;
  };

  std::vector<candidate> parts{};  ///< the disturbances
  int latency;                     ///< d [ticks]
  bool whole = false;  ///< columns of forces include what the mode of the model makes of them

  /// For a device of that latency [ticks] and step [m]. The ticks are kept by reference.
  disturbance_model(const std::vector<kept_tick>& ticks, int late, double step)
      : latency(late), ticks_(ticks), step_(step), over_(ticks, step), columns_(ticks, over_) {}
  disturbance_model(const disturbance_model&) = delete;
  disturbance_model& operator=(const disturbance_model&) = delete;

  [[nodiscard]] const motion_windows& windows() const noexcept { return over_; }
  [[nodiscard]] double mass() const noexcept { return columns_.mass; }  ///< [kg]
  [[nodiscard]] double friction() const noexcept { return friction_; }  ///< [N]
  /// The sum of squares of the motion [m²].
  [[nodiscard]] double moved() const { return positions().squaredNorm(); }
  /// The sum of squares that the model leaves of it [m²].
  [[nodiscard]] double left() const { return y_.squaredNorm(); }
  /// The sum of squares that the model leaves beyond what the steps do [m²].
  [[nodiscard]] double left_over() const { return (std::max)(left() - floor(), 0.0); }
  /// Two deviations of what the steps leave: the square of an error that is even within ±q/2 varies by 0.9 q²/12.
  [[nodiscard]] double chance() const noexcept {
    return 1.8 * floor() / std::sqrt(static_cast<double>(over_.rows()));
  }
  [[nodiscard]] bool has(column_of is) const noexcept {
    for (const candidate& c : parts) {
      if (c.is == is) return true;
    }
    return false;
  }
  [[nodiscard]] explanation now() const { return {parts, latency}; }
  /// Fits with the latency, of three, that leaves least.
  void fit_latency() {
    if (has(column_of::filter)) return static_cast<void>(fit());
    int best = latency;
    const int middle = latency;
    double least = -1.0;
    for (int d = (std::max)(middle - 1, 0); d <= middle + 1; ++d) {
      latency = d;
      const double left = fit();
      if (least >= 0.0 && left >= least) continue;
      least = left;
      best = d;
    }
    latency = best;
    fit();
  }
  void take_back(const explanation& before) {
    parts = before.parts;
    latency = before.latency;
    fit();
  }
  /// Leaves part `skip` out of the model, under the acceleration of the whole of it.
  void project(std::size_t skip) {
    std::vector<double> scale;
    y_ = positions();
    basis_.resize(over_.rows(), 0);
    take(known(skip, scale));
  }
  /// A disturbance beside the model, from which project() has left out a part like it.
  [[nodiscard]] candidate tried(const shaped_disturbance& shape) const {
    candidate c{shape};
    c.columns = columns_of(c);
    test(c);
    return c;
  }

 private:
  /// What a disturbance moves, with the mode that the model has if `whole`.
  [[nodiscard]] Eigen::MatrixXd columns_of(const shaped_disturbance& c) const {
    std::optional<disturbance_columns::known_mode> beside;
    for (const candidate& m : parts) {
      if (whole && m.is == column_of::mode) beside = {m.p1, m.p2, m.g[0]};
    }
    return columns_.of(c, beside);
  }
  /// The rigid device and what has been found of it; returns the residual.
  double fit() {
    std::vector<double> scale;
    for (int again = 0; again < 2; ++again) {
      const Eigen::MatrixXd A = known(parts.size(), scale);
      const column x = positions();
      Eigen::MatrixXd normal = A.transpose() * A;
      normal.diagonal().array() += 1e-12;
      Eigen::VectorXd g = normal.ldlt().solve(A.transpose() * x);
      for (std::size_t i = 0; i < scale.size(); ++i) g(static_cast<Eigen::Index>(i)) /= scale[i];
      columns_.mass = 1.0 / g(0);
      friction_ = std::abs(g(1)) * columns_.mass;
      for (std::size_t n = 0; n < columns_.a.size(); ++n) {
        columns_.a[n] = g(0) * columns_.drive[n] + g(1) * over_.way(n) + g(2) * over_.speed(n) +
                        g(3) * std::abs(over_.speed(n)) + g(4);
      }
      Eigen::Index i = 5;
      for (const candidate& c : parts) {
        if (c.is == column_of::filter) continue;
        for (Eigen::Index k = 0; k < c.columns.cols(); ++k, ++i) {
          if (c.is == column_of::mode || c.is == column_of::backlash || c.is == column_of::swung)
            continue;
          for (std::size_t n = 0; n + 1 < columns_.a.size(); ++n)
            columns_.a[n] += g(i) * columns_.acceleration(c, n, k);
        }
      }
    }
    project(parts.size());
    Eigen::Index row = 0;
    for (const motion_windows::window& w : over_.all()) {
      for (std::size_t n = w.from; n < w.from + w.ticks; ++n)
        columns_.place[n] = ticks_[n].x - std::clamp(y_(row++), -step_, step_);
    }
    return left();
  }
  void test(candidate& c) const {
    const Eigen::MatrixXd left = c.columns - basis_ * (basis_.transpose() * c.columns);
    const Eigen::Index k = left.cols();
    const Eigen::MatrixXd A = left.transpose() * left;
    const Eigen::VectorXd r = left.transpose() * y_;
    for (Eigen::Index i = 0; i < k; ++i) {
      if (!(A(i, i) > 1e-12 * c.columns.col(i).squaredNorm())) return;
    }
    const auto factors = A.ldlt();
    const Eigen::VectorXd g = factors.solve(r);
    c.drop = g.dot(r);
    if (c.is == column_of::filter)
      c.drop = A(0, 0) * (2.0 * g(0) - 1.0);  // the whole force is filtered
    const column e = y_ - left * g;
    Eigen::MatrixXd meat = Eigen::MatrixXd::Zero(k, k);
    Eigen::Index row = 0;
    Eigen::VectorXd s = Eigen::VectorXd::Zero(k);  // of the windows that follow on each other
    const auto& windows = over_.all();
    for (std::size_t i = 0; i < windows.size(); ++i) {
      const auto n = static_cast<Eigen::Index>(windows[i].ticks);
      s += left.middleRows(row, n).transpose() * e.segment(row, n);
      row += n;
      if (i + 1 < windows.size() && windows[i + 1].from == windows[i].from + windows[i].ticks)
        continue;
      meat += s * s.transpose();
      s.setZero();
    }
    const Eigen::MatrixXd inverse = factors.solve(Eigen::MatrixXd::Identity(k, k));
    const Eigen::MatrixXd V = inverse * meat * inverse;
    // Few windows underestimate V, the more where steps come in time with the ticks: what explains less than the steps
    // alone would by chance is nothing.
    c.wald = g.dot(V.ldlt().solve(g));
    if (step_ > 0.0) c.wald = (std::min)(c.wald, 12.0 * c.drop / (step_ * step_));
    c.deviation = std::sqrt((std::max)(V.trace(), 0.0));  // no less than that of an amplitude
    for (Eigen::Index i = 0; i < k; ++i) c.g[static_cast<std::size_t>(i)] = g(i);
    if (c.is == column_of::cogging && !crossings_agree(left, c.drop, e.squaredNorm())) c.wald = 0.0;
  }
  /// The sum of squares that the steps of the position leave.
  [[nodiscard]] double floor() const noexcept {
    return static_cast<double>(over_.rows() - 2 * static_cast<Eigen::Index>(over_.all().size())) *
           step_ * step_ / 12.0;
  }
  [[nodiscard]] column positions() const {
    return over_.placed([&](std::size_t n) { return ticks_[n].x; });
  }
  /// The columns of the rigid device and of the model, each of length one, but for part `skip` of the model.
  [[nodiscard]] Eigen::MatrixXd known(std::size_t skip, std::vector<double>& scale) {
    for (std::size_t n = 0; n < columns_.drive.size(); ++n)
      columns_.drive[n] = columns_.command(n, latency);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (parts[i].is == column_of::filter && i != skip) {
        columns_.drive = columns_.filtered(parts[i].p1, parts[i].p2);
      }
    }
    std::vector<column> all{over_.twice([&](std::size_t n) { return columns_.drive[n]; }),
                            over_.twice([&](std::size_t n) { return over_.way(n); }),
                            over_.once(false, columns_.a), over_.once(true, columns_.a),
                            over_.twice([](std::size_t) { return 1.0; })};
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (parts[i].is == column_of::filter || i == skip) continue;
      const Eigen::MatrixXd m = columns_of(parts[i]);
      for (Eigen::Index k = 0; k < m.cols(); ++k) all.push_back(m.col(k));
    }
    Eigen::MatrixXd A(over_.rows(), static_cast<Eigen::Index>(all.size()));
    scale.clear();
    for (std::size_t i = 0; i < all.size(); ++i) {
      scale.push_back((std::max)(all[i].norm(), 1e-300));
      A.col(static_cast<Eigen::Index>(i)) = all[i] / scale.back();
    }
    return A;
  }
  /// Takes columns into the model: out of the residual, and out of all columns to come.
  void take(const Eigen::MatrixXd& columns) {
    for (Eigen::Index i = 0; i < columns.cols(); ++i) {
      column c = columns.col(i);
      const double size = c.norm();
      for (int again = 0; again < 2; ++again) c -= basis_ * (basis_.transpose() * c);
      if (!(c.norm() > 1e-9 * size)) continue;
      c.normalize();
      basis_.conservativeResize(Eigen::NoChange, basis_.cols() + 1);
      basis_.col(basis_.cols() - 1) = c;
      y_ -= c * c.dot(y_);
    }
  }

  /// True if every crossing shows the same wave: by waves of their own the crossings explain less than 0.3 more than by
  /// a common one, beside what chance does, which is χ² with two degrees of freedom for each of them, within three
  /// deviations. What the steps or another disturbance pretend has another phase each time.
  [[nodiscard]] bool crossings_agree(const Eigen::MatrixXd& left, double drop,
                                     double unexplained) const {
    Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
    Eigen::Vector2d r = Eigen::Vector2d::Zero();
    double apart = -drop;
    int groups = 0;
    Eigen::Index row = 0;
    const auto& windows = over_.all();
    for (std::size_t i = 0; i < windows.size(); ++i) {
      const std::size_t from = windows[i].from;
      const auto n = static_cast<Eigen::Index>(windows[i].ticks);
      A += left.middleRows(row, n).transpose() * left.middleRows(row, n);
      r += left.middleRows(row, n).transpose() * y_.segment(row, n);
      row += n;
      const bool last = i + 1 == windows.size();
      const std::size_t next = last ? from : windows[i + 1].from;
      // All that is no crossing is one group.
      if (!last && ticks_[from].even == ticks_[next].even &&
          (!ticks_[from].even || over_.speed(from) * over_.speed(next) > 0.0))
        continue;
      apart += r.dot(A.ldlt().solve(r));
      ++groups;
      A.setZero();
      r.setZero();
    }
    const double freedom = 2.0 * (groups - 1);
    const double error =
        (std::max)(unexplained / static_cast<double>(over_.rows()), step_ * step_ / 12.0);
    return apart - (freedom + 3.0 * std::sqrt(2.0 * freedom)) * error < 0.3 * drop;
  }

  const std::vector<kept_tick>& ticks_;
  double step_;
  motion_windows over_;
  disturbance_columns columns_;
  double friction_ = 0.0;
  column y_{};               ///< what the model leaves
  Eigen::MatrixXd basis_{};  ///< the columns of the model, orthonormal
};

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
