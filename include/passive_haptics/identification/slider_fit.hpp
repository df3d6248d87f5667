// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Friction as several sliders, from a recording in which nobody holds the device.
//
//     const auto found = identification::fit_sliders(rows, {.step = 5e-6});
//     if (found.refused != nullptr) std::puts(found.refused);          // found.row says where
//     for (int k = 0; k < found.count; ++k) use(found.slider[k].level, found.slider[k].presliding);
//
// Real friction gives way over its first micrometres, and most of it much sooner than the last of it: a list of
// sliders cₖ [N], each behind a spring of its own that gives way by pₖ [m], says how much of the loss is there for
// motions that are smaller than the largest pₖ (Prandtl; Iwan, 1966; docs/design/mathematics.md § 6). The recording is a
// slow ramp of the motors' force both ways, with small reversals in it.

#include <passive_haptics/base/kernels.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

/// A row of the recording.
struct slow_row {
  double position = 0.0;  ///< x as shown [m]; joints: [rad]
  double force = 0.0;     ///< what the motors push with, inertia and damping small or taken off [N]
};
struct slider {
  double level = 0.0;       ///< c [N]
  double presliding = 0.0;  ///< p [m], with the step of the positions
};
struct slider_fit_settings {
  double step = 0.0;   ///< q of the positions shown [m]
  int most = 10;       ///< sliders, 1 to 10; sixteen have been seen to overfit
  double drift = 0.0;  ///< share by which friction may fall with warmth and wear, 0 to 1
};
struct slider_fit {
  std::array<slider, 10> list{};  ///< from the stiffest on
  int count = 0;
  double offset =
      0.0;  ///< force that goes with no slip: weight, or friction that differs by direction [N]
  double left = 0.0;              ///< share of the fitted levels that the falsifier has left
  double credited = 0.0;          ///< share of the loss of this recording that the list credits
  const char* refused = nullptr;  ///< why there is no list, and the remedy
  std::size_t row = 0;            ///< the row that it is about

  [[nodiscard]] double level() const noexcept {
    double sum = 0.0;
    for (const slider& s : list) sum += s.level;
    return sum;
  }
  /// Σ cₖpₖ/Σ cₖ [m]: what one slider for all has to state.
  [[nodiscard]] double mean_presliding() const noexcept {
    double sum = 0.0;
    for (const slider& s : list) sum += s.level * s.presliding;
    return level() > 0.0 ? sum / level() : 0.0;
  }
};

namespace detail {
/// A slider's spring, as a share of its deflection p, after a motion of `way` [m].
[[nodiscard]] inline double play(double share, double way, double p) noexcept {
  return kernels::clamped(share + way / p, -1.0, 1.0);
}
}  // namespace detail

/// What the list takes of a motion, beyond what its springs hold, row by row; `each` is given the sum so far [J].
/// Deflections begin at zero: 5/2 Σ cₖpₖ is the most that this and the springs can be wrong by.
inline void loss_of(std::span<const slider> list, std::span<const slow_row> rows, double scale,
                    auto each) {
  std::array<double, 10> share{};
  double sum = 0.0;
  for (std::size_t n = 0; n < rows.size(); ++n) {
    const double way = n == 0 ? 0.0 : rows[n].position - rows[n - 1].position;
    for (std::size_t k = 0; k < list.size(); ++k) {
      const slider& s = list[k];
      if (!(s.level > 0.0)) continue;
      const double before = share[k];
      share[k] = detail::play(before, way, s.presliding);
      sum += scale * s.level * std::abs(way - (share[k] - before) * s.presliding);
    }
    each(n, sum);
  }
}

/// The motors' work between two rows [J].
[[nodiscard]] inline double work_of(std::span<const slow_row> rows, std::size_t n) noexcept {
  return (rows[n].force + rows[n - 1].force) / 2.0 * (rows[n].position - rows[n - 1].position);
}

/// The falsifier: where nobody holds the device, no window of a recording may show a loss that is larger than the motors'
/// work in it and what the springs may hold. Returns the largest share of the levels that this leaves, 1 if nothing
/// refutes them: friction that has fallen since it was stated, with warmth or wear, shows as a share below 1. A hand of
/// the size of c hides it, so this is asked with hands off.
[[nodiscard]] inline double sure_share(std::span<const slider> list, std::span<const slow_row> rows,
                                       double step) {
  double springs = 0.0, level = 0.0, most = 0.0;
  for (const slider& s : list) {
    springs += s.level * s.presliding;
    level += s.level;
  }
  for (const slow_row& r : rows) most = kernels::larger(most, std::abs(r.force));
  const double ends = step * kernels::larger(level, most);  // a work is known to that
  const auto stands = [&](double scale) {
    double worked = 0.0, least = 0.0;  // by the motors; the most that this was ahead of the loss
    bool so = true;
    loss_of(list, rows, scale, [&](std::size_t n, double lost) {
      worked += n == 0 ? 0.0 : work_of(rows, n);
      const double surplus = worked - lost;
      least = n == 0 ? surplus : kernels::larger(least, surplus);
      so = so && least - surplus <= springs + ends;
    });
    return so;
  };
  if (stands(1.0)) return 1.0;
  double sure = 0.0, refuted = 1.0;
  for (int i = 0; i < 30; ++i) {
    const double middle = (sure + refuted) / 2.0;
    (stands(middle) ? sure : refuted) = middle;
  }
  return sure;
}

/// Levels of sliders on a ladder of pₖ that explain the forces best, none below zero: the deflections of the
/// ladder follow from the positions alone, so the forces are linear in the levels. Then the falsifier: where nobody
/// holds the device, no window of the recording may show a loss that is larger than the motors' work in it and what
/// the springs may hold; all levels are lowered by one share until that is so.
[[nodiscard]] inline slider_fit fit_sliders(std::span<const slow_row> rows,
                                            const slider_fit_settings& by) {
  slider_fit found;
  const auto refuse = [&found](std::size_t row, const char* why) {
    found.row = row;
    found.refused = why;
    return found;
  };
  if (!(by.step >= 0.0 && by.step < 1e-2) || !(by.drift >= 0.0 && by.drift < 1.0) || by.most < 1 ||
      by.most > 10) {
    return refuse(
        0, "A setting is out of its range: 0 <= step < 10 mm, 1 to 10 sliders, 0 <= drift < 1.");
  }
  if (rows.size() < 200) return refuse(rows.size(), "There are too few rows: record 200 or more.");
  double low = rows[0].position, high = low;
  for (std::size_t n = 0; n < rows.size(); ++n) {
    if (!std::isfinite(rows[n].position) || !std::isfinite(rows[n].force)) {
      return refuse(n, "A row holds no number: leave it out, and close the gap before fitting.");
    }
    low = kernels::smaller(low, rows[n].position);
    high = kernels::larger(high, rows[n].position);
  }
  const double span = high - low;
  if (!(span > 4.0 * by.step) || !(span > 0.0)) {
    return refuse(rows.size() - 1,
                  "The device has not moved by more than four steps: ramp on until it slips.");
  }

  // The ladder, and from which row on each rung has slipped and so forgotten where it began.
  const auto rungs = static_cast<std::size_t>(by.most);
  const double finest = kernels::larger(by.step, span / 2000.0), widest = span / 4.0;
  std::array<double, 10> p{};
  for (std::size_t k = 0; k < rungs; ++k) {
    const double at = rungs > 1 ? static_cast<double>(k) / static_cast<double>(rungs - 1) : 1.0;
    p[k] = finest * std::pow(kernels::larger(widest / finest, 1.0), at);
  }
  std::array<std::size_t, 10> slipped{};
  slipped.fill(rows.size());
  std::array<double, 10> share{};
  for (std::size_t n = 1; n < rows.size(); ++n) {
    for (std::size_t k = 0; k < rungs; ++k) {
      share[k] = detail::play(share[k], rows[n].position - rows[n - 1].position, p[k]);
      if (std::abs(share[k]) == 1.0 && n < slipped[k]) slipped[k] = n;
    }
  }
  std::size_t used = 0, from = 0;
  while (used < rungs && slipped[used] < rows.size() / 2) from = (std::max)(from, slipped[used++]);
  if (used == 0) {
    return refuse(rows.size() / 2,
                  "Nothing slips in the first half of the rows: ramp farther, both ways.");
  }

  // Least squares of the levels and of an offset, by descent along one of them at a time.
  constexpr std::size_t most = 11;
  std::array<std::array<double, most>, most> H{};
  std::array<double, most> g{}, c{};
  share = {};
  for (std::size_t n = 1; n < rows.size(); ++n) {
    std::array<double, most> column{};
    for (std::size_t k = 0; k < used; ++k) {
      share[k] = detail::play(share[k], rows[n].position - rows[n - 1].position, p[k]);
      column[k] = share[k];
    }
    column[used] = 1.0;
    if (n < from) continue;
    for (std::size_t i = 0; i <= used; ++i) {
      g[i] += column[i] * rows[n].force;
      for (std::size_t j = 0; j <= used; ++j) H[i][j] += column[i] * column[j];
    }
  }
  for (int sweep = 0; sweep < 5000; ++sweep) {
    for (std::size_t i = 0; i <= used; ++i) {
      double miss = g[i];
      for (std::size_t j = 0; j <= used; ++j) miss -= H[i][j] * c[j];
      if (!(H[i][i] > 0.0)) continue;
      c[i] += miss / H[i][i];
      if (i < used) c[i] = kernels::larger(c[i], 0.0);
    }
  }
  found.offset = c[used];
  for (std::size_t k = 0; k < used; ++k) {
    if (!(c[k] > 0.0)) continue;
    found.list[static_cast<std::size_t>(found.count++)] = {c[k], p[k] + by.step};
  }
  if (found.count == 0) {
    return refuse(rows.size() - 1,
                  "The force does not resist the motion: is its sign right, and does nobody hold?");
  }

  const std::span<const slider> list(found.list.data(), static_cast<std::size_t>(found.count));
  found.left = sure_share(list, rows, by.step);
  double lost = 0.0;
  const double kept = found.left * (1.0 - by.drift);
  loss_of(list, rows, kept, [&](std::size_t /*n*/, double sum) { lost = sum; });
  double worked = 0.0;
  for (std::size_t n = 1; n < rows.size(); ++n) worked += work_of(rows, n);
  found.credited = worked > 0.0 ? lost / worked : 0.0;
  for (slider& s : found.list) s.level *= kept;
  return found;
}

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
