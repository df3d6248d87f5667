// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The numbers of a device on which a guarantee rests: mass, damping and friction are lower bounds, the rest are upper
// bounds, in SI units. identification.hpp measures them, at three standard deviations and less a drift of 30 %.
//
//   exact_device     for position steps too small to be felt: positions count as exact
//   encoder_device   for encoder steps that can be felt, with known dry friction
//
// For a device that turns, `rotary` is true, and rad stands for m, N·m for N and kg·m² for kg. check() refuses an
// impossible value; doubt() names a possible one that is almost surely a slip, such as milliseconds for seconds.

#include <passive_haptics/base/parameter.hpp>

#include <limits>

namespace passive_haptics {
inline namespace v0 {

struct exact_device {
  double mass{};               ///< m, smallest apparent mass, over all directions and poses [kg]
  double damping{};            ///< b [N·s/m]
  double force_limit{};        ///< F, the most that the motors hold [N]
  double longest_tick = 1e-3;  ///< T, the worst tick of YOUR loop [s]
  int latency = 0;             ///< k, ticks by which the force is late, as in late_loop_limits<k>
  bool rotary = false;         ///< true if it turns: rad, N·m, kg·m²
  double top_speed = 0;        ///< a faster sample is rejected [m/s]; 0: 5 m/s, or 500 rad/s

  [[nodiscard]] constexpr parameter_fault check() const noexcept;
  [[nodiscard]] constexpr parameter_fault doubt() const noexcept;
};

struct encoder_device {
  double mass{};               ///< m, smallest apparent mass, over all directions and poses [kg]
  double damping{};            ///< b [N·s/m]
  double friction{};           ///< c, dry friction [N], its least level
  double presliding = none;    ///< p [m], over which friction is elastic; needed for c > 0
  double quantum{};            ///< q [m], position step plus peak-to-peak noise
  double force_limit{};        ///< F, the most that the motors hold [N]
  double longest_tick = 1e-3;  ///< T, the worst tick of YOUR loop [s]
  int latency = 0;             ///< k, ticks by which the force is late, as in late_loop_limits<k>

  double continuous_force = detail::no_limit;  ///< force that they hold without time limit [N]
  double winding_time = 0.0;  ///< thermal time constant [s]; needed if that is less than F
  bool rotary = false;        ///< true if it turns: rad, N·m, kg·m²
  double top_speed = 0;       ///< a faster sample is rejected [m/s]; 0: 5 m/s, 500 rad/s, or 8 q/T

  [[nodiscard]] constexpr parameter_fault check() const noexcept;
  [[nodiscard]] constexpr parameter_fault doubt() const noexcept;

 private:
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
};

namespace detail {

template <class Device>
[[nodiscard]] constexpr parameter_fault fault_of_any(const Device& d) noexcept {
  if (!positive(d.mass)) return {"mass", d.mass, "finite and > 0 kg"};
  if (!positive(d.force_limit)) return {"force_limit", d.force_limit, "finite and > 0 N"};
  if (!positive(d.longest_tick)) return {"longest_tick", d.longest_tick, "finite and > 0 s"};
  if (d.latency < 0) return {"latency", static_cast<double>(d.latency), "≥ 0 ticks"};
  if (!not_negative(d.top_speed)) return {"top_speed", d.top_speed, "finite and ≥ 0 m/s"};
  return {};
}
template <class Device>
[[nodiscard]] constexpr parameter_fault doubt_of_any(const Device& d) noexcept {
  if (const auto fault = d.check()) return fault;
  if (d.mass > (d.rotary ? 0.5 : 20.0)) {
    return {"mass", d.mass, "seen from the hand: below 20 kg, 0.5 kg·m² of what is rotary"};
  }
  if (d.longest_tick > 0.02) {
    return {"longest_tick", d.longest_tick, "in seconds: a hand feels every tick above 20 ms"};
  }
  if (d.damping * d.longest_tick > 0.1 * d.mass) {
    return {"damping", d.damping, "≤ 0.1 m/T: more stops the device within ten ticks"};
  }
  if (d.force_limit > 500.0) return {"force_limit", d.force_limit, "what a hand survives: < 500 N"};
  if (d.latency > 100) return {"latency", static_cast<double>(d.latency), "in ticks, not in µs"};
  return {};
}
/// The top speed [m/s]: the stated one, or else the larger of 5 m/s (500 rad/s) and 8 steps q per tick T.
[[nodiscard]] constexpr double top_speed_of(double said, bool rotary, double q, double T) noexcept {
  if (said > 0.0) return said;
  return kernels::larger(rotary ? 500.0 : 5.0, 8.0 * q / T);
}

}  // namespace detail

constexpr parameter_fault exact_device::check() const noexcept {
  if (!detail::positive(damping)) return {"damping", damping, "finite and > 0 N·s/m"};
  return detail::fault_of_any(*this);
}
constexpr parameter_fault exact_device::doubt() const noexcept {
  return detail::doubt_of_any(*this);
}

constexpr parameter_fault encoder_device::check() const noexcept {
  if (const auto fault = detail::fault_of_any(*this)) return fault;
  if (!detail::not_negative(damping)) return {"damping", damping, "finite and ≥ 0 N·s/m"};
  if (!detail::not_negative(friction)) return {"friction", friction, "finite and ≥ 0 N"};
  if (friction > 0.0 && !detail::not_negative(presliding)) {
    return {"presliding", presliding,
            "finite and ≥ 0 m, stated: over how far the friction is elastic"};
  }
  if (!detail::not_negative(quantum)) return {"quantum", quantum, "finite and ≥ 0 m"};
  if (!(continuous_force >= 0.0)) return {"continuous_force", continuous_force, "≥ 0 N"};
  if (continuous_force < force_limit && !detail::positive(winding_time)) {
    return {"winding_time", winding_time, "finite and > 0 s"};
  }
  return {};
}
constexpr parameter_fault encoder_device::doubt() const noexcept {
  if (const auto fault = detail::doubt_of_any(*this)) return fault;
  const double felt = rotary ? 0.1 : 2e-3;
  if (quantum > felt) return {"quantum", quantum, "≤ 2 mm, or 0.1 rad"};
  if (friction > 0.0 && presliding > felt) return {"presliding", presliding, "≤ 2 mm, or 0.1 rad"};
  if (friction > 0.5 * force_limit) return {"friction", friction, "≤ half of force_limit"};
  return {};
}

}  // namespace v0
}  // namespace passive_haptics
