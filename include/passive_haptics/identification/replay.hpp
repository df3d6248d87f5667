// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Tries to refute stated numbers of a device by a recording during which nobody held it.
//
// With b, c, p and q stated, a ledger keeps a lower bound L(n) [J] of the energy that friction and damper have taken,
// less the work of the motor. Without a hand this is also the kinetic and potential energy that the device has lost:
//
//     L(n) ≤ ½ m v(k)² − ½ m v(n)² + w (x(n) − x(k)) + ½ c p       from any row k to any later row n
//
// with w a constant load [N] and ½ c p [J] the most that the springs of the friction hold at the start. So a ledger above
// ½ m v(k)² + w (x(n) − x(k)) + ½ c p refutes the stated numbers, whatever the device is. A ledger that stays below proves
// nothing, and `credited` has the part of the loss that it has seen. (Ours; docs/design/mathematics.md § 6)

#include <passive_haptics/device/space.hpp>
#include <passive_haptics/energy_observer/dual_ledger.hpp>
#include <passive_haptics/identification/recorded_device.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

struct replayed {
  double overstated =
      0.0;              ///< most by which the ledger was above its limit [J]; ≤ 0 refutes nothing
  std::size_t row = 0;  ///< row of `overstated`, counted from 1
  double lost = 0.0;    ///< energy that friction and damper took in the whole recording [J]
  double credited = 0.0;  ///< part of `lost` that the ledger has credited [J]
  [[nodiscard]] bool refuted() const noexcept { return overstated > 0.0; }
  [[nodiscard]] double share() const noexcept { return lost > 0.0 ? credited / lost : 0.0; }
};

/// The numbers of the recording that the limit needs: mass [kg], load w and dry friction [N], each with 3 deviations on
/// the safe side, and the latency [ticks].
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

/// An upper bound of the speed at a row [m/s]: a mean over k ticks, plus the error of the steps, plus the change that the
/// largest force makes in that time; the least of this for k = 1, 4 and 16.
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

/// A sentence if the stated numbers contradict themselves or the mass of the recording; else empty.
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

/// Runs the ledger of the device `told` over the recording, from the slowest row of each of its `starts` parts to the end.
/// `trace`, if given, gets the value of the first of these runs and its limit for each row [J].
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
      if (dt > 5.0 * usual) break;  // the force in a gap is unknown
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
