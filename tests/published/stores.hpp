// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The inequality of the proof of a bound without a ledger: the cost of the new force is covered by that of the
// held force and the energy that the last tick brought.
#include "support/scenes.hpp"
#include <passive_haptics/laws.hpp>
#include <passive_haptics/published/energy_bounding.hpp>
#include <passive_haptics/published/sector_bound.hpp>

/// A bound without a command before the one asked for, because random states have none.
template <class Bound>
struct afresh : Bound {
  template <ph::port P>
  class on {
   public:
    constexpr explicit on(const afresh& p) noexcept : bound_(p) {}
    [[nodiscard]] constexpr auto limit(const typename P::effort& desired,
                                       const auto& state) const noexcept {
      ph::part_at<Bound, P> copy = bound_;
      return copy.limit(desired, state);
    }

   private:
    ph::part_at<Bound, P> bound_;
  };
};

/// S(f) ≤ S(held) + ΔE, with ΔE [J] what the last tick brought.
template <class Space>
constexpr bool stores_what_came(const auto& bound, auto stored, int ticks) {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  return ph::laws::holds_in_random_states<Space>(
      bound,
      [stored](const auto&, const vector& result, const auto& state) {
        const vector held = state.held;
        const scalar before = stored(held, state);
        const scalar brought =
            state.damping.dissipated(state.travel, state.dt) - Space::dot(held, state.travel);
        const scalar slack = scalar(64) * std::numeric_limits<scalar>::epsilon();
        return stored(result, state) <= before + brought + slack * (before + scalar(1));
      },
      ticks);
}
inline constexpr auto worst_outflow = [](const auto& f, const auto& state) {
  return state.damping.worst_outflow(f, state.longest_tick);
};
/// f²/(2 c2) with c2 = share·b/T.
template <class Space, int Share = 1>
inline constexpr auto spring_energy = [](const typename Space::vector& f, const auto& state) {
  using scalar = typename Space::scalar;
  return Space::dot(f, f) * state.longest_tick / (scalar(2 * Share) * state.damping.along_axis(0));
};

template <class Space>
constexpr bool the_families_obey(int ticks) {
  const auto stores = [ticks](const auto& bound, auto stored) {
    return stores_what_came<Space>(bound, stored, ticks);
  };
  return stores(ph::memoryless_bound{}, worst_outflow) &&
         stores(afresh<ph::energy_bounding>{}, spring_energy<Space>) &&
         stores(ph::tight_energy_bounding{}, spring_energy<Space, 2>) &&
         ph::laws::scales_down<Space>(ph::memoryless_bound{}, ticks) &&
         ph::laws::scales_down<Space>(ph::tight_energy_bounding{}, ticks) &&
         // the controls: these spend what the last tick did not bring
         !stores(ph::no_bound{}, worst_outflow) && !stores(ph::strict_bound{}, worst_outflow) &&
         !stores(ph::memoryless_bound{}, spring_energy<Space>);
}
