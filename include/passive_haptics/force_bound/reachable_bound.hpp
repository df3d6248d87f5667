// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The bound that knows the device's mass: only what the coming ticks can reach must be covered.
//
//   reachable_bound        in newtons and metres, one mass for all directions      a space
//   reachable_work_bound   in joules, any inertia                                  any port
//
// In a loop that is k ticks late, the k commands on their way are covered first, each over what its
// own tick can reach.

#include <passive_haptics/device/inertia.hpp>
#include <passive_haptics/force_bound/commands_on_their_way.hpp>
#include <passive_haptics/port/concepts.hpp>

#include <type_traits>

namespace passive_haptics {
inline namespace v0 {

/// F s − B s² ≤ E1 for every outward travel s ≤ δ that the next tick can reach (§ 2(a′)). A device
/// of mass m that is moving in cannot turn round within a tick, so pressing is hardly bounded; a
/// device moving out is bounded as strictly as it must be.
///     δ₁ = outward_reach                              of the tick that begins now (L6)
///     δ(j+1) = δ(j) + T²/2 (a(j) + a(j+1))            of the one after it, a = (force + F_other)/m
/// A command of this tick is held in tick k + 1 of a loop that is k ticks late; those on their way,
/// h(1) … h(k), have been promised already:
///     Σ W(h(j), δ(j)) + W(f, δ(k+1)) ≤ E1,     W(f, δ) = max of f s − B s² over 0 ≤ s ≤ δ
///
/// Passive (E1 ≥ 0) under ALL of these:
///   - the apparent mass is at least `mass` in every direction, in every pose: the smallest
///     eigenvalue of the device's inertia, not its mass along the normal;
///   - hand, load, dry friction and, of a mechanism, Coriolis forces together push with at most
///     `hand_force`, and the damper with at most 2B|Δx|, Δx of the last tick and B of the axis that
///     damps most, for k + 1 ticks (so b T/m ≤ 0.1; § 2(a′));
///   - strict_bound's own: b a lower bound, ticks ≤ longest_tick, exact positions (or a ledger that
///     knows how far they are off), held force known.
/// Outside them (a velocity source as hand, a lighter device) it can lose energy, and tests show it.
struct reachable_bound {
  static constexpr guarantee passivity = guarantee::conditional;
  static constexpr bound_traits traits{
      .needs_ledger = true, .exact_travel = false, .latency = any_latency};

  double mass{};        ///< smallest apparent mass of the device, over all directions [kg]
  double hand_force{};  ///< largest force of everything but motors and damper [N]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!detail::positive(mass)) return {"mass", mass, "finite and > 0 kg"};
    if (!detail::not_negative(hand_force)) return {"hand_force", hand_force, "finite and ≥ 0 N"};
    return {};
  }
  template <port Space>
  class on;
};

namespace detail {

/// A force by its length |f| [N], and how far out the device can come along it [m].
template <port Space>
class reach_in_metres {
 public:
  using scalar = typename Space::scalar;
  using effort = typename Space::effort;

  constexpr explicit reach_in_metres(const reachable_bound& p) noexcept
      : mass_(number<scalar>(p.mass)), hand_force_(number<scalar>(p.hand_force)) {}
  [[nodiscard]] constexpr reachable_bound parameters() const noexcept {
    return {.mass = static_cast<double>(mass_), .hand_force = static_cast<double>(hand_force_)};
  }

  [[nodiscard]] constexpr scalar norm(const effort& f) const noexcept { return Space::norm(f); }
  [[nodiscard]] constexpr scalar now(const effort& f, scalar length, scalar held,
                                     const auto& state) const noexcept {
    const scalar push = other(state);
    if (!state.motion_known) return kernels::largest<scalar>();  // at any speed
    scalar outward = Space::dot(state.travel, f) / length +
                     kernels::rounding<scalar>() * Space::norm(state.travel);
    if constexpr (!std::remove_cvref_t<decltype(state)>::exact) outward += state.travel_error;
    return kernels::outward_reach(outward, Space::norm(state.held), held, push, mass_, state.dt,
                                  state.longest_tick);
  }
  [[nodiscard]] constexpr scalar later(scalar /*length*/, scalar before, scalar held,
                                       const auto& state) const noexcept {
    const scalar T = state.longest_tick;
    return kernels::outward_reach(scalar(0), before, held, other(state), mass_, T, T);
  }
  [[nodiscard]] constexpr scalar handed_out(const effort& f, scalar length, scalar reach,
                                            const auto& state) const noexcept {
    scalar beyond = length;
    if constexpr (std::remove_cvref_t<decltype(state)>::damping_type::rubs) {
      beyond -= state.damping.friction(f);
    }
    const scalar B = state.damping.per_tick(f, state.longest_tick);
    return kernels::reachable_outflow(beyond, B, reach);
  }

 private:
  /// F_other: hand, and twice what the damper held over the last tick [N].
  [[nodiscard]] constexpr scalar other(const auto& state) const noexcept {
    scalar moved = Space::norm(state.travel);
    if constexpr (!std::remove_cvref_t<decltype(state)>::exact) moved += state.travel_error;
    return hand_force_ + scalar(2) * most_damped(state.damping, state.longest_tick) * moved;
  }
  /// B of the axis that damps most, so that no damper holds more than B|Δx| [N/m].
  [[nodiscard]] static constexpr scalar most_damped(const auto& damping, scalar T) noexcept {
    scalar b = damping.along_axis(0);
    for (int i = 1; i < Space::dof; ++i) b = kernels::larger(b, damping.along_axis(i));
    return b / T;
  }

  scalar mass_, hand_force_;
};

}  // namespace detail

template <port Space>
class reachable_bound::on {
 public:
  using scalar = typename Space::scalar;
  using effort = typename Space::effort;
  static_assert(detail::has_geometry<Space>,
                "passive_haptics: reachable_bound knows one mass for all directions of a space: "
                "joints need reachable_work_bound");

  constexpr explicit on(const reachable_bound& p) noexcept : by_(p) {}
  [[nodiscard]] constexpr reachable_bound parameters() const noexcept { return by_.parameters(); }

  template <class State>
  [[nodiscard]] constexpr share<scalar> limit(const effort& desired,
                                              const State& state) const noexcept {
    const detail::commands_on_their_way coming(by_, state);
    const scalar credit = coming.left_of(owned(state));
    const scalar outflow = state.damping.worst_outflow(desired, state.longest_tick);
    if (outflow <= kernels::spendable(credit))
      return share{scalar(1)};  // by the worst motion of all
    const scalar force = Space::norm(desired);
    if (!(force > scalar(0))) return share{scalar(1)};
    const scalar B = state.damping.per_tick(desired, state.longest_tick);
    scalar most = kernels::reachable_force_bound(credit, B, coming.reach(desired, force));
    if constexpr (State::damping_type::rubs) {
      if (credit < scalar(0)) return share{scalar(0)};  // friction is no licence to go on spending
      most = (state.damping.friction(desired) + most) *
             (scalar(1) - scalar(4) * kernels::rounding<scalar>());
    }
    return share{most < force ? most / force : scalar(1)};
  }

 private:
  /// E1 less what friction may hold back [J].
  template <class State>
  [[nodiscard]] static constexpr scalar owned(const State& state) noexcept {
    if constexpr (State::latency > 0) {
      return state.energy - state.held_back();
    } else {
      return state.energy;
    }
  }

  detail::reach_in_metres<Space> by_;
};

/// The same law in joules, for any port and any inertia: a wrench, a gripper, joints. With
/// ‖f‖ = √(fᵀM⁻¹f) and W = ¼fᵀB⁻¹f, the most work that f can do in the tick that begins now is
///     η₁ = f·Δx T/T₀ + ‖f‖ ((‖held‖ + F) T₀T + (‖h(1)‖ + F) T²)/2,     F = hand + 2‖(b/T)Δx‖
///     η(j+1) = η(j) + ‖f‖ ((‖h(j)‖ + F) + (‖h(j+1)‖ + F)) T²/2
/// and the share s of f that is left hands out no more than E1 over it, s η' − η'²/(4W) ≤ E1 for
/// every 0 ≤ η' ≤ η:
///     s = E1/η + η/(4W) where η² < 4 W E1,  √(E1/W) elsewhere                 (§ 2(a′), in joules)
/// One degree of freedom with one mass gives reachable_bound's numbers.
///
/// Passive under its assumptions, put so: M is a lower bound of the inertia in every pose, in the
/// sense of xᵀMx; hand, load, friction and, of a mechanism, Coriolis forces have a norm of at most
/// `hand`.
template <class Inertia>
struct basic_reachable_work_bound {
  static constexpr guarantee passivity = guarantee::conditional;
  static constexpr bound_traits traits{
      .needs_ledger = true, .exact_travel = true, .latency = any_latency};

  Inertia inertia{};  ///< a lower bound
  double hand{};      ///< largest norm of everything but motors and damper [√J/s]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (const auto fault = inertia.check()) return fault;
    if (!detail::not_negative(hand)) return {"hand", hand, "finite and ≥ 0 √J/s"};
    return {};
  }
  template <port P>
  class on;
};
template <int Dof>
using reachable_work_bound = basic_reachable_work_bound<diagonal_inertia<Dof>>;

namespace detail {

/// An effort by its norm ‖f‖ [√J/s], and the most work that it can do [J].
template <port P, class Inertia>
class reach_in_joules {
 public:
  using scalar = typename P::scalar;
  using effort = typename P::effort;

  constexpr explicit reach_in_joules(const basic_reachable_work_bound<Inertia>& p) noexcept
      : inertia_(p.inertia), hand_(number<scalar>(p.hand)) {}
  [[nodiscard]] constexpr basic_reachable_work_bound<Inertia> parameters() const noexcept {
    return {.inertia = inertia_.parameters(), .hand = static_cast<double>(hand_)};
  }

  [[nodiscard]] constexpr scalar norm(const effort& f) const noexcept { return inertia_.norm(f); }
  [[nodiscard]] constexpr scalar now(const effort& f, scalar norm, scalar held,
                                     const auto& state) const noexcept {
    const scalar push = other(state);
    if (!state.motion_known) return kernels::largest<scalar>();
    const scalar T = state.longest_tick;
    const auto work = P::work(f, state.travel);
    const scalar outward = work.joules + kernels::rounding<scalar>() * work.passed;
    const scalar pushed = (inertia_.norm(state.held) + push) * state.dt * T + (held + push) * T * T;
    return outward * T / state.dt +
           norm * pushed / scalar(2) * (scalar(1) + kernels::rounding<scalar>());
  }
  [[nodiscard]] constexpr scalar later(scalar norm, scalar before, scalar held,
                                       const auto& state) const noexcept {
    return kernels::later_reach(norm, before, held, other(state), state.longest_tick);
  }
  [[nodiscard]] constexpr scalar handed_out(const effort& f, scalar /*norm*/, scalar reach,
                                            const auto& state) const noexcept {
    return kernels::reachable_work(state.damping.worst_outflow(f, state.longest_tick), reach);
  }

 private:
  /// F: hand, and twice what the damper held over the last tick [√J/s].
  [[nodiscard]] constexpr scalar other(const auto& state) const noexcept {
    const effort damper = state.damping.force(state.travel, state.longest_tick);
    return hand_ + scalar(2) * inertia_.norm(damper);
  }

  part_at<Inertia, P> inertia_;
  scalar hand_;
};

}  // namespace detail

template <class Inertia>
template <port P>
class basic_reachable_work_bound<Inertia>::on {
 public:
  using scalar = typename P::scalar;
  using effort = typename P::effort;
  static_assert(inertia_for<Inertia, P>,
                "passive_haptics: the inertia does not model inertia_for: see port/concepts.hpp");

  constexpr explicit on(const basic_reachable_work_bound& p) noexcept : by_(p) {}
  [[nodiscard]] constexpr basic_reachable_work_bound parameters() const noexcept {
    return by_.parameters();
  }

  template <class State>
  [[nodiscard]] constexpr share<scalar> limit(const effort& desired,
                                              const State& state) const noexcept {
    static_assert(!State::damping_type::rubs,
                  "passive_haptics: reachable_work_bound is proved for viscous damping: count dry "
                  "friction into `hand` instead of crediting it");
    const detail::commands_on_their_way coming(by_, state);
    const scalar credit = coming.left_of(state.energy);
    const scalar W = state.damping.worst_outflow(desired, state.longest_tick);
    if (W <= kernels::spendable(credit)) return share{scalar(1)};
    const scalar norm = by_.norm(desired);
    if (!(norm > scalar(0))) return share{scalar(1)};
    return share{kernels::reachable_share(credit, W, coming.reach(desired, norm))};
  }

 private:
  detail::reach_in_joules<P, Inertia> by_;
};

static_assert(force_bound_for<reachable_bound, space<float, 1>>);
static_assert(force_bound_for<reachable_work_bound<1>, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
