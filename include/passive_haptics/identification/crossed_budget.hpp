// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The largest stiffness of a wall that a crossed_ledger with a middle_observer sustains, and whether they pay at all.
//
//     constexpr auto told = design::crossing_of(wheel);
//     if (told.pays) …                               // else what make_touch composes; told.because says why
//     constexpr auto budget = design::crossed_budget(wheel);

#include <passive_haptics/design/stiffness_budget.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace design {

/// What a crossed_ledger is worth on a device.
struct crossing {
  double rho = 0.0;  ///< (hand_force + F) T²/(m q), the way that a push adds in a tick, over a step
  bool pays = false;  ///< ρ < ½ and 2p ≤ q
  const char* because = "";
};

/// Whether to take a crossed_ledger and a middle_observer. From ρ = 2 on, a tick later the device can be anywhere in the
/// step, and below that little is known up to ½. Where p is larger than half a step, an observer that rests within the
/// presliding keeps more of a wall under a tremor. (docs/design/encoders.md)
[[nodiscard]] constexpr crossing crossing_of(const stated_device& d,
                                             intended_use use = {}) noexcept {
  if (d.check() || use.check()) return {.because = "A parameter is out of its range: ask check()."};
  use = use.on(d);
  if (!(d.quantum > 0.0 && d.friction > 0.0)) {
    return {.because = "Without steps nothing is unknown, and without friction nothing is paid."};
  }
  const double push = use.hand_force + kernels::smaller(use.force, d.force_limit);
  const double rho = push * d.longest_tick * d.longest_tick / (d.mass * d.quantum);
  if (!(rho < 0.5)) {
    return {rho, false,
            "A push moves the device by too much of a step in a tick: a faster loop, a heavier "
            "grip or coarser steps would pay. Take edge_observer; a crossed_ledger does no harm."};
  }
  if (2.0 * d.presliding > d.quantum) {
    return {
        rho, false,
        "The friction gives way by more than half a step: take edge_observer, which rests within "
        "the presliding; a crossed_ledger does no harm."};
  }
  return {rho, true, "Steps are known well where they are crossed."};
}

namespace detail {
/// δ [m], how deep beyond an edge a device is known to be that went on at v [m/s]; `bend` is α T² [m].
[[nodiscard]] constexpr double known_depth(const stated_device& d, double bend, double v) noexcept {
  double depth = d.quantum;
  for (int J = 1; J < 32 && (J + 1) * v * d.longest_tick <= d.quantum; ++J) {
    depth = kernels::smaller(depth, d.quantum / (J + 1) + bend * J / 2.0);
  }
  return depth + kernels::larger(v * d.longest_tick - d.quantum, 0.0) / 2.0;
}
/// Whether swings of S newtons at v [m/s] pay for a wall of K [N/m]: the inequality of crossed_budget.
[[nodiscard]] constexpr bool crossings_pay(const stated_device& d, double K, double v, double S,
                                           double bend) noexcept {
  const double q = d.quantum, c = d.friction;
  const double known = known_depth(d, bend, v) + d.latency * v * d.longest_tick;
  const double turns = (q * q * K / 2.0 + 2.0 * c * d.presliding) / S;
  return K * (known + turns) <= c * (1.0 - q * K / (2.0 * S)) + d.damping * v;
}
}  // namespace detail

/// stiffness_budget for a crossed_ledger with a middle_observer; that itself where it is larger, or where crossing does
/// not pay. A swing of S [N] that is D = S/K deep crosses N = D/q edges each way. It pays 2 N K q δ for the changes of
/// the force, and K q² for the play of one edge; it earns 2 N c q, less c q for the turns. In joules per metre of the way
///     K (δ + q²/(2D) + 2 c p/S + k v T) ≤ c (1 − q/(2D)) + b v
///     δ = the least of q and q/(J + 1) + ½ α J T², (J + 1) v T ≤ q,   α = (hand_force + F)/m
/// The friction's changes at both turns cost 2 c q if they are made at once. That half of it is enough is measured, for
/// 4p ≤ q, not proved (tests/identification/crossed_budget.cpp); a bound is passive with any stiffness.
[[nodiscard]] constexpr budget crossed_budget(const stated_device& device,
                                              intended_use use = {}) noexcept {
  use = use.on(device);
  budget b = stiffness_budget(device, use);
  const crossing told = crossing_of(device, use);
  if (!told.pays) return b;
  const double q = device.quantum;
  const double F = kernels::smaller(use.force, device.force_limit);
  const double S = kernels::larger(use.swing, use.hand_swing - 4.0 * device.friction);
  for (const auto which : {stiffness_limit::slow_kneading, stiffness_limit::fast_kneading}) {
    const double most = which == stiffness_limit::slow_kneading ? use.slowest : use.fastest;
    constexpr double half_turn = 3.14159265358979323846;
    double low = 0.0, high = 2.0 * S / q;
    for (int i = 0; i < 60; ++i) {
      const double K = (low + high) / 2.0;
      const double v = kernels::smaller(most, half_turn * use.frequency * F / K);
      (detail::crossings_pay(device, K, kernels::larger(use.slowest, v), S, told.rho * q) ? low
                                                                                          : high) =
          K;
    }
    double& limit = b.limits[static_cast<std::size_t>(which)];
    limit = kernels::larger(limit, low);
  }
  b.stiffness = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < b.limits.size(); ++i) {
    if (!(b.limits[i] < b.stiffness)) continue;
    b.stiffness = b.limits[i];
    b.binding = static_cast<stiffness_limit>(i);
  }
  b.crossing = detail::crossing(device, b.stiffness);
  return b;
}

}  // namespace design
}  // namespace v0
}  // namespace passive_haptics
