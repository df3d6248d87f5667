// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A recording of one axis, logged by any program: time [s], position [m] and force of the motor [N], row by row.
//
//     const auto r = identification::load_recording("log.csv", {});        // recording_file.hpp
//     if (!r.fault.empty()) std::puts(r.fault.c_str());                     // names the row and the remedy
//     const auto seen = identification::statistics_of(r.rows);
//
// The force of a row is the one that the motor holds from its time on until that of the next row.

#include <passive_haptics/base/kernels.hpp>
#include <passive_haptics/identification/step_finder.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

/// Columns in seconds, metres and newtons; for a joint in radians and newton metres.
struct recording {
  std::vector<double> time, position, force;
  bool rotary = false;

  [[nodiscard]] std::size_t size() const noexcept { return time.size(); }
  /// The rows from `first` up to but not including `last`.
  [[nodiscard]] recording part(std::size_t first, std::size_t last) const {
    last = (std::min)(last, size());
    first = (std::min)(first, last);
    const auto cut = [&](const std::vector<double>& of) {
      return std::vector<double>(of.begin() + static_cast<std::ptrdiff_t>(first),
                                 of.begin() + static_cast<std::ptrdiff_t>(last));
    };
    return {cut(time), cut(position), cut(force), rotary};
  }
};

/// Statistics of the samples, to judge a recording before it is used.
struct recording_statistics {
  std::size_t rows = 0;
  double tick = 0.0;       ///< the median time from row to row [s]
  double jitter = 0.0;     ///< 90 % of the ticks differ from `tick` by at most this share of it
  double longest = 0.0;    ///< longest tick that is no gap [s]
  std::size_t gaps = 0;    ///< ticks longer than five median ones
  std::size_t gap = 0;     ///< row after the first gap
  double repeated = 0.0;   ///< share of the rows in motion that repeat the position before
  double quantum = 0.0;    ///< the step of the position [m]; 0: none seen
  double noise = 0.0;      ///< width of the noise, end to end [m]; 0 if there are steps
  double span = 0.0;       ///< from the least to the largest position [m]
  double top_speed = 0.0;  ///< largest mean speed over sixteen ticks [m/s]
  double top_force = 0.0;  ///< the largest size of the force [N]
};

namespace detail {

[[nodiscard]] inline std::string printed(const char* pattern, double x) {
  char text[64];
  std::snprintf(text, sizeof text, pattern, x);
  return text;
}
[[nodiscard]] inline std::string in_row(std::size_t row) {
  return "row " + std::to_string(row) + ": ";
}
/// The quantile `share` of `all`, which must not be empty and is reordered.
[[nodiscard]] inline double quantile(std::vector<double>& all, double share) {
  const auto at = static_cast<std::size_t>(share * static_cast<double>(all.size() - 1));
  std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(at), all.end());
  return all[at];
}
/// The roughness of a column: the mean square of its second difference over `ticks` rows over its variance.
[[nodiscard]] inline double roughness(const std::vector<double>& x, std::size_t ticks) {
  if (x.size() < 3 * ticks) return 0.0;
  double mean = 0.0, spread = 0.0, bent = 0.0;
  for (const double one : x) mean += one / static_cast<double>(x.size());
  for (const double one : x) spread += (one - mean) * (one - mean);
  for (std::size_t n = 2 * ticks; n < x.size(); ++n) {
    const double second = x[n] - 2.0 * x[n - ticks] + x[n - 2 * ticks];
    bent += second * second;
  }
  return spread > 0.0 ? bent / spread : 0.0;
}

}  // namespace detail

/// A sentence with the first impossible row and the remedy; empty if there is none. Rows are counted from 1.
[[nodiscard]] inline std::string fault_of(const recording& r) {
  using detail::in_row, detail::printed;
  const std::size_t n = r.size();
  if (r.position.size() != n || r.force.size() != n) {
    return "the columns have " + std::to_string(n) + ", " + std::to_string(r.position.size()) +
           " and " + std::to_string(r.force.size()) +
           " rows: time, position and force of one recording are wanted";
  }
  if (n < 200) {
    return in_row(n) +
           "the recording ends here, and 200 rows are the least that says anything: record longer";
  }
  for (std::size_t i = 0; i < n; ++i) {
    const char* what = !kernels::is_finite(r.time[i])       ? "time"
                       : !kernels::is_finite(r.position[i]) ? "position"
                       : !kernels::is_finite(r.force[i])    ? "force"
                                                            : nullptr;
    if (what != nullptr) {
      return in_row(i + 1) + "the " + what +
             " is no finite number: leave that row out; it counts as a gap";
    }
    if (i > 0 && !(r.time[i] > r.time[i - 1])) {
      return in_row(i + 1) + "time runs back or stands still, from " +
             printed("%.9g", r.time[i - 1]) + " to " + printed("%.9g s", r.time[i]) +
             ": leave repeated rows out, cut the recording where its clock was set, or name the "
             "right column for "
             "the time";
    }
  }
  return {};
}

[[nodiscard]] inline recording_statistics statistics_of(const recording& r) {
  recording_statistics s{.rows = r.size()};
  if (r.size() < 3) return s;
  std::vector<double> ticks(r.size() - 1);
  for (std::size_t i = 0; i + 1 < r.size(); ++i) ticks[i] = r.time[i + 1] - r.time[i];
  std::vector<double> sorted = ticks;
  s.tick = detail::quantile(sorted, 0.5);
  for (double& one : sorted) one = std::abs(one - s.tick) / s.tick;
  s.jitter = detail::quantile(sorted, 0.9);
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    if (!(ticks[i] > 5.0 * s.tick)) {
      s.longest = (std::max)(s.longest, ticks[i]);
    } else if (++s.gaps == 1) {
      s.gap = i + 2;
    }
  }
  step_finder steps;
  std::size_t moving = 0, stood = 0;
  const std::size_t reach = 16;
  for (std::size_t i = 0; i < r.size(); ++i) {
    if (i > 0 && ticks[i - 1] > 5.0 * s.tick) steps.interrupt();
    const bool steady = i >= 6 && r.force[i] == r.force[i - 6] && r.force[i - 3] == r.force[i];
    steps.book(r.position[i], false, steady);
    s.top_force = (std::max)(s.top_force, std::abs(r.force[i]));
    if (i >= reach) {
      const double way = std::abs(r.position[i] - r.position[i - reach]);
      s.top_speed = (std::max)(s.top_speed, way / (r.time[i] - r.time[i - reach]));
    }
  }
  const auto [least, most] = std::minmax_element(r.position.begin(), r.position.end());
  s.span = *most - *least;
  s.quantum = steps.step();
  s.noise = steps.has_step() ? 0.0 : steps.noise();
  // A row is in motion if it is 32 steps or more from the row 16 before: at that speed no position repeats by itself.
  for (std::size_t i = reach; i < r.size(); ++i) {
    if (std::abs(r.position[i] - r.position[i - reach]) <
        2.0 * reach * (s.quantum + 1e-3 * s.noise))
      continue;
    if (r.position[i] == r.position[i - reach]) continue;
    ++moving;
    if (r.position[i] == r.position[i - 1]) ++stood;
  }
  s.repeated = moving > 0 ? static_cast<double>(stood) / static_cast<double>(moving) : 0.0;
  return s;
}

/// A sentence if units or columns are certainly wrong, which no single row shows; empty if not.
[[nodiscard]] inline std::string doubt_of(const recording& r, const recording_statistics& s) {
  using detail::printed;
  const char* metre = r.rotary ? "rad" : "m";
  const char* newton = r.rotary ? "N·m" : "N";
  if (s.tick > 0.1 || s.tick < 2e-5) {
    return "the rows are " + printed("%.3g", s.tick) +
           " s apart, from 20 µs to 0.1 s are wanted: is the time in ms or µs? State its scale";
  }
  if (static_cast<double>(s.gaps) > 0.02 * static_cast<double>(s.rows)) {
    return "row " + std::to_string(s.gap) + " and " + std::to_string(s.gaps) +
           " rows in all come after a gap of more than five ticks: replay parts without gaps";
  }
  if (!(s.span > 0.0)) return "the position never changes: name the column of the encoder";
  if (!(s.top_force > 0.0))
    return "the force is never other than 0: name the column of the motor's force";
  // A force makes a position by two integrations, so the position is by far the smoother column.
  if (detail::roughness(r.position, 8) > 4.0 * detail::roughness(r.force, 8) + 1e-6) {
    return "the position is rougher than the force: are these two columns swapped?";
  }
  const double fastest = r.rotary ? 1000.0 : 20.0;
  if (s.top_speed > fastest) {
    return "the axis goes up to " + printed("%.3g ", s.top_speed) + metre + "/s, below " +
           printed("%.3g", fastest) +
           " is wanted: is the position in mm, µm or degrees? State its scale";
  }
  const double strongest = r.rotary ? 2000.0 : 20000.0;
  if (s.top_force > strongest) {
    return "the motor pushes with up to " + printed("%.3g ", s.top_force) + newton + ", below " +
           printed("%.3g", strongest) + " is wanted: is the force in mN? State its scale";
  }
  return {};
}

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
