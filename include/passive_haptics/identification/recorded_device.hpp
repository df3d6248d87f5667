// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The numbers m, b, c, w, d and p of a device, from a recording during which nobody held it.
//
//     m ẍ = f(t − d) − b± ẋ − c sgn ẋ + w        in motion: motion_regression.hpp
//     m ẍ = f(t − d) − b ẋ − (c/p) z + w         also at turns, for p; z [m] of a spring and slider, |z| ≤ p
//
// Both are multiplied by φ(u) = (1 − u²)² over windows and summed, so no position is differentiated. The estimate
// of p is that of the least residual; every deviation is that of the jackknife over twelve stretches of time.
// stated_of() makes bounds of the estimates, and replay.hpp tries to refute them on a recording.

#include <passive_haptics/design/described_device.hpp>
#include <passive_haptics/identification/motion_regression.hpp>
#include <passive_haptics/identification/recording.hpp>
#include <passive_haptics/identification/trust.hpp>

#include <Eigen/Cholesky>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

struct recorded_device {
  motion_found motion{};        ///< m, b±, c, w, d
  estimate presliding{};        ///< p [m]
  estimate elastic_friction{};  ///< c of the fit that has p [N]
  double quantum = 0.0;         ///< q, noise included [m]
  double tick = 0.0;            ///< the longest tick that is no gap [s]
  double top_force = 0.0;       ///< largest force of the recording [N]
  std::string problem;          ///< a sentence if the recording gives no numbers, else empty
};

namespace detail {

/// Sums for p: a window's Σφ Δv against its Σφ f h, Σφ Δx, Σφ z h and Σφ h, for each p tried.
class slider_fit {
 public:
  static constexpr int tried = 28;
  using table = Eigen::Matrix<double, 5, 5>;

  slider_fit(double least, double most) noexcept {
    for (int i = 0; i < tried; ++i) {
      places_[static_cast<std::size_t>(i)] =
          least * std::pow(most / least, static_cast<double>(i) / (tried - 1));
    }
    for (auto& one : sums_) one.fill(table::Zero());
  }
  [[nodiscard]] double place(int i) const noexcept { return places_[static_cast<std::size_t>(i)]; }
  void book(int i, int group, const Eigen::Matrix<double, 5, 1>& row) noexcept {
    sums_[static_cast<std::size_t>(i)][static_cast<std::size_t>(group)] += row * row.transpose();
  }
  /// p and c, each with its deviation.
  void conclude(recorded_device& found) const noexcept {
    constexpr int groups = motion_regression::groups;
    std::array<answer, groups> without{};
    const answer whole = best(-1);
    int count = 0;
    for (int g = 0; g < groups; ++g) {
      without[static_cast<std::size_t>(count)] = best(g);
      if (without[static_cast<std::size_t>(count)].friction > 0.0) ++count;
    }
    const auto spread = [&](auto of) {
      double mean = 0.0, squares = 0.0;
      for (int g = 0; g < count; ++g) mean += of(without[static_cast<std::size_t>(g)]) / count;
      for (int g = 0; g < count; ++g) {
        const double off = of(without[static_cast<std::size_t>(g)]) - mean;
        squares += off * off;
      }
      return count > 3 ? std::sqrt(squares * (count - 1) / count)
                       : std::numeric_limits<double>::infinity();
    };
    if (!(whole.friction > 0.0)) return;
    // The grid of trial values and the steps of the encoder limit p, too [m].
    const double hidden = 0.3 * (place(1) / place(0) - 1.0) * whole.place + 0.3 * found.quantum;
    found.presliding = {whole.place,
                        std::hypot(spread([](const answer& a) { return a.place; }), hidden)};
    found.elastic_friction = {whole.friction, spread([](const answer& a) { return a.friction; })};
  }

 private:
  struct answer {
    double place = 0.0, friction = 0.0, left = std::numeric_limits<double>::infinity();
  };
  [[nodiscard]] answer at(int i, int without) const noexcept {
    table all = table::Zero();
    for (int g = 0; g < motion_regression::groups; ++g) {
      if (g != without) all += sums_[static_cast<std::size_t>(i)][static_cast<std::size_t>(g)];
    }
    Eigen::Vector4d scale;
    for (int k = 0; k < 4; ++k) scale(k) = all(k, k) > 0.0 ? 1.0 / std::sqrt(all(k, k)) : 0.0;
    Eigen::Matrix4d a = scale.asDiagonal() * all.topLeftCorner<4, 4>() * scale.asDiagonal();
    for (int k = 0; k < 4; ++k) a(k, k) += scale(k) == 0.0 ? 1.0 : 1e-12;
    const Eigen::Vector4d right = all.topRightCorner<4, 1>();
    const Eigen::Vector4d share = scale.cwiseProduct(a.ldlt().solve(scale.cwiseProduct(right)));
    if (!share.allFinite() || !(share(0) > 0.0)) return {};
    return {place(i), share(2) / share(0), all(4, 4) - share.dot(right)};
  }
  /// The p of the least residual; between those tried by a parabola through three.
  [[nodiscard]] answer best(int without) const noexcept {
    std::array<answer, tried> all{};
    int least = 0;
    for (int i = 0; i < tried; ++i) {
      all[static_cast<std::size_t>(i)] = at(i, without);
      if (all[static_cast<std::size_t>(i)].left < all[static_cast<std::size_t>(least)].left)
        least = i;
    }
    answer found = all[static_cast<std::size_t>(least)];
    if (least == 0 || least + 1 == tried) return found;
    const double a = all[static_cast<std::size_t>(least) - 1].left, b = found.left,
                 c = all[static_cast<std::size_t>(least) + 1].left;
    const double bend = a - 2.0 * b + c;
    const double shift = bend > 0.0 && kernels::is_finite(bend) ? 0.5 * (a - c) / bend : 0.0;
    found.place *= std::pow(place(1) / place(0), std::clamp(shift, -1.0, 1.0));
    return found;
  }

  std::array<double, tried> places_{};
  std::array<std::array<table, motion_regression::groups>, tried> sums_{};
};

/// Ticks of the windows: half of the shortest tenth of the ways from turn to turn, within 8 and 64.
[[nodiscard]] inline int window_of(const recording& r, const recording_statistics& s) {
  const double deadband = (std::max)(0.02 * s.span, 4.0 * (s.quantum + s.noise));
  std::vector<double> ways;
  double farthest = r.position[0], sign = 0.0;
  std::size_t turned = 0;
  for (std::size_t i = 1; i < r.size(); ++i) {
    const double gone = r.position[i] - farthest;
    if (sign == 0.0 ? std::abs(gone) > deadband : sign * gone < -deadband) {
      if (sign != 0.0) ways.push_back(static_cast<double>(i - turned));
      sign = gone > 0.0 ? 1.0 : -1.0;
      turned = i;
      farthest = r.position[i];
    } else if (sign * gone > 0.0) {
      farthest = r.position[i];
    }
  }
  const double usual = ways.empty() ? 128.0 : quantile(ways, 0.1);
  return std::clamp(static_cast<int>(usual / 2.0), 8, 64);
}

}  // namespace detail

/// Identifies the axis of a recording that fault_of() and doubt_of() have passed.
[[nodiscard]] inline recorded_device identified(const recording& r, const recording_statistics& s) {
  recorded_device found;
  found.quantum = s.quantum + s.noise;
  found.tick = s.longest;
  found.top_force = s.top_force;
  const int groups = motion_regression::groups;
  const double step = found.quantum;
  const double slowest = 0.1 * s.top_speed;
  const int window = detail::window_of(r, s);
  const auto group_of = [&](std::size_t i) {
    return static_cast<int>(i * static_cast<std::size_t>(groups) / r.size());
  };

  motion_regression regression((std::min)(0.02 * s.span, r.rotary ? 10e-3 : 2e-3));
  double sign = 0.0, turn = r.position[0], farthest = turn;
  for (std::size_t i = 0; i < r.size(); ++i) {
    const double length = i > 0 ? r.time[i] - r.time[i - 1] : s.tick;
    if (length > 5.0 * s.tick) regression.interrupt();
    const double x = r.position[i];
    regression.sample(x - r.position[0], length);
    regression.commanded(r.force[i]);
    const double gone = x - farthest;
    const double deadband = 2.0 * step + 1e-4 * s.span;
    if (sign * gone < -deadband || sign == 0.0) {
      turn = farthest;
      sign = gone < 0.0 ? -1.0 : gone > 0.0 ? 1.0 : 0.0;
      farthest = x;
    } else if (sign * gone > 0.0) {
      farthest = x;
    }
    if (i % 3 == 0) regression.book(window, group_of(i), slowest, step, turn - r.position[0]);
  }
  found.motion = regression.conclude();
  const motion_found& m = found.motion;
  if (regression.windows() < 100) {
    found.problem =
        "it moves too slowly or too little: record it swinging across its stroke for some seconds";
    return found;
  }
  if (!(m.explained > 0.8)) {
    found.problem = "the force explains " +
                    detail::printed("%.0f %%", 100.0 * (std::max)(m.explained, 0.0)) +
                    " of the motion, and 80 % is the least: somebody holds it, columns are "
                    "swapped, a scale or a sign "
                    "is wrong, or the rows are too far apart";
    return found;
  }
  if (!(m.mass.deviation < 0.05 * m.mass.value)) {
    found.problem = "the mass comes out as " + detail::printed("%.3g", m.mass.value) +
                    detail::printed(" ± %.2g", m.mass.deviation) +
                    " from stretch to stretch: somebody holds or pushes it, or it is recorded for "
                    "too short a time";
    return found;
  }
  const double heaviest = r.rotary ? 100.0 : 2000.0, lightest = r.rotary ? 1e-7 : 1e-3;
  if (!(m.mass.value < heaviest && m.mass.value > lightest)) {
    found.problem = "a mass of " + detail::printed("%.3g ", m.mass.value) +
                    (r.rotary ? "kg·m²" : "kg") + " comes out of it: is a scale off by a thousand?";
    return found;
  }

  // For p the turns and rests matter, so the windows are short, and all of them are used.
  const int width = std::clamp(window / 2, 6, 24);
  const double least = (std::max)(0.1 * step, 1e-7 * s.span);
  detail::slider_fit fit(least, (std::max)(0.02 * s.span, 20.0 * least));
  const std::size_t late = static_cast<std::size_t>(m.latency);
  std::array<std::vector<double>, detail::slider_fit::tried> bent;
  for (int k = 0; k < detail::slider_fit::tried; ++k) {
    std::vector<double>& z = bent[static_cast<std::size_t>(k)];
    const double p = fit.place(k);
    z.assign(r.size(), 0.0);
    for (std::size_t i = 1; i < r.size(); ++i) {
      z[i] = std::clamp(z[i - 1] + r.position[i] - r.position[i - 1], -p, p);
    }
  }
  for (std::size_t last = static_cast<std::size_t>(width) + late + 1; last + 1 < r.size();
       last += 3) {
    const std::size_t first = last - static_cast<std::size_t>(width);
    const double whole = r.time[last] - r.time[first];
    if (whole > (width + 5.0) * s.tick) continue;
    Eigen::Matrix<double, 5, 1> row = Eigen::Matrix<double, 5, 1>::Zero();
    std::array<double, detail::slider_fit::tried> rubbed{};
    for (std::size_t j = first + 1; j < last; ++j) {
      const double before = r.time[j] - r.time[j - 1], after = r.time[j + 1] - r.time[j];
      const double u = 2.0 * (r.time[j] - r.time[first]) / whole - 1.0;
      const double phi = (1.0 - u * u) * (1.0 - u * u);
      const double lasted = (before + after) / 2.0;
      row(0) += phi * (after * r.force[j - late] + before * r.force[j - 1 - late]) / 2.0;
      row(1) -= phi * (r.position[j + 1] - r.position[j - 1]) / 2.0;
      row(3) += phi * lasted;
      row(4) += phi * ((r.position[j + 1] - r.position[j]) / after -
                       (r.position[j] - r.position[j - 1]) / before);
      for (std::size_t k = 0; k < rubbed.size(); ++k) rubbed[k] -= phi * lasted * bent[k][j];
    }
    for (int k = 0; k < detail::slider_fit::tried; ++k) {
      row(2) = rubbed[static_cast<std::size_t>(k)] / fit.place(k);
      fit.book(k, group_of(last), row);
    }
  }
  fit.conclude(found);
  return found;
}

/// The bounds that follow from the recording, on the side that a ledger needs. `trust` has their confidence, and how
/// far friction and damping may fall until the next recording.
[[nodiscard]] inline encoder_device stated_of(const recorded_device& of,
                                              const trust& how = {}) noexcept {
  const motion_found& m = of.motion;
  const auto sure = [&](const estimate& e) {
    const double low = how.at_least(e);
    return low > 0.0 ? low : 0.0;
  };
  encoder_device d{
      .mass = sure(m.mass),
      .damping = how.kept() * kernels::smaller(sure(m.damping[0]), sure(m.damping[1])),
      .friction = how.kept() * sure(m.friction),
      .presliding = 1.25 * how.at_most(of.presliding),  // a fit of one spring to several is short
      .quantum = of.quantum,
      .force_limit = of.top_force,
      .longest_tick = 1.2 * of.tick,
      .latency = m.latency};
  if (!kernels::is_finite(d.presliding)) d.friction = 0.0;
  if (!(d.friction > 0.0)) d.friction = d.presliding = 0.0;
  return d;
}

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
