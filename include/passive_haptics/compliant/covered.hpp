// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The common part of the bounds in this room, which differ only in their reach δ(j), the travel along a force:
//
//   Σ W(h(j), δ(j)) + W(f, δ(k+1)) ≤ E1,     W(f, δ) = max of f s − B s² over 0 ≤ s ≤ δ            (§ 2(a′))

#include <passive_haptics/port/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace detail {

/// The share of `desired` that the ledger covers after the forces commanded before it. `reach(j, f, |f|)` is δ(j) [m], the
/// farthest that the encoder can travel along f in the j-th coming tick.
template <class P, class State>
[[nodiscard]] constexpr share<typename P::scalar> covered(const typename P::effort& desired,
                                                          const State& state,
                                                          const auto& reach) noexcept {
  using scalar = typename P::scalar;
  using effort = typename P::effort;
  const scalar T = state.longest_tick;
  if (state.damping.worst_outflow(desired, T) <= kernels::spendable(state.credit())) {
    return {scalar(1)};  // even the worst motion is covered
  }
  const scalar force = P::norm(desired);
  if (!(force > scalar(0))) return {scalar(1)};
  scalar credit = state.energy - state.held_back();
  for (int j = 1; j <= State::latency; ++j) {
    const effort h = state.coming(j);
    const scalar size = P::norm(h);
    if (!(size > scalar(0))) continue;
    scalar beyond = size;
    if constexpr (State::damping_type::rubs) beyond -= state.damping.friction(h);
    credit -= kernels::reachable_outflow(beyond, state.damping.per_tick(h, T), reach(j, h, size)) *
              (scalar(1) + kernels::rounding<scalar>());
  }
  scalar most = kernels::reachable_force_bound(credit, state.damping.per_tick(desired, T),
                                               reach(State::latency + 1, desired, force));
  if constexpr (State::damping_type::rubs) {
    if (credit < scalar(0)) return {scalar(0)};  // a ledger in debt allows no force, not even c
    most = (state.damping.friction(desired) + most) *
           (scalar(1) - scalar(4) * kernels::rounding<scalar>());
  }
  return {most < force ? most / force : scalar(1)};
}

}  // namespace detail
}  // namespace v0
}  // namespace passive_haptics
