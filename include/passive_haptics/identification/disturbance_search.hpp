// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Finds what a rigid device with one friction does not explain, and names it.
//
// Every disturbance of disturbance_columns.hpp is tried beside the model (disturbance_model.hpp), its one or two shapes
// on a grid. The one that explains most is taken into the model if that would happen once in 2000 devices by chance,
// divided by the number of candidates, and if it is large enough to matter; then the search begins anew. What the others
// explain is dropped at the end. What is left then, over the motion, is `unexplained`: a hand on a handle behind a
// spring is neither a column of a hand nor one of a mode.

#include <passive_haptics/identification/disturbance.hpp>
#include <passive_haptics/identification/disturbance_model.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
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
      : model_(ticks, latency, step), stroke_(stroke), force_(force) {
    if (enough()) model_.fit_latency();
  }

  [[nodiscard]] disturbances_found conclude() {
    disturbances_found found;
    if (!enough() || !(model_.mass() > 0.0)) return found;
    const double moved = (std::max)(model_.moved(), 1e-300);
    const auto unexplained = [&] { return model_.left_over() / moved; };
    explain();
    // What was taken first decides what else can be seen. Where too much is left, it may not have been that.
    explanation kept = model_.now();
    double least = unexplained();
    for (int again = 0; again < 3 && least > disturbances_found::too_much && first_; ++again) {
      barred_.push_back(*first_);
      model_.parts.clear();
      model_.fit_latency();
      explain();
      if (unexplained() >= least) continue;
      least = unexplained();
      kept = model_.now();
    }
    barred_.clear();
    model_.take_back(kept);
    found.mass = model_.mass();
    found.unexplained = unexplained();
    static_cast<void>(search(found.yields, false));  // a mode that was dropped is hidden
    for (const candidate& c : model_.parts) name(c, found);
    // A force along the way may be any part of what nothing explains.
    if (found.unexplained > disturbances_found::too_much) found.of(disturbance::cogging) = {};
    return found;
  }

 private:
  using candidate = disturbance_model::candidate;
  using explanation = disturbance_model::explanation;

  static constexpr double least_gap = 15e-6;  // σ gap that may be hidden [m]
  static constexpr double widest_gap = 1e-3;  // σ gap that is sought [m]
  static constexpr std::size_t kinds = 9;     // of columns
  static constexpr double most_swung = 45.0;  // [Hz]

  [[nodiscard]] bool enough() const noexcept { return model_.windows().rows() >= 1000; }
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
    model_.whole = true;
    visit([&](candidate c) {
      ++count_;
      if (c.is == column_of::mode && c.p1 < 420.0)
        hidden = (std::max)(hidden, c.g[0] + 4.0 * c.deviation);
      if (c.is == column_of::backlash && c.p1 > least_gap)
        hidden = (std::max)(hidden, 2.0 * (c.g[0] + 4.0 * c.deviation) / c.p1);
      const bool barred =
          model_.parts.empty() && std::find(barred_.begin(), barred_.end(), c.is) != barred_.end();
      candidate& of_kind = best[static_cast<std::size_t>(c.is)];
      if (!barred && counts(c) && c.drop > of_kind.drop) of_kind = std::move(c);
    });
    yields = hidden;
    for (candidate& c : best) {
      if (refined && c.columns.cols() > 0) refine(c);
    }
    model_.whole = false;
    std::sort(best.begin(), best.end(),
              [](const candidate& a, const candidate& b) { return a.drop > b.drop; });
    return best;
  }
  /// Takes into the model what explains most, until nothing does, and drops what the others explain.
  void explain() {
    first_.reset();
    // What was dropped may have been in the way of something else.
    for (int again = 0; again < 2; ++again) {
      while (model_.parts.size() < most && take_one()) continue;
      const std::size_t taken = model_.parts.size();
      drop_what_others_explain();
      if (model_.parts.size() == taken || model_.parts.empty()) break;
    }
  }
  /// Takes into the model what explains most of what is left, if anything does.
  [[nodiscard]] bool take_one() {
    double yields = 0.0;
    // What explains most may still be chance where something smaller is none.
    for (candidate& best : search(yields, true)) {
      if (!(best.drop > 0.0)) break;
      if (!counts(best) || best.wald < surprise(count_)) continue;
      const explanation before = model_.now();
      const double left = model_.left();
      const column_of is = best.is;
      model_.parts.push_back(std::move(best));
      refit();
      if (is == column_of::swung) sharpen();
      if (model_.left() < left) {
        if (!first_) first_ = is;
        return true;
      }
      model_.take_back(before);  // it led the others astray
    }
    return false;
  }
  /// What the axis swings is found without a rigid fit, but at the price of the steps that it is moved by. With a fit
  /// that allows for it, the acceleration moves it without them: keeps what leaves less.
  void sharpen() {
    const explanation kept = model_.now();
    const double least = model_.left();
    candidate& c = model_.parts.back();
    const double root = std::sqrt(1.0 + c.g[0]);
    c = model_.tried(
        {.is = column_of::mode, .p1 = c.p1 * root, .p2 = (std::min)(c.p2 * root, 0.3)});
    refit();
    if (!(model_.left() < least)) model_.take_back(kept);
  }
  /// The most that the amplitude of a force along the way may be [N].
  [[nodiscard]] double largest_force(const candidate& c) const noexcept {
    return (std::hypot(c.g[0], c.g[1]) + 4.0 * c.deviation) * model_.mass();
  }
  /// Fits the parameters of each part of the model anew beside the others.
  void improve() {
    for (int again = 0; again < 2; ++again) {
      for (std::size_t i = 0; i < model_.parts.size(); ++i) {
        model_.project(i);
        candidate c = model_.tried(model_.parts[i]);
        refine(c);
        model_.parts[i] = std::move(c);
      }
      model_.fit_latency();
    }
  }
  /// Of what delays or throws, which can look alike, drops what leaves little more if the others are fitted anew
  /// without it.
  void drop_what_others_become() {
    const auto alike = [](const candidate& c) {
      return c.is == column_of::mode || c.is == column_of::swung || c.is == column_of::backlash ||
             c.is == column_of::fraction || c.is == column_of::filter;
    };
    while (std::count_if(model_.parts.begin(), model_.parts.end(), alike) > 1) {
      const explanation all = model_.now();
      model_.project(model_.parts.size());
      const double beside = model_.left_over();
      std::vector<candidate> fewer;
      double least = 0.3;
      for (std::size_t i = 0; i < all.parts.size(); ++i) {
        if (!alike(all.parts[i])) continue;
        model_.parts = all.parts;
        model_.parts.erase(model_.parts.begin() + static_cast<std::ptrdiff_t>(i));
        model_.latency = all.latency;
        refit();
        const double share = 1.0 - beside / (std::max)(model_.left_over(), 1e-300);
        if (share >= least) continue;
        least = share;
        fewer = model_.parts;
      }
      if (least == 0.3) return model_.take_back(all);
      model_.parts = fewer;
      refit();
    }
  }
  /// Drops what does not count beside the others, the least sure first.
  void drop_what_others_explain() {
    drop_what_others_become();
    while (!model_.parts.empty()) {
      const double beside = model_.left_over();
      std::size_t worst = model_.parts.size();
      double least = 1.0;
      for (std::size_t i = 0; i < model_.parts.size(); ++i) {
        model_.project(i);
        candidate& c = model_.parts[i];
        c = model_.tried(c);
        const bool real = counts(c) && c.wald > surprise(count_);
        const double share =
            real ? c.drop / (c.drop + (std::max)(beside - model_.chance(), 0.0)) : 0.0;
        if (share < least) {
          least = share;
          worst = i;
        }
      }
      model_.project(model_.parts.size());
      if (least > 0.3) break;
      model_.parts.erase(model_.parts.begin() + static_cast<std::ptrdiff_t>(worst));
      refit();
    }
  }
  /// Fits the latency and each part of another model anew.
  void refit() {
    model_.fit_latency();
    improve();
  }
  /// True if it has the sign that it must have, and is large enough to matter.
  [[nodiscard]] bool counts(const candidate& c) const noexcept {
    const double g = c.g[0], amplitude = std::hypot(c.g[0], c.g[1]);
    switch (c.is) {
      case column_of::hand:
        return -g * model_.mass() * stroke_ > 0.02 * force_;
      case column_of::mode:
        return g > 0.05 && c.p1 < 480.0 && c.p2 < 0.2;
      case column_of::swung:
        return g > 0.05 && c.p2 < 0.2;
      case column_of::backlash:
        return g > 1e-6 && 2.0 * g + c.p1 > 20e-6 && 2.0 * g + c.p1 < stroke_ / 4.0;
      case column_of::fraction:
        return g > 0.08 && g < 0.92;
      case column_of::filter:
        return c.p1 > 0.15 * model_.windows().tick();
      case column_of::cogging:
        return amplitude * model_.mass() > 0.02 * force_ && amplitude * model_.mass() < force_;
      case column_of::drift:
        return std::abs(g) * model_.mass() >
               (c.p1 == 0.0 ? (std::max)(0.1 * model_.friction(), 0.005) : 0.02 * force_);
      case column_of::uneven:
        return true;
    }
    return false;
  }

  template <class See>
  void visit(See&& see) {
    const auto one = [&](column_of is, double p1, double p2) {
      if ((is == column_of::filter || is == column_of::backlash) && model_.has(is)) return;
      if ((is == column_of::mode || is == column_of::swung) &&
          (model_.has(column_of::mode) || model_.has(column_of::swung)))
        return;
      see(model_.tried({.is = is, .p1 = p1, .p2 = p2}));
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
      if (model_.latency + by >= 0.0) one(column_of::fraction, by, 0.0);
    }
    for (double lag = 0.3; lag < 6.5; lag *= 1.25) {
      for (double d = 0.0; d <= model_.latency; d += 0.5)
        one(column_of::filter, lag * model_.windows().tick(), d);
    }
    for (double k = 1.0 / (2.0 * stroke_); k < 5e3; k += 1.0 / (4.0 * stroke_)) {
      one(column_of::cogging, k, 0.0);
      one(column_of::uneven, k, 0.0);
    }
    one(column_of::drift, 0.0, 0.0);
    one(column_of::drift, 1.0, 0.0);
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
        shaped_disturbance c = best;
        if (k == 0) c.p1 *= 1.0 + first;
        if (k == 1) c.p1 /= 1.0 + first;
        if (k >= 2 && c.is == column_of::filter) {
          // What is late by more is filtered by less: both together move along the valley.
          c.p2 = (std::max)(c.p2 + (k == 2 ? second : -second), 0.0);
          c.p1 = (std::max)(c.p1 + (best.p2 - c.p2) * model_.windows().tick(),
                            0.05 * model_.windows().tick());
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
        candidate next = model_.tried(c);
        if (next.g[0] * best.g[0] > 0.0 && next.drop > best.drop) {
          best = std::move(next);
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
              std::none_of(model_.parts.begin(), model_.parts.end(), [&](const candidate& m) {
                return m.is == column_of::backlash && m.wald > c.wald;
              });
    s.sure = std::sqrt(c.wald);
    switch (c.is) {
      case column_of::hand:
        s.size = -c.g[0] * model_.mass();
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
        s.size = model_.latency + c.p1 * c.g[0];
        break;
      case column_of::filter:
        s.size = c.p1;
        break;
      case column_of::cogging:
        s.size = std::hypot(c.g[0], c.g[1]) * model_.mass();
        s.where = 1.0 / c.p1;
        break;
      case column_of::drift:
        s.size = c.g[0] * model_.mass() / force_;
        break;
      case column_of::uneven:
        break;
    }
  }

  static constexpr std::size_t most = 7;  // parts of the model besides the rigid device
  disturbance_model model_;
  double stroke_, force_;
  std::optional<column_of> first_{};  ///< what the model began with
  std::vector<column_of> barred_{};   ///< what it may not begin with
  int count_ = 1;                     ///< candidates
};

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
