// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Static conditions: the largest stiffness of a loop WITHOUT an energy bound, from its constants alone.
// Everything here is constexpr, in double, and not used in a tick.
//
//   passivity::     no passive hand can ever draw energy from the device
//     colgate_schenkel   K < 2 (b − |D|)/T           a fixed virtual wall; any H(z); delay
//     delayed_wall       the exact kernel            delay AND virtual damping, less conservative
//     coupling           K_c < 2 (b − |D_c|)/T       a virtual coupling to a fixed wall
//     adams_hannaford    b > sin²(θ/2)/Re(1/Z_c)     a virtual coupling to ANY passive world
//     abbott_okamura     K ≤ min(2b/T, 2f_c/Δ)       encoder steps, paid for by dry friction
//     diolaiti           β ≥ ½ + k, σ ≥ ½            the same with delay
//   stability::     the device alone comes to rest; a hand may still draw energy
//     gil_hulin          K < (b + D)/(T/2 + t_d)     virtual damping D raises K here, and lowers it above
//
// Never mix the two kinds. All of them assume a fixed surface of constant stiffness; one that moves or changes
// voids them, and needs an energy bound.
//
// With an energy bound, design/stiffness_budget.hpp has the largest stiffness that the ledger sustains.
// identification/device_facts.hpp has published data of devices.

#include <passive_haptics/base/parameter.hpp>
#include <passive_haptics/design/frequency.hpp>

#include <limits>

namespace passive_haptics {
inline namespace v0 {
namespace design {

/// The constants of a loop: a device of damping b that is sampled every T and whose force is held between samples. A
/// condition that does not cover sensor steps, delay or virtual damping returns 0 or −∞ if there are any. Dry
/// friction only helps; most conditions do not use it.
struct loop {
  double damping = 0.0;          ///< b of the device [N·s/m], a lower bound
  double period = 1e-3;          ///< T [s], the longest
  int delay = 0;                 ///< k = t_d/T, from sample to force, rounded up [ticks]
  double virtual_damping = 0.0;  ///< D (of a coupling: D_c) [N·s/m]
  double friction = 0.0;         ///< f_c, dry friction of the device [N], a lower bound
  double quantum = 0.0;          ///< Δ, step of the position sensor [m]

  [[nodiscard]] constexpr double half_period_and_delay() const noexcept {
    return period * (0.5 + delay);
  }
  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    const auto finite = [](double x) { return kernels::is_finite(x); };
    if (!(damping >= 0.0) || !finite(damping)) return {"damping", damping, "finite and ≥ 0 N·s/m"};
    if (!(period > 0.0) || !finite(period)) return {"period", period, "finite and > 0 s"};
    if (delay < 0) return {"delay", static_cast<double>(delay), "≥ 0 ticks"};
    if (!finite(virtual_damping)) return {"virtual_damping", virtual_damping, "finite"};
    if (!(friction >= 0.0) || !finite(friction)) return {"friction", friction, "finite and ≥ 0 N"};
    if (!(quantum >= 0.0) || !finite(quantum)) return {"quantum", quantum, "finite and ≥ 0 m"};
    return {};
  }
};

namespace detail {
inline constexpr double nothing_is_safe = -std::numeric_limits<double>::infinity();

/// b − the largest `needed(w)` over the grid [N·s/m].
[[nodiscard]] constexpr double margin(const loop& l, frequency_grid grid, auto needed) noexcept {
  if (l.check() || grid.points < 1 || grid.octaves < 0 || grid.octaves > 40) return nothing_is_safe;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < grid.size(); ++i) {
    const double left = l.damping - needed(grid.at(i));
    if (!(left >= least)) least = left;  // a NaN is taken
    if (!(least == least)) return nothing_is_safe;
  }
  return least;
}
}  // namespace detail

/// A largest stiffness [N/m] is the supremum of the passive ones; it is 0 if none is passive, or if a constant is out
/// of its range. A margin [N·s/m] is the damping b less the least that is needed: > 0 is passive, and −∞ means
/// that a constant is out of its range or not covered, or that the transfer function returned NaN.
namespace passivity {

/// Largest K of a fixed wall H(z) = z⁻ᵏ (K + D (1 − z⁻¹)/T):   b > K (T/2 + t_d) + |D|
/// Colgate and Schenkel (1994, 1997), confirmed in two secondary sources and derived in § 2(g).
/// It is exact for k = 0 or D = 0, and sufficient otherwise. It assumes exact positions, equal ticks and a passive
/// hand. A unilateral wall needs no more damping (§ 2(g) 1, for k = 0 and D ≥ 0).
[[nodiscard]] constexpr double colgate_schenkel(const loop& l) noexcept {
  if (l.check() || l.quantum > 0.0) return 0.0;
  const double left = l.damping - kernels::magnitude(l.virtual_damping);
  return kernels::larger(left, 0.0) / l.half_period_and_delay();
}

/// Margin [N·s/m] of any stable H(z) from position [m] to reaction [N], given as H(frequency). H includes its own
/// damping, but not the delay of the loop, which is added here:
///     b > T/2 · Re{(1 − e⁻ʲᶿ) H}/(1 − cos θ) = T/2 · (Re H − cot(θ/2) Im H)      0 < θ ≤ π
/// Source and assumptions are the same; it is necessary and sufficient for a linear H, at the frequencies of the grid.
template <class H>
[[nodiscard]] constexpr double colgate_schenkel(const loop& l, H transfer,
                                                frequency_grid grid = {}) noexcept {
  if (l.quantum > 0.0 || l.virtual_damping != 0.0) return detail::nothing_is_safe;
  return detail::margin(l, grid, [&](frequency w) {
    const complex h = w.delay(l.delay) * transfer(w);
    const complex half = cos_sin(w.angle / 2.0);
    return l.period / 2.0 * (h.re - half.re / half.im * h.im);
  });
}

/// Damping [N·s/m] that a fixed wall K, D needs at one frequency, after k ticks of delay:
///     K T/2 · sin((2k + 1)θ/2)/sin(θ/2) − D cos((k + 1)θ)
/// The first factor is the Dirichlet kernel, 2k + 1 at θ = 0, which gives K (T/2 + t_d). (§ 2(g) 2)
[[nodiscard]] constexpr double needed_damping(const loop& l, double stiffness,
                                              frequency w) noexcept {
  const double kernel = cos_sin((2 * l.delay + 1) * w.angle / 2.0).im / cos_sin(w.angle / 2.0).im;
  return stiffness * l.period / 2.0 * kernel -
         l.virtual_damping * cos_sin((l.delay + 1) * w.angle).re;
}

/// Margin [N·s/m] of a fixed wall of stiffness K [N/m] by the exact needed_damping. It is never less than the margin
/// of colgate_schenkel(loop), and larger if there are both delay and virtual damping.
[[nodiscard]] constexpr double delayed_wall(const loop& l, double stiffness,
                                            frequency_grid grid = {}) noexcept {
  if (l.quantum > 0.0 || !(stiffness >= 0.0)) return detail::nothing_is_safe;
  return detail::margin(l, grid, [&](frequency w) { return needed_damping(l, stiffness, w); });
}

/// Largest K_c [N/m] of a virtual coupling K_c, D_c to a fixed wall of any stiffness K: K_c < 2(b − |D_c|)/T, and
/// with delay as in colgate_schenkel. The stiffness felt is 1/(1/K_c + 1/K) ≤ K_c. (§ 2(g) 1)
[[nodiscard]] constexpr double coupling(const loop& l) noexcept {
  return colgate_schenkel(l);
}

/// Margin [N·s/m] of a virtual coupling Z_c(z), from velocity Δx/T [m/s] to force [N], to EVERY world that
/// is passive in discrete time, Σ F v T ≥ 0 with v the backward difference: spring, mass, damper.
///     b > sin²((k + 1)θ/2)/Re(1/Z_c),   Re(1/Z_c) > 0                            0 < θ ≤ π
/// For example [=](frequency w) { return D_c + K_c * T / w.difference(); } with D_c ≥ 0 and k = 0
/// gives K_c < 2(b − D_c)/T.
///
/// This is Llewellyn's criterion of Adams and Hannaford (1999) for an impedance display, with the exact hold instead
/// of (1 + z⁻¹)/2, which would accept a pure spring of up to 8b/T. The proof is ours: § 2(g) 5.
template <class Z>
[[nodiscard]] constexpr double adams_hannaford(const loop& l, Z coupling_impedance,
                                               frequency_grid grid = {}) noexcept {
  if (l.quantum > 0.0 || l.virtual_damping != 0.0) return detail::nothing_is_safe;
  return detail::margin(l, grid, [&](frequency w) {
    const double mobility = (1.0 / coupling_impedance(w)).re;
    const double sine = cos_sin((l.delay + 1) * w.angle / 2.0).im;
    return mobility > 0.0 ? sine * sine / mobility : std::numeric_limits<double>::infinity();
  });
}

/// Largest K [N/m] of a fixed wall on one axis with sensor steps Δ, in terms of β = b/(KT) and σ = f_c/(KΔ):
///     β ≥ ½ + t_d/T and σ ≥ ½,   K ≤ min(b/(T/2 + t_d), 2 f_c/Δ)
/// Diolaiti and others (2006), confirmed in one secondary source; the proof is ours: § 2(g) 3. The borders of their
/// other regions (limit cycles, local stability) are not confirmed and not offered. With virtual damping it
/// returns 0, because quantised velocity is not covered.
[[nodiscard]] constexpr double diolaiti(const loop& l) noexcept {
  if (l.check() || l.virtual_damping != 0.0) return 0.0;
  const double sampled = l.damping / l.half_period_and_delay();
  return l.quantum > 0.0 ? kernels::smaller(sampled, 2.0 * l.friction / l.quantum) : sampled;
}

/// The same without delay, K ≤ min(2b/T, 2 f_c/Δ): Abbott and Okamura (2005), from one secondary source.
[[nodiscard]] constexpr double abbott_okamura(const loop& l) noexcept {
  return l.delay == 0 ? diolaiti(l) : 0.0;
}

}  // namespace passivity

/// Conditions under which the device without a hand comes to rest. They do not limit the energy that a hand can draw.
namespace stability {

/// Largest K of a linear spring and damper against a free mass: K < (b + D)/(T/2 + t_d)
/// Gil and others, Hulin and others (form from memory). It is no guarantee: in exact simulation with m = 0.05 to
/// 0.5 kg, k = 0 to 5 and b ≤ 0.3 N·s/m the true limit is less than 1 % above it for D = 0, but with virtual damping
/// BELOW it, by up to 5 % at D = 1 and 27 % at D = 5 N·s/m.
[[nodiscard]] constexpr double gil_hulin(const loop& l) noexcept {
  if (l.check() || l.quantum > 0.0) return 0.0;
  return kernels::larger(l.damping + l.virtual_damping, 0.0) / l.half_period_and_delay();
}

}  // namespace stability
}  // namespace design
}  // namespace v0
}  // namespace passive_haptics
