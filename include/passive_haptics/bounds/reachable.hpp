// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The bound that knows the device's mass: only what the next tick can reach must be covered.

#include <passive_haptics/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

/// F s − B s² ≤ E1 for every outward travel s that the next tick can reach (§ 2(a'), § 9). A device
/// of mass m that is moving in cannot turn round within a tick, so pressing is hardly bounded; a
/// device moving out is bounded as strictly as it must be.
///
/// Passive (E1 ≥ 0) under ALL of these, and no others are needed:
///   - the apparent mass along the force is at least `mass`, whatever the pose;
///   - hand, load and dry friction together push with at most `hand_force`, and the damper with at
///     most 2b|Δx|/T, twice its mean over the last tick;
///   - strict_bound's own: b a lower bound, ticks ≤ longest_tick, exact positions, held force known.
/// Outside them (a velocity source as hand, a quantised position, ticks that vary: Δx/T estimates
/// the speed from the tick before) it can lose energy, and tests show it doing so.
template <class Space>
struct reachable_bound {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr guarantee passivity = guarantee::conditional;
  static constexpr bound_traits traits{.only_reduces = true, .needs_ledger = true};

  scalar mass{};        ///< smallest apparent mass of the device [kg]
  scalar hand_force{};  ///< largest force of everything but motors and damper [N]

  [[nodiscard]] constexpr vector limit(const vector& desired, const auto& state) const noexcept {
    const scalar outflow = state.damping.worst_outflow(desired, state.longest_tick);
    const scalar credit = state.credit();
    if (outflow <= kernels::spendable(credit)) return desired;  // by the worst motion of all
    const scalar force = Space::norm(desired);
    if (!(force > scalar(0))) return desired;

    const scalar B = state.damping.per_tick(desired, state.longest_tick);
    scalar outward = Space::dot(state.displacement, desired) / force;
    scalar moved = Space::norm(state.displacement);
    outward += kernels::rounding<scalar>() * moved;
    if (state.displacement_error > scalar(0)) {
      outward += state.displacement_error;
      moved += state.displacement_error;
    }
    const scalar damper = scalar(2) * B * moved;
    const scalar reach =
        state.motion_known
            ? kernels::outward_reach(outward, Space::norm(state.held), force, hand_force + damper,
                                     mass, state.dt, state.longest_tick)
            : std::numeric_limits<scalar>::max();  // it may be moving out at any speed
    const scalar most = state.damping.friction() + kernels::reachable_force_bound(credit, B, reach);
    return most < force ? vector(desired * (most / force)) : desired;
  }
  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept {
    if (!(mass > scalar(0)) || !kernels::is_finite(mass))
      return {"mass", mass, "finite and > 0 kg"};
    if (!(hand_force >= scalar(0)) || !kernels::is_finite(hand_force)) {
      return {"hand_force", hand_force, "finite and ≥ 0 N"};
    }
    return {};
  }
};

static_assert(force_bound_for<reachable_bound<space<float, 1>>, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
