// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The largest stiffness of a wall with a passivity guarantee for which the ledger of a stated device is not used up.
//
//     constexpr design::stated_device grip{.mass = 0.045, .damping = 0.05, .friction = 0.13,
//                                          .presliding = 15e-6, .quantum = 55e-6, .force_limit = 3.3};
//     constexpr auto budget = design::stiffness_budget(grip);     // 2012 N/m
//     std::puts(budget.because());                                // what binds, and what raises it
//     ph::capped law{ph::damped_spring{.mass = grip.mass}, budget.stiffness};
//
// A bound that spends only what the ledger holds is passive with any stiffness. But if the wall is too stiff, each
// encoder step of a swing drains the ledger, and when it is empty the hand sinks in. A swing of S [N] at the speed
// v [m/s] is paid for, in joules per metre of motion, if
//
//     K (q/2 + max(r, v T/2) + k v T) ≤ c + b v − 2 c p/D,     D = S/K the depth of the swing
//
// The left side is the cost of positions known to a step: q/2 for each newton of change of the force, and the lag of
// the held force, which is r = q/3 + q/6 min(1, 4 q/D) with an edge_observer, v T/2 by motion between two samples and
// k v T by latency. The right side is the energy that dry friction and damping take, less the energy that presliding
// p returns at every reversal. There are two more limits: K ≤ 2 c/q, for the chatter of a hand that holds still at
// the edge of a step (Abbott and Okamura, 2005), and K ≤ κ m/((2k + 1) T)², at which a sampled mass settles.
// (Ours; docs/design/mathematics.md § 6 and § 9)
//
// A hand that kneads f times a second with a force F is no faster than v = π f F/K. Of its swing H [N] the wall gets
// S = H − 2 c, or H − 4 c if the device has twice the stated friction. A swing within the presliding earns nothing:
// for c > K p, edge_observer rests during it, and with another estimator each step of it costs `crossing`
// (docs/design/encoders.md). Without dry friction no stiff wall is guaranteed, and the budget is 0.

#include <passive_haptics/design/described_device.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace passive_haptics {
inline namespace v0 {
namespace design {

using stated_device = encoder_device;

/// The motions of the hand under which the wall has to last.
struct intended_use {
  double slowest = 5e-3;            ///< speed of the slowest kneading [m/s]
  double fastest = 12e-3;           ///< speed of the fastest kneading [m/s]
  double frequency = 2.0;           ///< f of the fastest kneading: v ≤ π f `force`/K [Hz]
  double swing = 0.4;               ///< S, least swing of the wall's force [N]
  double hand_swing = 0.9;          ///< H, least swing of the hand's force [N]; S ≥ H − 4 c
  double force = 3.0;               ///< F, the wall's force [N], at most the motors' limit
  double hand_force = 5.0;          ///< largest force of the hand [N]
  double stiffness_fraction = 0.1;  ///< κ, as in damped_spring

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    using passive_haptics::detail::not_negative, passive_haptics::detail::positive;
    if (!positive(slowest)) return {"slowest", slowest, "finite and > 0 m/s"};
    const bool in_order = fastest >= slowest && positive(fastest);
    if (!in_order) return {"fastest", fastest, "finite and ≥ slowest"};
    if (!positive(frequency)) return {"frequency", frequency, "finite and > 0 Hz"};
    if (!positive(swing)) return {"swing", swing, "finite and > 0 N"};
    if (!not_negative(hand_swing)) return {"hand_swing", hand_swing, "finite and ≥ 0 N"};
    if (!(force >= 0.0)) return {"force", force, "≥ 0 N"};
    if (!(hand_force >= 0.0)) return {"hand_force", hand_force, "≥ 0 N"};
    if (!(stiffness_fraction > 0.0 && stiffness_fraction <= 1.0)) {
      return {"stiffness_fraction", stiffness_fraction, "in (0, 1]"};
    }
    return {};
  }
  /// In N·m and rad for a device that turns, unless it is so stated: the defaults are those of a finger on 10 N, and a
  /// knob of 0.1 N·m feels them at a lever of 10 mm, as a smaller one does their speeds: nothing turns faster by fingers.
  [[nodiscard]] constexpr intended_use on(const stated_device& d) const noexcept {
    const intended_use usual{
        .frequency = frequency, .hand_force = hand_force, .stiffness_fraction = stiffness_fraction};
    if (!d.rotary || *this != usual) return *this;
    const double r = d.force_limit / 10.0, wide = kernels::larger(r, 0.01);
    const double hand = hand_force == intended_use{}.hand_force ? r : 1.0;
    return {slowest / wide, fastest / wide, frequency,         swing * r,
            hand_swing * r, force * r,      hand_force * hand, stiffness_fraction};
  }
  constexpr bool operator==(const intended_use&) const noexcept = default;
};

enum class stiffness_limit : std::uint8_t {
  sampled_mass,   ///< κ m/((2k + 1) T)²: the force lags by (k + 1/2) T
  slow_kneading,  ///< the inequality above at the slowest speed
  fast_kneading,  ///< the same at the fastest speed, where sampling costs more than the steps
  holding,        ///< 2 c/q, for chatter at the edge of a step
  not_stated,     ///< a parameter is out of its range
};

[[nodiscard]] constexpr const char* to_string(stiffness_limit limit) noexcept {
  constexpr const char* names[] = {"sampled mass", "slow kneading", "fast kneading",
                                   "holding still", "not stated"};
  return limit <= stiffness_limit::not_stated ? names[static_cast<int>(limit)] : "unknown limit";
}

struct budget {
  double stiffness = 0.0;  ///< K [N/m], the least of the limits
  stiffness_limit binding = stiffness_limit::not_stated;
  std::array<double, 4> limits{};  ///< each limit, in the order of stiffness_limit [N/m]
  double working_capital = 0.0;    ///< F (q/2 + reach of the next k + 1 ticks) [J], for the force F
  double loan = 0.0;      ///< F_max q [J], a loan for a stiff first touch; E ≥ −loan then
  double crossing = 0.0;  ///< cost of crossing an edge at K, within presliding [J]

  [[nodiscard]] constexpr double limit(stiffness_limit which) const noexcept {
    const auto i = static_cast<std::size_t>(which);
    return i < limits.size() ? limits[i] : 0.0;
  }
  /// One sentence on the limit that binds, and what would raise it.
  [[nodiscard]] constexpr const char* because() const noexcept {
    constexpr const char* sentences[] = {
        "A mass sampled so slowly can be held with no more than kappa m/T^2: a faster loop or a "
        "heavier grip raises it.",
        "Kneading slowly, friction and damping pay for some (c + b v)/(q + 2 c p/S): finer "
        "encoders, more sure friction or less presliding raise it.",
        "Kneading fast, sampling costs more than friction and damping take: a faster loop raises "
        "it.",
        "A hand that holds still at the edge of a step makes the force chatter by K q, which "
        "friction covers up to 2 c: finer encoders raise it.",
        "A parameter is out of its range: ask check()."};
    static_assert(sizeof sentences / sizeof *sentences == int(stiffness_limit::not_stated) + 1);
    if (binding == stiffness_limit::holding && !(stiffness > 0.0)) {
      return "No dry friction is stated, so nothing pays for the encoders' steps at rest: a stiff "
             "wall cannot be guaranteed on this device.";
    }
    return binding <= stiffness_limit::not_stated ? sentences[static_cast<int>(binding)] : "";
  }
};

namespace detail {

/// The right side less the left side of the inequality above, for swings of S newtons at a speed v [J/m].
[[nodiscard]] constexpr double surplus(const stated_device& d, double K, double v,
                                       double swing) noexcept {
  const double q = d.quantum, way = v * d.longest_tick;
  const double lag = q / 3.0 + q / 6.0 * kernels::smaller(1.0, 4.0 * q * K / swing);
  const double known = q / 2.0 + kernels::larger(lag, way / 2.0) + d.latency * way;
  const double turned = d.friction > 0.0 ? 2.0 * d.friction * d.presliding / swing : 0.0;
  return d.friction + d.damping * v - K * (known + turned);
}

/// The largest K [N/m] whose surplus is ≥ 0 at the speed v = min(most, push/K), but at least `slowest`;
/// `push` is π f F [N/s].
[[nodiscard]] constexpr double kneaded(const stated_device& d, double slowest, double most,
                                       double push, double swing) noexcept {
  const double least_known = d.quantum * 5.0 / 6.0, way = slowest * d.longest_tick / 2.0;
  double low = 0.0;
  double high =
      (d.friction + d.damping * most) / kernels::larger(least_known, d.quantum / 2.0 + way);
  for (int i = 0; i < 60; ++i) {
    const double K = (low + high) / 2.0;
    const double v = kernels::larger(slowest, kernels::smaller(most, push / K));
    (K > 0.0 && surplus(d, K, v, swing) >= 0.0 ? low : high) = K;
  }
  return low;
}

/// K q min(q, p) [J], the cost of each crossing in a swing to and fro over one edge (§ 6): q/2 for each newton of
/// change of the force, and as much again because the held force is that of the sample before; or p for each newton
/// if the friction force follows the change. Without friction it is K q².
[[nodiscard]] constexpr double crossing(const stated_device& d, double K) noexcept {
  return K * d.quantum * (d.friction > 0.0 ? kernels::smaller(d.presliding, d.quantum) : d.quantum);
}

}  // namespace detail

/// The largest stiffness that the ledger of this device sustains in that use. The surplus is concave in v, so it is
/// least at the slowest or the fastest speed.
[[nodiscard]] constexpr budget stiffness_budget(const stated_device& device,
                                                intended_use use = {}) noexcept {
  if (device.check() || use.check()) return {};
  use = use.on(device);
  const double T = device.longest_tick, q = device.quantum;
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  budget b;
  const double F = kernels::smaller(use.force, device.force_limit);
  const double swing = kernels::larger(use.swing, use.hand_swing - 4.0 * device.friction);
  const double fastest = 3.14159265358979323846 * use.frequency * F;  // change of F [N/s]
  const double late = (2.0 * device.latency + 1.0) * T;
  b.limits = {use.stiffness_fraction * device.mass / (late * late),
              detail::kneaded(device, use.slowest, use.slowest, 0.0, swing),
              detail::kneaded(device, use.slowest, use.fastest, fastest, swing),
              q > 0.0 ? 2.0 * device.friction / q : unlimited};
  b.stiffness = unlimited;
  for (std::size_t i = 0; i < b.limits.size(); ++i) {
    if (b.limits[i] < b.stiffness) {
      b.stiffness = b.limits[i];
      b.binding = static_cast<stiffness_limit>(i);
    }
  }
  const double faster = (F + use.hand_force) * T * T / device.mass;  // travel added per tick [m]
  const double ticks = device.latency + 1.0;  // A latency may be any int; its sums must not wrap.
  const double reach = ticks * (q + (ticks + 1.0) / 2.0 * faster);
  b.working_capital = F * (q / 2.0 + reach);
  b.loan = device.force_limit * q;
  b.crossing = detail::crossing(device, b.stiffness);
  return b;
}

}  // namespace design
}  // namespace v0
}  // namespace passive_haptics
