// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Force bounds: how much of the desired force the ledger allows.
//
//   strict_bound      |f| ≤ √(4 B E1), every tick           passive, always; soft: ≤ 2b/T N/m
//   thesis_bound      the same, when leaving or on updates  stiff and quick; NOT passive
//   reachable_bound   the next tick's work ≤ E1             stiff and passive, where the mass and the
//                                                           largest hand force are known
//   actuator_limit    |f| ≤ what the motors give            always, with motors
//   force_rate_limit  the surface moves at ≤ r/K m/s        no jumps at updates
//   bound_chain       one after the other
//   no_bound          f = f*                                for comparison
//
// B = b/T per tick. T is always the LONGEST tick the loop can produce, the credit uses the measured
// one: that pair survives jitter (docs/design/mathematics.md § 3).

#include <passive_haptics/concepts.hpp>

namespace passive_haptics::inline v0 {

/// f = f*. Loses energy at every tick in contact (lemma L2): K Δx²/2 against b Δx²/T.
template <class Space>
struct no_bound {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr guarantee passivity = guarantee::none;
  static constexpr bool only_reduces = true;
  static constexpr bool needs_ledger = false;
  static constexpr bool needs_local_model = false;
  static constexpr int latency = 0;

  [[nodiscard]] constexpr vector limit(const vector& desired,
                                       const auto& /*state*/) const noexcept {
    return desired;
  }
  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept { return {}; }
};

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
  static constexpr bool only_reduces = true;
  static constexpr bool needs_ledger = true;
  static constexpr bool needs_local_model = false;
  static constexpr int latency = Latency;

  [[nodiscard]] constexpr vector limit(const vector& desired, const auto& state) const noexcept {
    const scalar outflow = state.damping.worst_outflow(desired, state.longest_tick);
    return desired * kernels::strict_scale(state.credit(), outflow);
  }
  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept { return {}; }
};

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
  static constexpr bool only_reduces = true;
  static constexpr bool needs_ledger = true;
  static constexpr bool needs_local_model = true;
  static constexpr int latency = 0;

  [[nodiscard]] constexpr vector limit(const vector& desired, const auto& state) const noexcept {
    const scalar outflow = state.damping.worst_outflow(desired, state.longest_tick);
    scalar scale = kernels::strict_scale(state.credit(), outflow);
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
  static constexpr bool only_reduces = true;
  static constexpr bool needs_ledger = true;
  static constexpr bool needs_local_model = false;
  static constexpr int latency = 0;

  scalar mass{};        ///< smallest apparent mass of the device [kg]
  scalar hand_force{};  ///< largest force of everything but motors and damper [N]

  [[nodiscard]] constexpr vector limit(const vector& desired, const auto& state) const noexcept {
    const scalar outflow = state.damping.worst_outflow(desired, state.longest_tick);
    if (outflow <= state.credit()) return desired;  // covered even by the worst motion of all
    const scalar force = Space::norm(desired);
    if (!(force > scalar(0))) return desired;

    const scalar B = force * force / (scalar(4) * outflow);  // 1/(uᵀB⁻¹u), u along the force
    const scalar outward = Space::dot(state.displacement, desired) / force;
    const scalar damper = scalar(2) * B * Space::norm(state.displacement);
    const scalar reach =
        state.motion_known
            ? kernels::outward_reach(outward, Space::norm(state.held), force, hand_force + damper,
                                     mass, state.dt, state.longest_tick)
            : std::numeric_limits<scalar>::max();  // it may be moving out at any speed
    const scalar most = kernels::reachable_force_bound(state.credit(), B, reach);
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

/// |f| ≤ `most` [N], direction kept: what the motors can hold. Without it (or a device that reports
/// the force it held) the ledger would book a force that was never there (A28).
template <class Space>
struct actuator_limit {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr guarantee passivity = guarantee::none;
  static constexpr bool only_reduces = true;
  static constexpr bool needs_ledger = false;
  static constexpr bool needs_local_model = false;
  static constexpr int latency = 0;

  scalar most{};  ///< largest force [N]

  [[nodiscard]] constexpr vector limit(const vector& desired,
                                       const auto& /*state*/) const noexcept {
    const scalar force = Space::norm(desired);
    return force > most ? vector(desired * (most / force)) : desired;
  }
  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept {
    if (most >= scalar(0) && kernels::is_finite(most)) return {};
    return {"most", most, "finite and ≥ 0 N"};
  }
};

/// f within f_LM ± `rate`·dt, along the normal: what the hand's own motion does to the force passes
/// at once, what the environment does (an update, a lost contact) passes at `rate` N/s. That is the
/// local surface moving at no more than rate/K m/s (A23). It may hold a force above the desired one
/// while the surface retreats, so put the energy bound BEHIND it in the chain.
template <class Space>
struct force_rate_limit {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr guarantee passivity = guarantee::none;
  static constexpr bool only_reduces = false;
  static constexpr bool needs_ledger = false;
  static constexpr bool needs_local_model = true;
  static constexpr int latency = 0;

  scalar rate{};  ///< [N/s]

  [[nodiscard]] constexpr vector limit(const vector& desired, const auto& state) const noexcept {
    const scalar step = rate * state.dt;
    const scalar asked = Space::dot(desired, state.normal);
    const scalar least = kernels::larger(state.local_force - step, scalar(0));
    const scalar most = state.local_force + step;
    return state.normal * kernels::smaller(kernels::larger(asked, least), most);
  }
  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept {
    if (rate > scalar(0) && kernels::is_finite(rate)) return {};
    return {"rate", rate, "finite and > 0 N/s"};
  }
};

/// First, then the rest. What the chain promises is the best promise among its bounds that nothing
/// behind them can break: a bound that only reduces cannot, because zero force is always safe and
/// the allowed forces of every bound here are a ball around it.
template <class First, class... Rest>
struct bound_chain {
  using rest_type = bound_chain<Rest...>;
  static constexpr guarantee passivity =
      std::max(rest_type::only_reduces ? First::passivity : guarantee::none, rest_type::passivity);
  static constexpr bool only_reduces = First::only_reduces && rest_type::only_reduces;
  static constexpr bool needs_ledger = First::needs_ledger || rest_type::needs_ledger;
  static constexpr bool needs_local_model =
      First::needs_local_model || rest_type::needs_local_model;
  static constexpr int latency = std::max(First::latency, rest_type::latency);

  First first;
  rest_type rest;

  constexpr bound_chain() noexcept = default;
  constexpr explicit bound_chain(const First& one, const Rest&... others) noexcept
      : first(one), rest(others...) {}

  template <class Vector>
  [[nodiscard]] constexpr Vector limit(const Vector& desired, const auto& state) noexcept {
    return rest.limit(first.limit(desired, state), state);
  }
  [[nodiscard]] constexpr auto check() const noexcept {
    const auto fault = first.check();
    return fault ? fault : rest.check();
  }
};

template <class Only>
struct bound_chain<Only> : Only {
  constexpr bound_chain() noexcept = default;
  constexpr explicit bound_chain(const Only& one) noexcept : Only(one) {}
};

static_assert(force_bound_for<strict_bound<space<float, 1>>, space<float, 1>>);
static_assert(force_bound_for<thesis_bound<space<float, 1>>, space<float, 1>>);
static_assert(force_bound_for<reachable_bound<space<float, 1>>, space<float, 1>>);
static_assert(force_bound_for<actuator_limit<space<float, 1>>, space<float, 1>>);
static_assert(force_bound_for<force_rate_limit<space<float, 1>>, space<float, 1>>);

}  // namespace passive_haptics::inline v0
