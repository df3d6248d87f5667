// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Finds what a rigid device with one friction does not explain, and names it.
//
//     x = ∬ (f(t − d) − b ẋ − c sgn ẋ + w)/m  +  g · (column of a disturbance)           in windows of 64 ticks
//
// The constant and the slope of each window are free, so the error of x is the encoder's and white, and the beginning of
// a window does not matter. Each disturbance is a column, which is computed from a = (f − b ẋ − c sgn ẋ + w)/m of the rigid
// fit and has a parameter or two on a grid:
//
//     mode       y: ÿ + 2ζω ẏ + ω² y = a          g = (1 − σ)/σ, σ the share of the mass at the encoder    ω, ζ
//     backlash   side of the gap, −1 to 1: where a body is that is thrown to and fro between two stops
//                by a                             g = (1 − σ) gap/2                                       σ gap
//     fraction   ∬ (f(t − d ∓ T) − f(t − d))/m    g = the fraction                                        ∓
//     filter     ∬ (f behind a low-pass)/m − …    g = 1                                                   θ, d
//     cogging    ∬ sin 2πx/L, ∬ cos 2πx/L, the means over ticks   √(g₁² + g₂²) m = its amplitude           L
//     hand       ∬ x, or what is left of x behind a high-pass                  g = −k/m                    τ
//     drift      ∬ t sgn ẋ, ∬ t                                                g = ċ/m, ẇ/m
//
// The columns that a rigid device has are taken out of a column and of x first, so what is left gives the coefficient and
// the drop of the residual that the whole least squares would give (Frisch and Waugh, 1933). The covariance V is the one
// that lets errors within a sweep depend on each other (Liang and Zeger, Biometrika 1986), and gᵀ V⁻¹ g is χ² with the
// number of columns as degrees of freedom where there is nothing. The one that explains most is taken into the model if
// that would happen once in 2000 devices by chance, divided by the number of candidates, and if it is large enough to
// matter; then the search begins anew. What is left at the end, over the motion, is `unexplained`: a hand on a handle
// behind a spring is neither a column of a hand nor one of a mode.

#include <passive_haptics/identification/disturbance.hpp>
#include <passive_haptics/identification/motion_record.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

class disturbance_search {
 public:
  /// For a device of that latency [ticks] and step [m], swung by `force` [N] across ±`stroke` [m].
  disturbance_search(const std::vector<kept_tick>& ticks, int latency, double step, double stroke,
                     double force)
      : ticks_(ticks), latency_(latency), step_(step), stroke_(stroke), force_(force) {
    find_speeds();
    find_windows();
    a_.assign(ticks_.size(), 0.0);
    for (const kept_tick& t : ticks_) place_.push_back(t.x);
    if (rows_ >= 1000) fit_latency();
  }

  [[nodiscard]] disturbances_found conclude() {
    disturbances_found found;
    if (rows_ < 1000 || !(mass_ > 0.0)) return found;
    const double moved = placed([&](std::size_t n) { return ticks_[n].x; }).squaredNorm();
    const auto unexplained = [&] { return left_over() / (std::max)(moved, 1e-300); };
    explain();
    // What was taken first decides what else can be seen. Where too much is left, it may not have been that.
    explanation kept{model_, latency_};
    double least = unexplained();
    for (int again = 0; again < 3 && least > disturbances_found::too_much && first_; ++again) {
      barred_.push_back(*first_);
      model_.clear();
      fit_latency();
      explain();
      if (unexplained() >= least) continue;
      least = unexplained();
      kept = {model_, latency_};
    }
    barred_.clear();
    take_back(kept);
    found.mass = mass_;
    found.unexplained = unexplained();
    static_cast<void>(search(found.yields, false));  // a mode that was dropped is hidden
    for (const candidate& c : model_) name(c, found);
    // A force along the way may be any part of what nothing explains.
    if (found.unexplained > disturbances_found::too_much) found.of(disturbance::cogging) = {};
    return found;
  }

 private:
  using column = Eigen::VectorXd;
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
  struct candidate {
    column_of is = column_of::uneven;
    double p1 = 0.0, p2 = 0.0;
    Eigen::MatrixXd columns{};
    std::array<double, 2> g{};
    double drop = 0.0, wald = 0.0, deviation = 0.0;
  };
  struct window {
    std::size_t from = 0, ticks = 0;
  };
  static constexpr std::size_t longest = 64, shortest = 12, warm_up = 12;
  static constexpr double least_gap = 15e-6;  // σ gap that may be hidden [m]
  static constexpr double widest_gap = 1e-3;  // σ gap that is sought [m]
  static constexpr std::size_t kinds = 9;     // of columns
  static constexpr double most_swung = 45.0;  // [Hz]

  /// χ² that is exceeded by chance once in 2000 · `count`; exact for two degrees of freedom, near for one.
  [[nodiscard]] static double surprise(int count) noexcept {
    return 2.0 * std::log(2000.0 * count);
  }
  /// Of each kind the candidate that explains most and is large enough to matter, the best first, and what a mode or a
  /// gap that was not seen may yield: (1 − σ)/σ, which is g of a mode, and 2 g/(σ gap) of a gap.
  [[nodiscard]] std::vector<candidate> search(double& yields, bool refined) {
    std::vector<candidate> best(kinds);
    // A filter that is a little too late is worse than none, and the next one may be right.
    best[static_cast<std::size_t>(column_of::filter)].drop = -1e300;
    double hidden = 0.0;
    count_ = 0;
    whole_ = true;
    visit([&](candidate c) {
      ++count_;
      test(c);
      if (c.is == column_of::mode && c.p1 < 420.0)
        hidden = (std::max)(hidden, c.g[0] + 4.0 * c.deviation);
      if (c.is == column_of::backlash && c.p1 > least_gap)
        hidden = (std::max)(hidden, 2.0 * (c.g[0] + 4.0 * c.deviation) / c.p1);
      const bool barred =
          model_.empty() && std::find(barred_.begin(), barred_.end(), c.is) != barred_.end();
      candidate& of_kind = best[static_cast<std::size_t>(c.is)];
      if (!barred && counts(c) && c.drop > of_kind.drop) of_kind = std::move(c);
    });
    yields = hidden;
    for (candidate& c : best) {
      if (refined && c.columns.cols() > 0) refine(c);
    }
    whole_ = false;
    std::sort(best.begin(), best.end(),
              [](const candidate& a, const candidate& b) { return a.drop > b.drop; });
    return best;
  }
  /// Takes into the model what explains most, until nothing does, and drops what the others explain.
  void explain() {
    first_.reset();
    // What was dropped may have been in the way of something else.
    for (int again = 0; again < 2; ++again) {
      while (model_.size() < most && take_one()) continue;
      const std::size_t taken = model_.size();
      drop_what_others_explain();
      if (model_.size() == taken || model_.empty()) break;
    }
  }
  /// Takes into the model what explains most of what is left, if anything does.
  [[nodiscard]] bool take_one() {
    double yields = 0.0;
    // What explains most may still be chance where something smaller is none.
    for (candidate& best : search(yields, true)) {
      if (!(best.drop > 0.0)) break;
      if (!counts(best) || best.wald < surprise(count_)) continue;
      const explanation before{model_, latency_};
      const double left = y_.squaredNorm();
      const column_of is = best.is;
      model_.push_back(std::move(best));
      refit();
      if (is == column_of::swung) sharpen();
      if (y_.squaredNorm() < left) {
        if (!first_) first_ = is;
        return true;
      }
      take_back(before);  // it led the others astray
    }
    return false;
  }
  /// What the axis swings is found without a rigid fit, but at the price of the steps that it is moved by. With a fit
  /// that allows for it, the acceleration moves it without them: keeps what leaves less.
  void sharpen() {
    const explanation kept{model_, latency_};
    const double least = y_.squaredNorm();
    candidate& c = model_.back();
    const double root = std::sqrt(1.0 + c.g[0]);
    c = {.is = column_of::mode, .p1 = c.p1 * root, .p2 = (std::min)(c.p2 * root, 0.3)};
    c.columns = columns_of(c);
    refit();
    if (!(y_.squaredNorm() < least)) take_back(kept);
  }
  /// The most that the amplitude of a force along the way may be [N].
  [[nodiscard]] double largest_force(const candidate& c) const noexcept {
    return (std::hypot(c.g[0], c.g[1]) + 4.0 * c.deviation) * mass_;
  }
  /// Fits the parameters of each part of the model anew beside the others.
  void improve() {
    for (int again = 0; again < 2; ++again) {
      for (std::size_t i = 0; i < model_.size(); ++i) {
        project(i);
        candidate c{.is = model_[i].is, .p1 = model_[i].p1, .p2 = model_[i].p2};
        c.columns = columns_of(c);
        test(c);
        refine(c);
        model_[i] = std::move(c);
      }
      fit_latency();
    }
  }
  /// Of what delays or throws, which can look alike, drops what leaves little more if the others are fitted anew
  /// without it.
  void drop_what_others_become() {
    const auto alike = [](const candidate& c) {
      return c.is == column_of::mode || c.is == column_of::swung || c.is == column_of::backlash ||
             c.is == column_of::fraction || c.is == column_of::filter;
    };
    while (std::count_if(model_.begin(), model_.end(), alike) > 1) {
      const explanation all{model_, latency_};
      project(model_.size());
      const double beside = left_over();
      std::vector<candidate> fewer;
      double least = 0.3;
      for (std::size_t i = 0; i < all.model.size(); ++i) {
        if (!alike(all.model[i])) continue;
        model_ = all.model;
        model_.erase(model_.begin() + static_cast<std::ptrdiff_t>(i));
        latency_ = all.latency;
        refit();
        const double share = 1.0 - beside / (std::max)(left_over(), 1e-300);
        if (share >= least) continue;
        least = share;
        fewer = model_;
      }
      if (least == 0.3) return take_back(all);
      model_ = fewer;
      refit();
    }
  }
  /// Drops what does not count beside the others, the least sure first.
  void drop_what_others_explain() {
    drop_what_others_become();
    while (!model_.empty()) {
      const double beside = left_over();
      std::size_t worst = model_.size();
      double least = 1.0;
      for (std::size_t i = 0; i < model_.size(); ++i) {
        project(i);
        candidate& c = model_[i];
        c.columns = columns_of(c);
        test(c);
        const bool real = counts(c) && c.wald > surprise(count_);
        const double share = real ? c.drop / (c.drop + (std::max)(beside - chance(), 0.0)) : 0.0;
        if (share < least) {
          least = share;
          worst = i;
        }
      }
      project(model_.size());
      if (least > 0.3) break;
      model_.erase(model_.begin() + static_cast<std::ptrdiff_t>(worst));
      refit();
    }
  }
  /// Fits the latency and each part of another model anew.
  void refit() {
    fit_latency();
    improve();
  }
  /// A model that was fitted before.
  struct explanation {
    std::vector<candidate> model{};
    int latency = 0;
  };
  void take_back(const explanation& before) {
    model_ = before.model;
    latency_ = before.latency;
    fit();
  }
  /// The sum of squares that the model leaves beyond what the steps do.
  [[nodiscard]] double left_over() const { return (std::max)(y_.squaredNorm() - floor(), 0.0); }
  /// Two deviations of what the steps leave: the square of an error that is even within ±q/2 varies by 0.9 q²/12.
  [[nodiscard]] double chance() const noexcept {
    return 1.8 * floor() / std::sqrt(static_cast<double>(rows_));
  }
  /// The sum of squares that the steps of the position leave.
  [[nodiscard]] double floor() const noexcept {
    return static_cast<double>(rows_ - 2 * static_cast<Eigen::Index>(windows_.size())) * step_ *
           step_ / 12.0;
  }

  // Columns.
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
  /// The double integral of an acceleration that is held for each tick.
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
  /// The double integral of the speed, or of its size: a single one of the position.
  [[nodiscard]] column once(bool size) const {
    column c(rows_);
    Eigen::Index row = 0;
    for (const window& w : windows_) {
      const double sign = size && speed_[w.from] < 0.0 ? -1.0 : 1.0;
      double sum = 0.0;
      for (std::size_t i = w.from; i < w.from + w.ticks; ++i) {
        c(row++) = sign * sum;
        const double h = ticks_[i].length;
        sum +=
            h * ((ticks_[i].x + ticks_[i + 1].x) / 2.0 - ticks_[w.from].x - a_[i] * h * h / 12.0);
      }
    }
    straighten(c);
    return c;
  }
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
  [[nodiscard]] double command(std::size_t n, int late) const noexcept {
    const auto i = static_cast<std::ptrdiff_t>(n) - late;
    return i >= 0 && i < static_cast<std::ptrdiff_t>(ticks_.size())
               ? ticks_[static_cast<std::size_t>(i)].force
               : 0.0;
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
  /// The stretches in which the device goes one way, faster than the Stribeck part of friction, and has left the place
  /// where it turned by more than friction is elastic.
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

  // The rigid device.
  /// Fits with the latency, of three, that leaves least.
  void fit_latency() {
    if (has(column_of::filter)) return static_cast<void>(fit());
    int best = latency_;
    const int middle = latency_;
    double least = -1.0;
    for (int d = (std::max)(middle - 1, 0); d <= middle + 1; ++d) {
      latency_ = d;
      const double left = fit();
      if (least >= 0.0 && left >= least) continue;
      least = left;
      best = d;
    }
    latency_ = best;
    fit();
  }
  /// The columns of the rigid device and of the model, each of length one, but for part `skip` of the model.
  [[nodiscard]] Eigen::MatrixXd known(std::size_t skip, std::vector<double>& scale) {
    drive_.resize(ticks_.size());
    for (std::size_t n = 0; n < drive_.size(); ++n) drive_[n] = command(n, latency_);
    for (std::size_t i = 0; i < model_.size(); ++i) {
      if (model_[i].is == column_of::filter && i != skip) {
        drive_ = filtered(model_[i].p1, model_[i].p2);
      }
    }
    std::vector<column> all{twice([&](std::size_t n) { return drive_[n]; }),
                            twice([&](std::size_t n) { return way_[n]; }), once(false), once(true),
                            twice([](std::size_t) { return 1.0; })};
    for (std::size_t i = 0; i < model_.size(); ++i) {
      if (model_[i].is == column_of::filter || i == skip) continue;
      const Eigen::MatrixXd m = columns_of(model_[i]);
      for (Eigen::Index k = 0; k < m.cols(); ++k) all.push_back(m.col(k));
    }
    Eigen::MatrixXd A(rows_, static_cast<Eigen::Index>(all.size()));
    scale.clear();
    for (std::size_t i = 0; i < all.size(); ++i) {
      scale.push_back((std::max)(all[i].norm(), 1e-300));
      A.col(static_cast<Eigen::Index>(i)) = all[i] / scale.back();
    }
    return A;
  }
  /// What is left without part `skip` of the model, under the acceleration of the whole of it.
  double project(std::size_t skip) {
    std::vector<double> scale;
    y_ = placed([&](std::size_t n) { return ticks_[n].x; });
    basis_.resize(rows_, 0);
    take(known(skip, scale));
    return y_.squaredNorm();
  }
  /// The rigid device and what has been found of it; returns the residual.
  double fit() {
    std::vector<double> scale;
    for (int again = 0; again < 2; ++again) {
      const Eigen::MatrixXd A = known(model_.size(), scale);
      const column x = placed([&](std::size_t n) { return ticks_[n].x; });
      Eigen::MatrixXd normal = A.transpose() * A;
      normal.diagonal().array() += 1e-12;
      Eigen::VectorXd g = normal.ldlt().solve(A.transpose() * x);
      for (std::size_t i = 0; i < scale.size(); ++i) g(static_cast<Eigen::Index>(i)) /= scale[i];
      mass_ = 1.0 / g(0);
      friction_ = std::abs(g(1)) * mass_;
      for (std::size_t n = 0; n < a_.size(); ++n) {
        a_[n] = g(0) * drive_[n] + g(1) * way_[n] + g(2) * speed_[n] + g(3) * std::abs(speed_[n]) +
                g(4);
      }
      Eigen::Index i = 5;
      for (const candidate& c : model_) {
        if (c.is == column_of::filter) continue;
        for (Eigen::Index k = 0; k < c.columns.cols(); ++k, ++i) {
          if (c.is == column_of::mode || c.is == column_of::backlash || c.is == column_of::swung)
            continue;
          for (std::size_t n = 0; n + 1 < a_.size(); ++n) a_[n] += g(i) * acceleration(c, n, k);
        }
      }
    }
    const double left = project(model_.size());
    Eigen::Index row = 0;
    for (const window& w : windows_) {
      for (std::size_t n = w.from; n < w.from + w.ticks; ++n)
        place_[n] = ticks_[n].x - std::clamp(y_(row++), -step_, step_);
    }
    return left;
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
    for (std::size_t i = 0; i < windows_.size(); ++i) {
      const auto n = static_cast<Eigen::Index>(windows_[i].ticks);
      s += left.middleRows(row, n).transpose() * e.segment(row, n);
      row += n;
      if (i + 1 < windows_.size() && windows_[i + 1].from == windows_[i].from + windows_[i].ticks)
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
    for (std::size_t i = 0; i < windows_.size(); ++i) {
      const std::size_t from = windows_[i].from;
      const auto n = static_cast<Eigen::Index>(windows_[i].ticks);
      A += left.middleRows(row, n).transpose() * left.middleRows(row, n);
      r += left.middleRows(row, n).transpose() * y_.segment(row, n);
      row += n;
      const bool last = i + 1 == windows_.size();
      const std::size_t next = last ? from : windows_[i + 1].from;
      // All that is no crossing is one group.
      if (!last && ticks_[from].even == ticks_[next].even &&
          (!ticks_[from].even || speed_[from] * speed_[next] > 0.0))
        continue;
      apart += r.dot(A.ldlt().solve(r));
      ++groups;
      A.setZero();
      r.setZero();
    }
    const double freedom = 2.0 * (groups - 1);
    const double error = (std::max)(unexplained / static_cast<double>(rows_), step_ * step_ / 12.0);
    return apart - (freedom + 3.0 * std::sqrt(2.0 * freedom)) * error < 0.3 * drop;
  }
  /// True if it has the sign that it must have, and is large enough to matter.
  [[nodiscard]] bool counts(const candidate& c) const noexcept {
    const double g = c.g[0], amplitude = std::hypot(c.g[0], c.g[1]);
    switch (c.is) {
      case column_of::hand:
        return -g * mass_ * stroke_ > 0.02 * force_;
      case column_of::mode:
        return g > 0.05 && c.p1 < 480.0 && c.p2 < 0.2;
      case column_of::swung:
        return g > 0.05 && c.p2 < 0.2;
      case column_of::backlash:
        return g > 1e-6 && 2.0 * g + c.p1 > 20e-6 && 2.0 * g + c.p1 < stroke_ / 4.0;
      case column_of::fraction:
        return g > 0.08 && g < 0.92;
      case column_of::filter:
        return c.p1 > 0.15 * tick_;
      case column_of::cogging:
        return amplitude * mass_ > 0.02 * force_ && amplitude * mass_ < force_;
      case column_of::drift:
        return std::abs(g) * mass_ >
               (c.p1 == 0.0 ? (std::max)(0.1 * friction_, 0.005) : 0.02 * force_);
      case column_of::uneven:
        return true;
    }
    return false;
  }

  template <class See>
  void visit(See&& see) {
    const auto one = [&](column_of is, double p1, double p2) {
      if ((is == column_of::filter || is == column_of::backlash) && has(is)) return;
      if ((is == column_of::mode || is == column_of::swung) &&
          (has(column_of::mode) || has(column_of::swung)))
        return;
      candidate c{.is = is, .p1 = p1, .p2 = p2};
      c.columns = columns_of(c);
      see(std::move(c));
    };
    for (const double tau : {0.0, 0.02, 0.06, 0.2}) one(column_of::hand, tau, 0.0);
    for (double hz = 11.0; hz < 500.0; hz *= 1.1) {
      for (const double zeta : {0.12, 0.03}) one(column_of::mode, hz, zeta);
    }
    for (double hz = 3.0; hz < most_swung; hz *= 1.1) {
      for (const double zeta : {0.12, 0.03}) one(column_of::swung, hz, zeta);
    }
    for (double gap = 5e-6; gap < widest_gap; gap *= 1.5) {
      for (const double back : {0.0, 0.5}) one(column_of::backlash, gap, back);
    }
    for (const double by : {-1.0, 1.0}) {
      if (latency_ + by >= 0.0) one(column_of::fraction, by, 0.0);
    }
    for (double lag = 0.3; lag < 6.5; lag *= 1.25) {
      for (double d = 0.0; d <= latency_; d += 0.5) one(column_of::filter, lag * tick_, d);
    }
    for (double k = 1.0 / (2.0 * stroke_); k < 5e3; k += 1.0 / (4.0 * stroke_)) {
      one(column_of::cogging, k, 0.0);
      one(column_of::uneven, k, 0.0);
    }
    one(column_of::drift, 0.0, 0.0);
    one(column_of::drift, 1.0, 0.0);
  }
  [[nodiscard]] bool has(column_of is) const noexcept {
    for (const candidate& c : model_) {
      if (c.is == is) return true;
    }
    return false;
  }
  /// Improves the two numbers of a candidate that are not linear, by steps that halve where they do not help.
  void refine(candidate& best) {
    double first = 0.05, second = 0.5;
    switch (best.is) {
      case column_of::mode:
      case column_of::swung:
        break;
      case column_of::backlash:
        first = 0.2;
        break;
      case column_of::filter:
        break;
      case column_of::cogging:
      case column_of::uneven:
        first = 0.25 / (4.0 * stroke_) / best.p1;
        second = 0.0;
        break;
      default:
        return;
    }
    for (int i = 0; i < 12; ++i) {
      bool better = false;
      for (int k = 0; k < 4; ++k) {
        candidate c{.is = best.is, .p1 = best.p1, .p2 = best.p2};
        if (k == 0) c.p1 *= 1.0 + first;
        if (k == 1) c.p1 /= 1.0 + first;
        if (k >= 2 && c.is == column_of::filter) {
          // What is late by more is filtered by less: both together move along the valley.
          c.p2 = (std::max)(c.p2 + (k == 2 ? second : -second), 0.0);
          c.p1 = (std::max)(c.p1 + (best.p2 - c.p2) * tick_, 0.05 * tick_);
        } else if (k >= 2) {
          c.p2 *= k == 2 ? 1.0 + second : 1.0 / (1.0 + second);
        }
        if (k >= 2 && second == 0.0) continue;
        if (best.is == column_of::mode) {
          c.p1 = std::clamp(c.p1, 5.0, 500.0);
          c.p2 = std::clamp(c.p2, 0.002, 0.3);
        } else if (second == 0.0) {
          c.p1 = (std::max)(c.p1, 1.0 / (2.0 * stroke_));
        } else if (best.is == column_of::swung) {
          c.p1 = std::clamp(c.p1, 2.0, most_swung);
          c.p2 = std::clamp(c.p2, 0.002, 0.3);
        } else if (best.is == column_of::backlash) {
          c.p1 = (std::min)(c.p1, widest_gap);
          c.p2 = (std::min)(c.p2, 0.9);
        }
        c.columns = columns_of(c);
        test(c);
        if (c.g[0] * best.g[0] > 0.0 && c.drop > best.drop) {
          best = std::move(c);
          better = true;
        }
      }
      if (better) continue;
      first /= 2.0;
      second /= 2.0;
    }
  }
  void name(const candidate& c, disturbances_found& found) const noexcept {
    if (c.is == column_of::uneven) {
      found.ripple += largest_force(c);
      return;
    }
    const bool swings = c.is == column_of::swung;
    suspicion& s = found.all[static_cast<std::size_t>(swings ? column_of::mode : c.is)];
    if (s.found) return;
    // Beside a gap that is surer, a mode is that of its stops.
    s.found = c.is != column_of::mode ||
              std::none_of(model_.begin(), model_.end(), [&](const candidate& m) {
                return m.is == column_of::backlash && m.wald > c.wald;
              });
    s.sure = std::sqrt(c.wald);
    switch (c.is) {
      case column_of::hand:
        s.size = -c.g[0] * mass_;
        break;
      case column_of::mode:
        s.size = c.p1;
        s.where = 1.0 / (1.0 + c.g[0]);
        found.yields = (std::max)(found.yields, c.g[0] + 4.0 * c.deviation);
        break;
      case column_of::swung:
        s.size = c.p1 * std::sqrt(1.0 + c.g[0]);
        s.where = 1.0 / (1.0 + c.g[0]);
        found.mass *= 1.0 + c.g[0];
        found.yields = (std::max)(found.yields, c.g[0] + 4.0 * c.deviation);
        break;
      case column_of::backlash:
        s.size = 2.0 * c.g[0] + c.p1;
        break;
      case column_of::fraction:
        s.size = latency_ + c.p1 * c.g[0];
        break;
      case column_of::filter:
        s.size = c.p1;
        break;
      case column_of::cogging:
        s.size = std::hypot(c.g[0], c.g[1]) * mass_;
        s.where = 1.0 / c.p1;
        break;
      case column_of::drift:
        s.size = c.g[0] * mass_ / force_;
        break;
      case column_of::uneven:
        break;
    }
  }

  [[nodiscard]] Eigen::MatrixXd columns_of(const candidate& c) const {
    if (c.is == column_of::mode) return ring(c.p1, c.p2, a_);
    if (c.is == column_of::swung) return swung(c.p1, c.p2);
    if (c.is == column_of::backlash) return thrown(c.p1, c.p2);
    if (c.is == column_of::filter) {
      const auto y = filtered(c.p1, c.p2);
      return moved([&](std::size_t n) { return (y[n] - drive_[n]) / mass_; });
    }
    if (c.is == column_of::hand && c.p1 > 0.0) {
      const auto left = followed(c.p1);
      return moved([&](std::size_t n) { return left[n]; });
    }
    const bool two = c.is == column_of::cogging || c.is == column_of::uneven;
    Eigen::MatrixXd all(rows_, two ? 2 : 1);
    for (Eigen::Index k = 0; k < all.cols(); ++k) {
      all.col(k) = moved([&](std::size_t n) { return acceleration(c, n, k); });
    }
    return all;
  }
  /// The acceleration of column k of a disturbance that is a force, in tick n.
  [[nodiscard]] double acceleration(const candidate& c, std::size_t n,
                                    Eigen::Index k) const noexcept {
    const double middle = (place_[n] + place_[n + 1]) / 2.0;
    const double end = ticks_.back().time;
    switch (c.is) {
      case column_of::hand:
        return middle - middle_;
      case column_of::fraction: {
        const auto i = static_cast<std::ptrdiff_t>(n) - static_cast<std::ptrdiff_t>(c.p1);
        if (i < 0 || i >= static_cast<std::ptrdiff_t>(drive_.size())) return 0.0;
        return (drive_[static_cast<std::size_t>(i)] - drive_[n]) / mass_;
      }
      case column_of::cogging:
      case column_of::uneven: {
        // The mean over the way of a tick, which may be longer than a wave: sin u/u of what is in its middle.
        const double at = 2.0 * std::numbers::pi * c.p1 * middle,
                     u = std::numbers::pi * c.p1 * (place_[n + 1] - place_[n]);
        const double mean = std::abs(u) > 1e-3 ? std::sin(u) / u : 1.0;
        return mean * (k == 0 ? std::sin(at) : std::cos(at)) *
               (c.is == column_of::uneven ? way_[n] : 1.0);
      }
      case column_of::drift:
        return (c.p1 == 0.0 ? way_[n] : 1.0) * (ticks_[n].time / end - 0.5);
      default:
        return 0.0;
    }
  }
  [[nodiscard]] std::vector<double> followed(double tau) const {
    std::vector<double> left(ticks_.size());
    double mean = 0.0;
    for (std::size_t n = 0; n < ticks_.size(); ++n) {
      if (ticks_[n].first) mean = ticks_[n].x;
      mean += (ticks_[n].x - mean) * tick_ / (tau + tick_);
      left[n] = ticks_[n].x - mean;
    }
    return left;
  }
  /// The commands behind a low-pass, d ticks late, whole or not; the mean over each tick.
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
  /// What an acceleration moves: a force that is not yet in the model swings the mode that is, too.
  template <class Value>
  [[nodiscard]] column moved(Value acceleration) const {
    column c = twice(acceleration);
    if (!whole_) return c;
    for (const candidate& m : model_) {
      if (m.is != column_of::mode) continue;
      std::vector<double> a(ticks_.size());
      for (std::size_t n = 0; n + 1 < a.size(); ++n) a[n] = acceleration(n);
      c += m.g[0] * ring(m.p1, m.p2, a);
    }
    return c;
  }
  /// A resonator that is driven by an acceleration, exact for one that is held for each tick.
  [[nodiscard]] column ring(double hz, double zeta, const std::vector<double>& a) const {
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
      const double s = a[n] / (w * w), off = x - s;
      x = off * (C + k * S) + v * S / wd + s;
      v = v * (C - k * S) - off * S * w * w / wd;
    }
    return placed([&](std::size_t n) { return y[n]; });
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
    return placed([&](std::size_t n) { return y[n]; });
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
        v += a_[n] * h;
        r += v * h;
        if (std::abs(r) >= gap / 2.0) {
          r = std::copysign(gap / 2.0, r);
          v *= v * r > 0.0 ? -back : 1.0;
        }
      }
    }
    return placed([&](std::size_t n) { return y[n]; });
  }
  const std::vector<kept_tick>& ticks_;
  int latency_;
  double step_, stroke_, force_;
  double tick_ = 0.0, mass_ = 0.0, middle_ = 0.0;
  static constexpr std::size_t most = 7;  ///< parts of the model besides the rigid device
  std::vector<window> windows_{};
  std::vector<candidate> model_{};
  std::optional<column_of> first_{};  ///< what the model began with
  std::vector<column_of> barred_{};   ///< what it may not begin with
  std::vector<double> drive_{};       ///< the force that acts in each tick [N]
  int count_ = 1;                     ///< candidates
  bool whole_ = false;  ///< columns of forces include what the mode of the model makes of them
  double friction_ = 0.0;
  Eigen::Index rows_ = 0;
  std::vector<double> speed_{}, way_{}, a_{};
  std::vector<double> place_{};  ///< where it is [m]: what the model says, within a step
  column y_{};                   ///< what the model leaves
  Eigen::MatrixXd basis_{};      ///< the columns of the model, orthonormal
};

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
