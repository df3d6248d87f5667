// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Friction as several sliders, from a recording in which nobody holds the device.
//
//     const auto found = identification::fit_sliders(rows, {.step = 5e-6});
//     if (found.refused != nullptr) std::puts(found.refused);          // found.row says where
//     for (int k = 0; k < found.count; ++k) use(found.slider[k].level, found.slider[k].presliding);
//
// Real friction is elastic over its first micrometres, and slips part by part. A list of sliders cₖ [N], each behind
// a spring that gives way by pₖ [m], describes the loss of motions smaller than the largest pₖ, too (Prandtl; Iwan,
// 1966; docs/design/mathematics.md § 6). The recording is a
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
  double force = 0.0;     ///< force of the motors, less inertia and damping if not small [N]
};
struct slider {
  double level = 0.0;       ///< c [N]
  double presliding = 0.0;  ///< p [m], the step of the positions added
};
struct slider_fit_settings {
  double step = 0.0;   ///< q of the positions shown [m]
  int most = 10;       ///< largest number of sliders, 1 to 10, because 16 overfit
  double drift = 0.0;  ///< share by which friction may fall with warmth and wear, 0 to 1
};
struct slider_fit {
  std::array<slider, 10> list{};  ///< in the order of rising p
  int count = 0;
  double offset =
      0.0;  ///< constant force of the fit: weight, or friction that differs by direction [N]
  double left = 0.0;              ///< share of the fitted levels that sure_share() leaves
  double credited = 0.0;          ///< share of the loss of this recording that the list credits
  const char* refused = nullptr;  ///< the reason why there is no list, and the remedy; else null
  std::size_t row = 0;            ///< row of that reason, counted from 0

  [[nodiscard]] double level() const noexcept {
    double sum = 0.0;
    for (const slider& s : list) sum += s.level;
    return sum;
  }
  /// Σ cₖpₖ/Σ cₖ [m], the presliding of one slider in place of all.
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

/// Computes the energy that the sliders dissipate, scale·Σ cₖ|Δx − Δzₖ| [J], and calls each(row, sum so far). The
/// unknown deflections zₖ at the start are taken as zero.
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

/// The largest share of the levels that the recording does not refute, 1 if it refutes nothing. Without a hand the loss
/// in any window is at most the work of the motors in it and Σ cₖpₖ (docs/design/mathematics.md § 6). Friction that has
/// fallen since it was stated, with warmth or wear, gives a share below 1. A hand of the size of c would hide that.
[[nodiscard]] inline double sure_share(std::span<const slider> list, std::span<const slow_row> rows,
                                       double step) {
  double springs = 0.0, level = 0.0, most = 0.0;
  for (const slider& s : list) {
    springs += s.level * s.presliding;
    level += s.level;
  }
  for (const slow_row& r : rows) most = kernels::larger(most, std::abs(r.force));
  const double ends = step * kernels::larger(level, most);  // error of a work by the steps [J]
  const auto stands = [&](double scale) {
    double worked = 0.0, least = 0.0;  // work of the motors; largest surplus over the loss [J]
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

/// Fits the levels cₖ ≥ 0 of sliders whose pₖ form a geometric series, by least squares of the forces. The deflections
/// follow from the positions alone, so the forces are linear in the levels. Then all levels are lowered by the factor
/// sure_share() (1 − drift).
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

  // The series of pₖ, and the row at which each has slipped, from where on its unknown first deflection is gone.
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

  // Least squares of the levels and of an offset, by coordinate descent.
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
