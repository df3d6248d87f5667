// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// reachable_bound for a device that holds a command one tick late, as every packet device does.

#include <passive_haptics/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

/// The command of tick n is held during [n+1, n+2); meanwhile h, that of n−1, is. Both must be
/// covered, each over what its own tick can reach:
///     W(h, δ₁) + W(f, δ₂) ≤ E1,     W(f, δ) = max of f s − B s² over 0 ≤ s ≤ δ
///     δ₁ = outward_reach                 of the tick that begins now (L6)
///     δ₂ = δ₁ + T²(a_now + a_next)/2     of the one after it, a = (force + F_other)/m
///
/// Proof: by L3 with a reach, E1(n+1) ≥ E1(n) − W(h, δ₁) and E1(n+2) ≥ E1(n+1) − W(f, δ₂) ≥ 0. Seen
/// from n+1 the reach of f is at most δ₂, so what was promised at n still holds.
/// Source: § 3 (latency) put together with § 9; the form and the proof are ours.
///
/// Passive under reachable_bound's assumptions, over two ticks instead of one; the command may be
/// shortened on its way (saturation), not turned. The price: nothing when pressing; moving out,
/// δ₂ > δ₁ by what hand and motors can accelerate in two ticks, and W(h, δ₁) is spent already.
template <class Space>
struct late_reachable_bound {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr guarantee passivity = guarantee::conditional;
  static constexpr bound_traits traits{.only_reduces = true, .needs_ledger = true, .latency = 1};

  scalar mass{};                         ///< smallest apparent mass of the device [kg]
  scalar hand_force{};                   ///< largest force of all but motors and damper [N]
  typename Space::coordinates coming{};  ///< h, commanded in the last tick [N]

  [[nodiscard]] constexpr vector limit(const vector& desired, const auto& state) noexcept {
    const vector h = coming;
    const scalar in_flight = Space::norm(h);
    scalar credit = state.energy;
    if (in_flight > scalar(0)) {
      const scalar friction = state.damping.friction();
      const scalar B = state.damping.per_tick(h, state.longest_tick);
      credit -= kernels::reachable_outflow(in_flight - friction, B, now(h, in_flight, state)) *
                (scalar(1) + kernels::rounding<scalar>());
    }
    const vector force = affordable(desired, credit, in_flight, state);
    coming = force;
    return force;
  }
  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept {
    if (!(mass > scalar(0)) || !kernels::is_finite(mass))
      return {"mass", mass, "finite and > 0 kg"};
    if (!(hand_force >= scalar(0)) || !kernels::is_finite(hand_force)) {
      return {"hand_force", hand_force, "finite and ≥ 0 N"};
    }
    return {};
  }

 private:
  [[nodiscard]] constexpr vector affordable(const vector& desired, scalar credit, scalar in_flight,
                                            const auto& state) const noexcept {
    const scalar outflow = state.damping.worst_outflow(desired, state.longest_tick);
    if (outflow <= kernels::spendable(credit)) return desired;
    const scalar force = Space::norm(desired);
    if (!(force > scalar(0))) return desired;
    const scalar B = state.damping.per_tick(desired, state.longest_tick);
    const scalar T = state.longest_tick;
    const scalar reach =
        now(desired, in_flight, state) +
        kernels::outward_reach(scalar(0), in_flight, force, others(desired, state), mass, T, T);
    const scalar most = state.damping.friction() + kernels::reachable_force_bound(credit, B, reach);
    return most < force ? vector(desired * (most / force)) : desired;
  }

  /// δ₁ along a direction [m].
  [[nodiscard]] constexpr scalar now(const vector& direction, scalar in_flight,
                                     const auto& state) const noexcept {
    if (!state.motion_known) return std::numeric_limits<scalar>::max();
    const scalar outward = Space::dot(state.displacement, direction) / Space::norm(direction) +
                           kernels::rounding<scalar>() * Space::norm(state.displacement) +
                           state.displacement_error;
    return kernels::outward_reach(outward, Space::norm(state.held), in_flight,
                                  others(direction, state), mass, state.dt, state.longest_tick);
  }

  /// Hand, friction and damper [N].
  [[nodiscard]] constexpr scalar others(const vector& direction, const auto& state) const noexcept {
    const scalar B = state.damping.per_tick(direction, state.longest_tick);
    return hand_force +
           scalar(2) * B * (Space::norm(state.displacement) + state.displacement_error);
  }
};

static_assert(force_bound_for<late_reachable_bound<space<float, 1>>, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
