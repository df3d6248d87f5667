// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The falsifier: where nobody holds the device, a ledger that says more than the motor put in was told too much.
//
// A ledger told b, c, p and q keeps a lower bound L(n) of what friction and damper have taken less what the motor gave.
// Hands off, that is also what the device's motion and height have lost:
//
//     L(n) ≤ ½ m v(k)² − ½ m v(n)² + w (x(n) − x(k)) + ½ c p       from any row k to any later row n
//
// with w a constant load and ½ c p what the springs of the friction may hold at the start, as the ledger's promise
// has it. So a ledger above ½ m v(k)² + w (x(n) − x(k)) + ½ c p refutes what it was told, whatever the device is. One that is never
// above is not proved by that, and `credited` says how much of the loss it has seen. (Ours; mathematics.md § 6)

#include <passive_haptics/device/space.hpp>
#include <passive_haptics/energy_observer/dual_ledger.hpp>
#include <passive_haptics/identification/recorded_device.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

struct replayed {
  double overstated =
      0.0;  ///< the most that the ledger said beyond what can be [J]; ≤ 0 refutes nothing
  std::size_t row = 0;    ///< where that was, from 1 on
  double lost = 0.0;      ///< what friction and damper took from the first row to the last [J]
  double credited = 0.0;  ///< what the ledger has seen of that [J]
  [[nodiscard]] bool refuted() const noexcept { return overstated > 0.0; }
  [[nodiscard]] double share() const noexcept { return lost > 0.0 ? credited / lost : 0.0; }
};

/// What the recording shows besides what the ledger is told: mass [kg], load w and dry friction [N], 3 deviations off on
/// the side that is asked for, and the latency [ticks].
struct hands_off {
  double mass = 0.0, least_mass = 0.0, load = 0.0, load_error = 0.0, friction = 0.0;
  int latency = 0;

  hands_off() = default;
  explicit hands_off(const recorded_device& of) noexcept
      : mass(of.motion.mass.at_most(3.0)),
        least_mass(of.motion.mass.at_least(3.0)),
        load(of.motion.load.value),
        load_error(3.0 * of.motion.load.deviation),
        friction(2.0 *
                 of.motion.friction.at_most(3.0)),  // static friction may be twice the kinetic one
        latency(of.motion.latency) {}
};

namespace detail {

/// The most that the speed of a row can be [m/s], by the means over k ticks on both sides, the steps, and what the
/// forces can change it by meanwhile; the least of that for k = 1, 4 and 16.
[[nodiscard]] inline double speed_at_most(const recording& r, std::size_t i, double q,
                                          const hands_off& shown) {
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t k : {std::size_t{1}, std::size_t{4}, std::size_t{16}}) {
    if (i < k + 1 + static_cast<std::size_t>(shown.latency) || i + k >= r.size()) break;
    const double gone = r.time[i] - r.time[i - k], coming = r.time[i + k] - r.time[i];
    const double before = std::abs(r.position[i] - r.position[i - k]) / gone;
    const double after = std::abs(r.position[i + k] - r.position[i]) / coming;
    double push = 0.0;
    for (std::size_t j = i - k; j < i + k; ++j) {
      push = (std::max)(push, std::abs(r.force[j - static_cast<std::size_t>(shown.latency)]));
    }
    push += std::abs(shown.load) + shown.load_error + shown.friction;
    const double changed = push * (std::max)(gone, coming) / shown.least_mass;
    least = (std::min)(least, (std::min)(before, after) + q / (std::min)(gone, coming) + changed);
  }
  return least;
}

}  // namespace detail

/// A sentence if the description contradicts itself or the recording, before it is tried; else empty.
[[nodiscard]] inline std::string fault_of_told(const encoder_device& told,
                                               const recorded_device& found) {
  using detail::printed;
  const auto sentence = [](const parameter_fault& f) {
    return std::string(f.parameter) + " = " + printed("%g", f.value) + ", must be " + f.remedy;
  };
  if (const auto fault = told.check()) return sentence(fault);
  if (told.presliding > 0.0 && !(told.friction > 0.0)) {
    return "presliding = " + printed("%g", told.presliding) +
           " m without friction: state the friction that is elastic over it, or neither";
  }
  if (told.mass > found.motion.mass.at_most(3.0) * 1.05) {
    return "mass = " + printed("%g", told.mass) + " kg, and the whole axis has " +
           printed("%.3g", found.motion.mass.value) +
           ": a lower bound is wanted, of what moves with the encoder";
  }
  return {};
}

/// Lets the ledger of the device `told` go through the recording, from the slowest row of each of `starts` parts of it
/// on. `trace`, if given, takes its value of each row, from the first start on [J], and what it may be at most.
[[nodiscard]] inline replayed replay(const recording& r, const encoder_device& told,
                                     const hands_off& shown, int starts = 8,
                                     std::vector<std::array<double, 2>>* trace = nullptr) {
  using line = space<double, 1>;
  replayed result{.overstated = -std::numeric_limits<double>::infinity()};
  const auto late = static_cast<std::size_t>(shown.latency);
  const std::size_t n = r.size();
  std::vector<double> ticks(n > 1 ? n - 1 : 0);
  for (std::size_t i = 0; i + 1 < n; ++i) ticks[i] = r.time[i + 1] - r.time[i];
  if (ticks.empty()) return result;
  const double usual = detail::quantile(ticks, 0.5);
  for (int part = 0; part < starts; ++part) {
    std::size_t first = n * static_cast<std::size_t>(part) / static_cast<std::size_t>(starts);
    first = (std::max)(first, late + 1);
    const std::size_t until = (std::min)(n - 1, first + n / static_cast<std::size_t>(starts));
    double slowest = std::numeric_limits<double>::infinity();
    std::size_t start = first;
    for (std::size_t i = first; i < until; ++i) {
      const double v = detail::speed_at_most(r, i, told.quantum, shown);
      if (v < slowest) {
        slowest = v;
        start = i;
      }
    }
    if (!kernels::is_finite(slowest)) continue;
    const double held =
        shown.mass * slowest * slowest / 2.0 + told.friction * told.presliding / 2.0;
    part_at<dual_ledger, line> ledger(dual_ledger{.damping = {.coefficient = told.damping,
                                                              .coulomb = told.friction,
                                                              .presliding = told.presliding},
                                                  .quantum = told.quantum});
    double given = 0.0, value = ledger.value();
    for (std::size_t i = start + 1; i < n; ++i) {
      const double dx = r.position[i] - r.position[i - 1], dt = r.time[i] - r.time[i - 1];
      if (dt > 5.0 * usual) break;  // nobody knows what the motor did meanwhile
      const double f = r.force[i - 1 - late];
      if (!ledger.update(dx, f, dt)) break;
      value = ledger.value();
      given += f * dx;
      const double way = r.position[i] - r.position[start];
      const double may = held + shown.load * way + std::abs(shown.load) * told.quantum +
                         shown.load_error * std::abs(way);
      if (part == 0 && trace != nullptr) trace->push_back({value, may});
      if (part == 0) {
        result.lost = given + shown.load * way;
        result.credited = value + given;
      }
      if (value - may > result.overstated) {
        result.overstated = value - may;
        result.row = i + 1;
      }
    }
  }
  return result;
}

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
