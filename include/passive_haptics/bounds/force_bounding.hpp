// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The force bounding approach (FBA): ¼ fᵀB⁻¹f ≤ what the ledger holds, at every tick.
//
//   strict_bound      |f| ≤ √(4 B E1)         all that was ever saved may be spent
//
// B = b/T per tick. T is always the LONGEST tick the loop can produce, the credit uses the measured
// one: that pair survives jitter (docs/design/mathematics.md § 3).

#include <passive_haptics/concepts.hpp>

namespace passive_haptics::inline v0 {

/// ¼ fᵀB⁻¹f ≤ E1 at every tick (2.15-2.17): the worst motion of the next tick cannot empty the
/// ledger, so E1 ≥ 0 for ever, by induction, whatever the environment does.
///
/// With Latency k > 0 the force commanded at n is held during [n+k, n+k+1) and what is in flight is
/// promised already: ¼ fᵀB⁻¹f ≤ E1 − ¼ Σ_{j=1..k} f(n−j)ᵀB⁻¹f(n−j). (§ 3)
///
/// Assumes: b is a lower bound, every tick ≤ limits::longest_tick, positions exact, the held force
/// known. The price (lemma L4): pressed slowly from an empty ledger it shows at most 2b/T N/m.
template <class Space, int Latency = 0>
struct strict_bound {
  static_assert(Latency >= 0,
                "passive_haptics: strict_bound: Latency counts ticks and cannot be negative");
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr guarantee passivity = guarantee::strict;
  static constexpr bound_traits traits{
      .only_reduces = true, .needs_ledger = true, .latency = Latency};

  [[nodiscard]] constexpr vector limit(const vector& desired, const auto& state) const noexcept {
    return desired * state.damping.affordable(desired, state.credit(), state.longest_tick);
  }
  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept { return {}; }
};

static_assert(force_bound_for<strict_bound<space<float, 1>>, space<float, 1>>);

}  // namespace passive_haptics::inline v0
