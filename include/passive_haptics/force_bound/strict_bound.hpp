// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The force bounding approach (FBA): a force is commanded only if an energy budget [J] covers its worst outflow in
// the next tick, ¼ fᵀB⁻¹f [J]. The three bounds differ in that budget:
//
//   strict_bound      |f| ≤ √(4 B E1)         the whole ledger E1: fewest cuts; stored energy may come out late
//                     |f| ≤ c + √(4 B E1)     on a dual_ledger that credits dry friction c, for E1 ≥ 0
//                     the nearest f           where axes are damped unequally
//   memoryless_bound  |f| ≤ |f_held − 2B Δx|  the last force and the last tick only: nothing is stored, so there
//                                             are no bursts and no drift; a wall feels like a spring of 2b/T
//   per_axis_bound    |fᵢ| ≤ √(4 Bᵢ Eᵢ)       one ledger Eᵢ per axis: no axis can spend the energy of another,
//                                             and the force may turn
//
// B = b/T [N/m]. T is always the LONGEST tick that the loop can produce, while the ledger is credited with the
// measured length dt, so ticks of varying length are covered (docs/design/mathematics.md § 3).

#include <passive_haptics/port/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

namespace detail {
/// Notes K ≤ 2b/((k + 1) T), the stiffness that a slow press shows from an empty ledger (L4): the hand has paid in
/// f²/(2K), which covers the worst outflow of k + 1 commands of f. b is that of the least damped axis.
template <class P>
constexpr void soften_by_damping(explanation& e, const auto& damping, typename P::scalar T,
                                 int late) noexcept {
  const auto b = static_cast<double>(least_damping<P>(damping));
  e.soften(2.0 * b / ((1.0 + late) * static_cast<double>(T)), softened_by::damping_and_tick);
}
}  // namespace detail

/// ¼ fᵀB⁻¹f ≤ E1 at every tick (2.15-2.17). The worst motion of the next tick cannot overdraw the ledger, so by
/// induction E1 ≥ 0 for ever, whatever the environment does (§ 2(a)).
///
/// In a loop that is k ticks late the force commanded at n is held during [n+k, n+k+1), and the k commands before
/// it have to be covered, too: ¼ fᵀB⁻¹f ≤ E1 − ¼ Σ_{j=1..k} f(n−j)ᵀB⁻¹f(n−j). (§ 3)
///
/// If axes are damped unequally, the force is the covered one that is nearest to f*: a weakly damped axis is
/// reduced most, and the force turns. |fᵢ| never grows. One share for all would let one weak joint reduce the others.
///
/// It assumes that b is a lower bound, every tick is ≤ longest_tick, positions are exact (or the ledger is a
/// quantised_energy or a dual_ledger), and the held force is known. Its cost (L4): a wall pressed slowly from an
/// empty ledger has a stiffness of 2b/T [N/m] at most.
struct strict_bound {
  static constexpr guarantee passivity = guarantee::strict;
  static constexpr bound_traits traits{.needs_ledger = true,
                                       .exact_travel = false,
                                       .latency = any_latency,
                                       .turns = true,
                                       .reported_work = true};

  [[nodiscard]] constexpr parameter_fault check() const noexcept { return {}; }

  template <port P>
  struct on {
    template <class... States>
    static constexpr bool only_reduces = true;  ///< on every axis, even if their dampings differ
    constexpr explicit on(const strict_bound& /*p*/) noexcept {}
    template <class State>
    [[nodiscard]] constexpr detail::what_is_left<State, P> limit(
        const typename P::effort& desired, const State& state) const noexcept {
      const auto credit = state.fair_credit();
      if constexpr (detail::differs_by_axis<typename State::damping_type, P>) {
        return detail::nearest_covered<P>(state.damping, desired, credit, state.longest_tick);
      } else {
        return {state.damping.affordable(desired, credit, state.longest_tick)};
      }
    }
    constexpr void explain(explanation& e, const auto& damping, typename P::scalar T,
                           int late) const noexcept {
      detail::soften_by_damping<P>(e, damping, T, late);
    }
  };
};

/// ¼ fᵀB⁻¹f ≤ ¼ hᵀB⁻¹h + Δxᵀ(b/dt)Δx − h·Δx, with h the force held over the last tick: the budget is the worst
/// outflow that was reserved for h, plus the energy gained in the tick. For equal ticks the right side is a square, and
///     fᵀB⁻¹f ≤ wᵀB⁻¹w,   w = h − 2B Δx                                  (§ 2, memoryless_bound)
/// The thesis mentions two variants without a formula, of which the conservative one is this or per_axis_bound; form
/// and proof are ours. It reads the damping, but no ledger.
///
/// It makes the assumptions of strict_bound, and needs exact positions, because it reads Δx itself. The held force
/// may be shorter than the command in the same direction or, with isotropic damping, in any direction. A held
/// force LARGER than the command gives out more than was reserved and, as there is no ledger, leaves no debt. Its
/// cost: a wall has a stiffness of 2b/((k + 1) T) [N/m] at any speed, and after a lost sample or a late tick the
/// force starts again from zero.
struct memoryless_bound {
  static constexpr guarantee passivity = guarantee::strict;
  static constexpr bound_traits traits{.needs_ledger = true, .latency = any_latency, .turns = true};

  [[nodiscard]] constexpr parameter_fault check() const noexcept { return {}; }

  template <port P>
  struct on {
    using scalar = typename P::scalar;
    constexpr explicit on(const memoryless_bound& /*p*/) noexcept {}
    [[nodiscard]] constexpr share<scalar> limit(const typename P::effort& desired,
                                                const auto& state) const noexcept {
      const scalar T = state.longest_tick;
      scalar credit(0);
      if (state.fate() == tick_fate::on_time) {
        credit = state.damping.worst_outflow(state.held, T) + state.gain();
      }
      return {state.damping.affordable(desired, credit, T)};
    }
    constexpr void explain(explanation& e, const auto& damping, scalar T, int late) const noexcept {
      detail::soften_by_damping<P>(e, damping, T, late);
    }
  };
};

/// |fᵢ| ≤ √(4 Bᵢ Eᵢ) for each axis i of the frame that the damping is given in, each with a ledger
/// of its own:  Eᵢ += (bᵢ/dt) Δxᵢ² − hᵢ Δxᵢ.  This is strict_bound on every axis (§ 2, per_axis_bound; form and proof
/// are ours). The direction of the force is not kept, so in a chain it voids the guarantees of the bounds before it.
///
/// It makes the assumptions of memoryless_bound, and assumes no latency and that no component of the held force is
/// larger than commanded; one that is puts its axis into a debt, which is kept and repaid. Dry friction is
/// not credited, because a bound on its total says nothing about one axis. Its cost: the energy of one axis is of
/// no use to another, a lost sample voids all credit, and there is no loan to start with.
struct per_axis_bound {
  static constexpr guarantee passivity = guarantee::strict;
  static constexpr bound_traits traits{.needs_ledger = true};

  double cap = detail::no_limit;  ///< most credit to keep on an axis [J] (L7)

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!(cap >= 0.0)) return {"cap", cap, "≥ 0 J"};
    return {};
  }
  template <port P>
  class on;
};

template <port P>
class per_axis_bound::on {
 public:
  using scalar = typename P::scalar;
  using effort = typename P::effort;

  constexpr explicit on(const per_axis_bound& p) noexcept {
    set(p);
    reset();
  }
  constexpr void set(const per_axis_bound& p) noexcept { cap_ = detail::number<scalar>(p.cap); }
  [[nodiscard]] constexpr per_axis_bound parameters() const noexcept {
    return {static_cast<double>(cap_)};
  }
  constexpr void reset() noexcept { energy_ = P::zero(); }

  [[nodiscard]] constexpr effort limit(const effort& desired, const auto& state) noexcept {
    effort force = desired;
    for (int i = 0; i < P::dof; ++i) {
      scalar& saved = P::component(energy_, i);
      saved = booked(saved, i, state);
      const scalar B = state.damping.along_axis(i) / state.longest_tick;
      const scalar most = kernels::strict_force_bound(saved, B);
      scalar& along = P::component(force, i);
      along = kernels::clamped(along, -most, most);
    }
    return force;
  }

 private:
  /// Eᵢ [J] after the last tick. For a late tick it is the smaller value of two cases: the force was held to its end,
  /// or the driver dropped it at the worst moment. After a lost tick credit is zero and a debt stays.
  [[nodiscard]] constexpr scalar booked(scalar before, int i, const auto& state) const noexcept {
    if (!state.motion_known) return kernels::smaller(before, scalar(0));
    const scalar b = state.damping.along_axis(i);
    const scalar held = P::component(state.held, i);
    const scalar travel = P::component(state.travel, i);
    const scalar work = held * travel;
    scalar after = kernels::sum_rounded_down(
        before, kernels::sure_gain(b * travel * travel / state.dt, work, kernels::magnitude(work)));
    if (state.fate() != tick_fate::on_time) {
      const scalar worst = kernels::worst_outflow(held, b / state.longest_tick);
      after = kernels::smaller(after, detail::written_off(before, worst));
    }
    return kernels::smaller(after, cap_);
  }

  scalar cap_{};
  typename P::stored_effort energy_{};  ///< Eᵢ [J]
};

static_assert(force_bound_for<strict_bound, space<float, 1>>);
static_assert(force_bound_for<memoryless_bound, space<float, 1>>);
static_assert(force_bound_for<per_axis_bound, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
