// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The force bounding approach (FBA): a force is commanded only if its worst next tick, ¼ fᵀB⁻¹f [J], is paid.
// The three bounds differ in what pays for it:
//
//   strict_bound      |f| ≤ √(4 B E1)         all that was ever saved: fewest cuts, late bursts
//                     |f| ≤ c + √(4 B E1)     on a dual_ledger that credits dry friction c, for E1 ≥ 0
//                     the nearest f           where axes are damped unequally
//   memoryless_bound  |f| ≤ |f_held − 2B Δx|  the last force and the last tick only: nothing is saved,
//                                             so no bursts and no drift; feels like a spring of 2b/T
//   per_axis_bound    |fᵢ| ≤ √(4 Bᵢ Eᵢ)       one ledger per axis: no axis can spend what another has
//                                             saved, and the force may turn
//
// B = b/T [N/m]. T is always the LONGEST tick that the loop can produce, while the credit uses the measured
// length dt of the tick: so ticks that vary are covered (docs/design/mathematics.md § 3).

#include <passive_haptics/port/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

namespace detail {
/// What is shown of a surface that is pressed slowly while the ledger is empty (lemma L4): f²/(2K) has been paid in,
/// and k + 1 commands of f are covered, so K ≤ 2b/((k + 1) T), b of the axis that damps least.
template <class P>
constexpr void soften_by_damping(explanation& e, const auto& damping, typename P::scalar T,
                                 int late) noexcept {
  const auto b = static_cast<double>(least_damping<P>(damping));
  e.soften(2.0 * b / ((1.0 + late) * static_cast<double>(T)), softened_by::damping_and_tick);
}
}  // namespace detail

/// ¼ fᵀB⁻¹f ≤ E1 at every tick (2.15-2.17): the worst motion of the next tick cannot overdraw the
/// ledger, so E1 ≥ 0 for ever, by induction, whatever the environment does.
///
/// In a loop that is k ticks late the force commanded at n is held during [n+k, n+k+1), and the k commands
/// on their way have been promised already: ¼ fᵀB⁻¹f ≤ E1 − ¼ Σ_{j=1..k} f(n−j)ᵀB⁻¹f(n−j). (§ 3)
///
/// Where axes are damped unequally, the force is the nearest that is covered: an axis that damps little gives way
/// first, and the force turns. |fᵢ| never grows. In one share for all, one weak joint would take the others along.
///
/// It assumes that b is a lower bound, every tick ≤ longest_tick, positions exact (or the ledger a
/// quantised_energy or a dual_ledger), and the held force known. The price (lemma L4): pressed slowly from
/// an empty ledger it shows at most 2b/T N/m.
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
    static constexpr bool only_reduces = true;  ///< on every axis, where they differ
    constexpr explicit on(const strict_bound& /*p*/) noexcept {}
    template <class State>
    [[nodiscard]] constexpr detail::what_is_left<State, P> limit(
        const typename P::effort& desired, const State& state) const noexcept {
      const auto credit = state.credit();
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

/// ¼ fᵀB⁻¹f ≤ ¼ hᵀB⁻¹h + Δxᵀ(b/dt)Δx − h·Δx, with h the force held over the last tick: the energy that was
/// set aside for h, plus what the tick brought. For ticks of one length the right side is a square, and
///     fᵀB⁻¹f ≤ wᵀB⁻¹w,   w = h − 2B Δx                                  (§ 2, memoryless_bound)
/// The conservative of the two variants that the thesis mentions without a formula is this one or
/// per_axis_bound; the form and the proof are ours. It reads no ledger, only the damping.
///
/// It assumes what strict_bound does, and exact positions, because it reads Δx itself. The force really held
/// may be shorter than the command in the same direction or, with isotropic damping, in any direction. A held
/// force that is LARGER than the command costs more than was promised and, as there is no ledger, is not
/// remembered as a debt. The price: nothing is saved, so it shows 2b/T N/m at any speed and 2b/T/(k + 1) with
/// latency, and after a lost sample or a late tick the force starts again from zero.
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
/// of its own:  Eᵢ += (bᵢ/dt) Δxᵢ² − hᵢ Δxᵢ.  This is strict_bound on every axis (§ 2, per_axis_bound; form
/// and proof are ours). The direction of the force is not kept, so in a chain it voids the promises of the bounds
/// in front of it.
///
/// It assumes what memoryless_bound does and no latency, and that no component of the force really held is
/// larger than commanded; one that is puts its axis into a debt, which is kept and repaid. Dry friction is
/// not credited, because a bound on its total says nothing about one axis. The price: what one axis has
/// saved is of no use to another, a lost sample voids all credit, and there is no loan to start with.
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
  /// Eᵢ [J] after the last tick. For a late tick the smaller counts of two stories: the force was held to its
  /// end, or was dropped at the worst moment. A lost tick leaves nothing but debts.
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
