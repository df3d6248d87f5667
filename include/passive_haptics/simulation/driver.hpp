// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The parameters of a simulated device, and the driver between a command and its motors.
//
//   device_parameters   every number of the device, with its unit and default
//   driver              refuses a force that is not finite, saturates and delays it: returns the force that is held
//   driven_time         how much of a period the force lasts before the watchdog drops it

#include <passive_haptics/base/parameter.hpp>
#include <passive_haptics/simulation/components.hpp>

#include <array>
#include <cmath>
#include <limits>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {

/// The defaults are the ideal device of docs/design/mathematics.md § 5. Vectors are written
/// {x, y, z}, and as a plain number for one degree of freedom.
template <class Space>
struct device_parameters {
  using coordinates = typename physical<Space>::coordinates;
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr int max_latency = 8;
  // g++ 12 crashes if a default below is the first call of a function, in a device that is itself a member of a
  // class; this call comes earlier.
  static_assert((static_cast<void>(every_axis<Space>(infinity)), true));

  double mass = 0.1;                                 ///< m [kg], the same along every axis
  double damping = 0.03;                             ///< b [N·s/m]
  double friction = 0.0;                             ///< f_c [N], Coulomb, per axis
  double force_limit = infinity;                     ///< largest ‖f‖ [N]; the direction is kept
  double quantum = 0.0;                              ///< positions are floored to multiples [m]
  coordinates lower = every_axis<Space>(-infinity);  ///< end stops [m], inelastic
  coordinates upper = every_axis<Space>(infinity);   ///< end stops [m], inelastic
  coordinates load{};                                ///< constant force, such as a weight [N]
  coordinates gain = every_axis<Space>(1.0);         ///< newtons delivered for each newton held
  double period = 1e-3;                              ///< T [s]
  coordinates start{};                               ///< position [m]
  coordinates start_velocity{};                      ///< [m/s]
  int substeps = 20;           ///< computations of the hand's force per period
  int latency = 0;             ///< periods from a command to its holding
  double watchdog = infinity;  ///< a force is held no longer than this [s]

  [[nodiscard]] parameter_fault check() const noexcept {
    const auto finite = [](double x) { return kernels::is_finite(x); };
    if (!(mass > 0.0) || !finite(mass)) return {"mass", mass, "finite and > 0 kg"};
    if (!(damping >= 0.0) || !finite(damping)) return {"damping", damping, "finite and ≥ 0 N·s/m"};
    if (!(friction >= 0.0) || !finite(friction)) return {"friction", friction, "finite and ≥ 0 N"};
    if (!(force_limit >= 0.0)) return {"force_limit", force_limit, "≥ 0 N"};
    if (!(quantum >= 0.0) || !finite(quantum)) return {"quantum", quantum, "finite and ≥ 0 m"};
    for (int i = 0; i < Space::dof; ++i) {
      const double x = component(start, i);
      const double low = component(lower, i);
      if (!(low < component(upper, i))) return {"lower", low, "< upper on every axis"};
      if (!finite(x) || x < low || x > component(upper, i)) {
        return {"start", x, "finite and between the end stops"};
      }
      const double v = component(start_velocity, i);
      if (!finite(v)) return {"start_velocity", v, "finite"};
      if (!finite(component(load, i))) return {"load", component(load, i), "finite"};
      if (!finite(component(gain, i))) return {"gain", component(gain, i), "finite"};
    }
    if (!(period > 0.0) || !finite(period)) return {"period", period, "finite and > 0 s"};
    if (substeps < 1 || substeps > 10000) return {"substeps", double(substeps), "1 to 10000"};
    if (latency < 0 || latency > max_latency) return {"latency", double(latency), "0 to 8 periods"};
    if (!(watchdog > 0.0)) return {"watchdog", watchdog, "> 0 s"};
    return {};
  }
};

/// The force commanded in period n is held during period n + latency; before the first it holds zero. A
/// command that is not finite is held as zero, as by a real driver.
template <class Space>
class driver {
 public:
  using vector = typename Space::vector;
  using parameters = device_parameters<Space>;

  explicit driver(const parameters& p) noexcept : limit_(p.force_limit), latency_(p.latency) {
    queue_.fill(Space::zero());
  }

  /// Takes the command of this period and returns the force held during it, both [N].
  [[nodiscard]] vector next(const vector& command) noexcept {
    const std::size_t last = static_cast<std::size_t>(latency_);
    for (std::size_t j = last; j > 0; --j) queue_[j] = queue_[j - 1];
    queue_[0] = Space::is_finite(command) ? saturated(command) : Space::zero();
    return queue_[last];
  }
  /// The force [N] that next(command) would return.
  [[nodiscard]] vector upcoming(const vector& command) const noexcept {
    return driver(*this).next(command);
  }

 private:
  [[nodiscard]] vector saturated(const vector& command) const noexcept {
    return to_port<Space>(clamp_norm<Space>(to_physical<Space>(command), limit_));
  }

  double limit_;
  int latency_;
  std::array<typename Space::coordinates, parameters::max_latency + 1> queue_{};
};

/// The time [s] for which the force is held in a period: all of it, or until the watchdog drops it. The two
/// are compared in the scalar of the port, so that a period equal to the watchdog's time does not trip it.
template <class Space>
[[nodiscard]] double driven_time(typename Space::scalar period, double watchdog) noexcept {
  const auto limit = static_cast<typename Space::scalar>(watchdog);
  return static_cast<double>(period > limit ? limit : period);
}

/// The position that the encoders show [m]: the true one floored to a multiple of `quantum` [m], in the
/// Space's own scalar.
template <class Space>
[[nodiscard]] typename Space::vector measured(const typename physical<Space>::vector& position,
                                              double quantum) noexcept {
  if (!(quantum > 0.0)) return to_port<Space>(position);
  typename physical<Space>::vector seen = position;
  for (int i = 0; i < Space::dof; ++i) {
    component(seen, i) = std::floor(component(position, i) / quantum) * quantum;
  }
  return to_port<Space>(seen);
}

}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
