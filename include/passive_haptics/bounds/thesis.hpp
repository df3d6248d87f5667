// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The rule of the thesis: strict when leaving and when the environment moves, free on the way in.

#include <passive_haptics/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

/// The rule of the thesis (2.24-2.27, Fig. 3.2), in force form. With f_max = √(4 B E1):
///     leaving (Δx·n > 0):   |f| ≤ f_max
///     otherwise:            |f| ≤ max(f_LM, f_max)
/// where f_LM is the force at the local model's depth: going in keeps what there is, and an update
/// adds only up to f_max.
///
/// NOT passive: the force on the way in is fixed before the motion is known. Enter a wall by δ in
/// one tick and leave in the next: E1 falls by (K − 2B)δ² each time (A5, counterexample 1; a test
/// shows it). It settles a contact by hysteresis, and practice likes it. For the promise take
/// reachable_bound or strict_bound.
template <class Space>
struct thesis_bound {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr guarantee passivity = guarantee::none;
  static constexpr bound_traits traits{
      .only_reduces = true, .needs_ledger = true, .needs_local_model = true};

  [[nodiscard]] constexpr vector limit(const vector& desired, const auto& state) const noexcept {
    scalar scale = state.damping.affordable(desired, state.credit(), state.longest_tick);
    if (scale < scalar(1) && !state.leaving()) {
      const scalar asked = Space::dot(desired, state.normal);
      if (asked > scalar(0)) {
        const scalar keep = kernels::smaller(state.local_force / asked, scalar(1));
        scale = kernels::larger(scale, keep);
      }
    }
    return desired * scale;
  }
  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept { return {}; }
};

static_assert(force_bound_for<thesis_bound<space<float, 1>>, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
