// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Energy tanks: an action passes while the tank holds what it will let out.
//
//   energy_tank       outflow ≤ E1 − ε          worst case: strict_bound by another name, passive
//                                               predicted: T f·v, bold and NOT passive
//   two_layer_tank    T f·v ≤ H, f_TLC = −d v   any force from above, a level kept by damping below;
//                                               NOT passive
//
// Energy quanta from another port are not offered: one port, one tank.

#include <passive_haptics/concepts.hpp>

#include <cstdint>
#include <limits>

namespace passive_haptics {
inline namespace v0 {

/// What the next tick is taken to let out.
enum class tank_outflow : std::uint8_t {
  worst_case,  ///< ¼ fᵀB⁻¹f, whatever the motion
  predicted,   ///< T max(0, f·v), if the motion goes on as it did
};

/// The force is scaled down until its outflow is at most E1 − ε. The tank is the observer's ledger;
/// the observer's `cap` is the tank's size, and T is the longest tick. Source: the tank of Ferraguti
/// et al. 2015 in the discrete form of docs/design/mathematics.md § 2(h).
///
/// Worst case: exactly strict_bound on a smaller ledger, so E1 ≥ 0 for every motion under the
/// assumptions of strict_bound (no latency), and no force at all while E1 < ε. Predicted: pushes
/// back with all of f* until it has seen the device turn round; NOT passive.
template <class Space, tank_outflow Outflow = tank_outflow::worst_case>
struct energy_tank {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr guarantee passivity =
      Outflow == tank_outflow::worst_case ? guarantee::strict : guarantee::none;
  static constexpr bound_traits traits{.only_reduces = true, .needs_ledger = true};

  scalar reserve{};  ///< ε [J], never spent

  [[nodiscard]] constexpr vector limit(const vector& desired, const auto& state) const noexcept {
    const scalar level = state.credit() - reserve;
    if (Outflow == tank_outflow::worst_case || !state.motion_known) {
      return desired * state.damping.affordable(desired, level, state.longest_tick);
    }
    const scalar outflow =
        Space::dot(desired, state.displacement) * (state.longest_tick / state.dt);
    if (outflow <= kernels::larger(level, scalar(0))) return desired;
    return desired * (kernels::larger(level, scalar(0)) / outflow);
  }
  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept {
    if (reserve >= scalar(0) && kernels::is_finite(reserve)) return {};
    return {"reserve", reserve, "finite and ≥ 0 J"};
  }
};

/// An upper layer that asks for any force, over a tank that lets out at most what is in it:
///     H ← min(H + Δxᵀ(b/dt)Δx − f_held·Δx, cap)
///     f = s f* − d v,   T s f*·v ≤ H and s ‖f*‖ ≤ g H on the way out,
///     d = min(max_damping, a max(0, H_d − H)),   v = Δx/dt
/// The tank level controller −d v refills the tank at the cost of drag, in free space too. The way
/// in is never blocked, it is what fills the tank. Source: Franken et al. 2011, form from memory
/// (docs/design/mathematics.md § 2(h)), whose H has no damping credit; single port, no quanta.
///
/// NOT passive: the outflow is predicted from the last displacement, and −d v pushes the wrong way
/// for the first tick after the motion turns. Put strict_bound behind it for the promise.
/// max_damping ≤ 0.35 to 0.5 m/T, or the refill itself rings (series_passivity_controller).
template <class Space>
struct two_layer_tank {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr guarantee passivity = guarantee::none;
  static constexpr bound_traits traits{.needs_ledger = true};

  scalar wanted{};                                              ///< H_d [J], the level to keep
  scalar refill{};                                              ///< a [N·s/(m J)]
  scalar max_damping{};                                         ///< largest d [N·s/m]
  scalar force_per_joule = std::numeric_limits<scalar>::max();  ///< g [N/J]
  scalar cap = std::numeric_limits<scalar>::max();              ///< size of the tank [J]
  scalar energy{};       ///< H [J]; its first value is a loan
  bool started = false;  ///< has there been a tick?

  [[nodiscard]] constexpr vector limit(const vector& desired, const auto& state) noexcept {
    book(state);
    started = true;
    if (!state.motion_known) return Space::zero();  // its outflow cannot be predicted
    const scalar lack = kernels::larger(wanted - energy, scalar(0));
    const scalar drag = kernels::smaller(refill * lack, max_damping) / state.dt;
    return desired * share(desired, state) - state.displacement * drag;
  }

  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept {
    if (!(wanted >= scalar(0)) || !kernels::is_finite(wanted)) {
      return {"wanted", wanted, "finite and ≥ 0 J"};
    }
    if (!(refill >= scalar(0)) || !kernels::is_finite(refill)) {
      return {"refill", refill, "finite and ≥ 0 N·s/(m J)"};
    }
    if (!(max_damping >= scalar(0)) || !kernels::is_finite(max_damping)) {
      return {"max_damping", max_damping, "finite and ≥ 0 N·s/m"};
    }
    if (!(force_per_joule > scalar(0))) return {"force_per_joule", force_per_joule, "> 0 N/J"};
    if (!(cap >= wanted)) return {"cap", cap, "≥ wanted"};
    if (!(energy >= scalar(0)) || !kernels::is_finite(energy)) {
      return {"energy", energy, "finite and ≥ 0 J at the start"};
    }
    return {};
  }

 private:
  constexpr void book(const auto& state) noexcept {
    const scalar written_off = kernels::smaller(energy, scalar(0));
    if (!state.motion_known) {
      if (started) energy = written_off;
      return;
    }
    energy += state.damping.dissipated(state.displacement, state.dt) -
              Space::dot(state.held, state.displacement);
    // a late tick may have lost its force part of the way
    energy = kernels::smaller(energy, state.dt > state.longest_tick ? written_off : cap);
  }
  /// s: the whole way in, what the tank holds on the way out.
  [[nodiscard]] constexpr scalar share(const vector& desired, const auto& state) const noexcept {
    const scalar outflow =
        Space::dot(desired, state.displacement) * (state.longest_tick / state.dt);
    if (!(outflow > scalar(0))) return scalar(1);
    const scalar needed = kernels::larger(outflow, Space::norm(desired) / force_per_joule);
    return needed > energy ? kernels::larger(energy, scalar(0)) / needed : scalar(1);
  }
};

static_assert(force_bound_for<energy_tank<space<float, 1>>, space<float, 1>>);
static_assert(force_bound_for<two_layer_tank<space<float, 1>>, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
