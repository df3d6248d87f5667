// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The bounds that may be stated from estimates: their confidence, a margin, and the drift of a device.
//
//     stated = (1 − drift) margin (value − confidence · deviation)        of damping and of friction, from below
//     stated = margin (value − confidence · deviation)                    of mass, from below
//     stated = (value + confidence · deviation)/margin                    of presliding, latency, steps, from above
//
// Friction and damping fall as a device warms and wears, so a drift of 30 % is the default. Mass does not; and
// presliding p = c/k falls with friction c at constant stiffness k, so its upper bound needs no drift. A device that was
// warm when it was identified, and is identified again each year, may have less drift.

#include <passive_haptics/base/parameter.hpp>

#include <limits>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

/// A number and the standard deviation of its error.
struct estimate {
  double value = 0.0;
  double deviation = std::numeric_limits<double>::infinity();

  /// The bounds `deviations` standard deviations below and above the value.
  [[nodiscard]] constexpr double at_least(double deviations) const noexcept {
    return value - deviations * deviation;
  }
  [[nodiscard]] constexpr double at_most(double deviations) const noexcept {
    return value + deviations * deviation;
  }
};

struct trust {
  double confidence = 3.0;  ///< standard deviations; 1 of 740 normal errors is beyond 3 on one side
  double margin = 0.95;     ///< for systematic errors, in (0.5, 1]
  double drift =
      0.3;  ///< share of damping and friction that may be lost by warmth and wear, in [0, 1)

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!(confidence >= 1.0 && confidence <= 10.0))
      return {"confidence", confidence, "1 to 10 deviations"};
    if (!(margin > 0.5 && margin <= 1.0)) return {"margin", margin, "in (0.5, 1]"};
    if (!(drift >= 0.0 && drift < 1.0)) return {"drift", drift, "in [0, 1)"};
    return {};
  }
  /// The share that is left after the drift.
  [[nodiscard]] constexpr double kept() const noexcept { return 1.0 - drift; }
  [[nodiscard]] constexpr double at_least(const estimate& e) const noexcept {
    return margin * e.at_least(confidence);
  }
  [[nodiscard]] constexpr double at_most(const estimate& e) const noexcept {
    return e.at_most(confidence) / margin;
  }
};

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
