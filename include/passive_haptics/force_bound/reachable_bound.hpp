// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The force bound for a device of known mass: it covers only the travel that the mass admits in the coming ticks.
//
//   reachable_bound        in newtons and metres, one mass for all directions      a space
//   reachable_work_bound   in joules, any inertia                                  any port
//
// In a loop that is k ticks late, the k forces commanded but not yet held are covered first, each over the travel
// that is possible in its own tick.

#include <passive_haptics/device/inertia.hpp>
#include <passive_haptics/port/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

namespace detail {
/// E1 − Σ W(h(j), δ(j)) [J] over the commands from the J-th on. `bound.reach<J>(f, |f|, h, state)` is δ(J) [m], the
/// farthest travel along f in the J-th coming tick, in which a force of h [N] is held.
template <int J, class State>
[[nodiscard]] constexpr auto left_over(const State& state, const auto& bound) noexcept {
  using scalar = typename State::scalar;
  if constexpr (J > State::latency) {
    return state.energy - state.held_back();
  } else {
    const scalar credit = left_over<J + 1>(state, bound);
    const typename State::effort h = state.coming(J);
    const scalar force = State::port_type::norm(h);
    if (!(force > scalar(0))) return credit;
    scalar beyond = force;
    if constexpr (State::damping_type::rubs) beyond -= state.damping.friction(h);
    const scalar B = state.damping.per_tick(h, state.longest_tick);
    return scalar(credit - kernels::reachable_outflow(
                               beyond, B, bound.template reach<J>(h, force, force, state)) *
                               (scalar(1) + kernels::rounding<scalar>()));
  }
}

struct reckoned_now {  // left_over, only where it is asked for
  [[nodiscard]] constexpr auto operator()(const auto& state, const auto& bound) const noexcept {
    return left_over<1>(state, bound);
  }
};
/// The share of `desired` that the ledger covers after the commands before it, which leave `left(state, bound)` [J].
template <class State, class Left = reckoned_now>
[[nodiscard, gnu::always_inline]] constexpr auto covered(const typename State::effort& desired,
                                                         const State& state, const auto& bound,
                                                         Left left = {}) noexcept {
  using scalar = typename State::scalar;
  using P = typename State::port_type;
  const scalar outflow = state.damping.worst_outflow(desired, state.longest_tick);
  if (outflow <= kernels::spendable(state.credit())) return scalar(1);
  const scalar credit = left(state, bound), force = P::norm(desired);
  if (!(force > scalar(0))) return scalar(1);
  scalar most = kernels::reachable_force_bound(
      credit, state.damping.per_tick(desired, state.longest_tick),
      bound.template reach<State::latency + 1>(desired, force, force, state));
  if constexpr (State::latency > 0 && State::exact && !State::damping_type::rubs) {
    // Where the damper pays for all of it, W is f²/4B for every j, so each takes its share, or they would take turns.
    const scalar each = (state.energy - state.held_back()) / scalar(State::latency + 1);
    most = kernels::smaller(most, kernels::reachable_force_bound(
                                      each, state.damping.per_tick(desired, state.longest_tick),
                                      bound.template reach<1>(desired, force, force, state)));
  }
  if constexpr (State::damping_type::rubs) {
    if (credit < scalar(0)) return scalar(0);  // a debt allows no force, not even c
    most = (state.damping.friction(desired) + most) *
           (scalar(1) - scalar(4) * kernels::rounding<scalar>());
  }
  if (!(most < force)) return scalar(1);
  if constexpr (State::latency > 0 && !State::exact) {
    // δ(j) hardly differs from δ(j + 1), so forces would take turns: what one takes, the next is denied. (§ 3)
    const scalar before = P::dot(typename P::effort(state.coming(State::latency)), desired) / force;
    most = kernels::smaller(most, (most + kernels::larger(before, scalar(0))) / scalar(2));
  }
  return scalar(most / force);
}
}  // namespace detail

/// F s − B s² ≤ E1 [J] for every travel 0 ≤ s ≤ δ [m] along the force that the next tick can reach (ours, § 2(a′)).
/// A device of mass m that moves in cannot turn round within a tick, so a pressing force is hardly bounded; one
/// that moves out is bounded as far as the energy requires.
///     δ(1)   = outward_reach                          in the tick that begins now (L6)
///     δ(j+1) = δ(j) + (a(j) + a(j+1)) T²/2            in tick j + 1, a(j) = (|h(j)| + F_other)/m
/// In a loop that is k ticks late the new force f is held in tick k + 1. The forces held before it, h(1) … h(k),
/// were commanded earlier and are covered first:
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
/// Otherwise (a velocity source as hand, a lighter device) it can create energy, and tests show it.
struct reachable_bound {
  static constexpr guarantee passivity = guarantee::conditional;
  static constexpr bound_traits traits{
      .needs_ledger = true, .exact_travel = false, .latency = any_latency};

  double mass{};        ///< m [kg] that moves rigidly with the encoder, least over directions
  double hand_force{};  ///< largest force of all but motors and damper, with the cable's [N]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!detail::positive(mass)) return {"mass", mass, "finite and > 0 kg"};
    return detail::fault_of_hand(hand_force);
  }
  template <port Space>
  class on;
};

template <port Space>
class reachable_bound::on {
 public:
  using scalar = typename Space::scalar;
  using effort = typename Space::effort;
  static_assert(detail::has_geometry<Space>,
                "passive_haptics: reachable_bound knows one mass for all directions of a space: "
                "joints need reachable_work_bound");

  constexpr explicit on(const reachable_bound& p) noexcept
      : mass_(detail::number<scalar>(p.mass)), hand_force_(detail::number<scalar>(p.hand_force)) {}
  [[nodiscard]] constexpr reachable_bound parameters() const noexcept {
    return {.mass = static_cast<double>(mass_), .hand_force = static_cast<double>(hand_force_)};
  }

  template <class...>
  static constexpr bool only_reduces = true;  ///< on every axis, even if their dampings differ
  template <class State>
  [[nodiscard]] constexpr detail::what_is_left<State, Space> limit(
      const effort& desired, const State& state) const noexcept {
    if constexpr (detail::differs_by_axis<typename State::damping_type, Space>) {
      const scalar credit = detail::left_over<1>(state, *this);
      return detail::nearest_of<Space>(
          state.damping, desired,
          [&] { return detail::yield<Space>(state.damping, desired, credit, state.longest_tick); },
          [&](const effort& f) {
            return detail::covered(f, state, *this, [=](const auto&...) { return credit; });
          });
    } else {
      return {detail::covered(desired, state, *this)};
    }
  }

  /// The most work [J] that a force f can have done in a time `dt` [s] without samples. (§ 2(a″))
  [[nodiscard, gnu::cold, gnu::noinline]] constexpr detail::unseen_work<scalar> unseen(
      const detail::seen_tick<Space>& seen, const auto& damping, const effort& f,
      scalar dt) const noexcept {
    const scalar travel = kernels::square_root(seen.square) + seen.travel_error;
    const scalar force = Space::norm(f), held = kernels::larger(force, Space::norm(seen.held));
    return {
        force * kernels::longest_path(
                    scalar(travel / seen.dt), scalar((held + hand_force_) / mass_),
                    scalar(scalar(2) * detail::most_damping<Space>(damping) / mass_), seen.dt, dt),
        scalar(0)};
  }

  /// δ(J) [m] along `direction`, a vector of length `length`; `last` is the force held in tick J [N].
  template <int J, class State>
  [[nodiscard]] constexpr scalar reach(const effort& direction, scalar length, scalar last,
                                       const State& state) const noexcept {
    const scalar T = state.longest_tick;
    scalar moved = Space::norm(state.travel);
    if constexpr (!State::exact) moved += state.travel_error;
    const scalar other =
        hand_force_ + scalar(2) * (detail::most_damping<Space>(state.damping) / T) * moved;
    if constexpr (J == 1) {
      if (!state.motion_known) return kernels::largest<scalar>();  // the speed is unknown
      scalar outward = Space::dot(state.travel, direction) / length +
                       kernels::rounding<scalar>() * Space::norm(state.travel);
      if constexpr (!State::exact) {
        outward += state.travel_error * (state.dt / state.shortest_tick());
      }
      return kernels::outward_reach(outward, Space::norm(state.held), last, other, mass_, state.dt,
                                    T, state.recent.longest);
    } else {
      const scalar before = Space::norm(effort(state.coming(J - 1)));
      return reach<J - 1>(direction, length, before, state) +
             kernels::outward_reach(scalar(0), before, last, other, mass_, T, T);
    }
  }

 private:
  scalar mass_, hand_force_;
};

/// The same law in joules, for any port and any inertia M: a wrench, a gripper, joints. With the norm
/// ‖f‖ = √(fᵀM⁻¹f) [√J/s] and W = ¼fᵀB⁻¹f [J], the most work η(j) [J] that f can do in tick j is
///     η(1)   = f·Δx T/T₀ + ‖f‖ ((‖held‖ + F) T₀T + (‖h(1)‖ + F) T²)/2,   F = hand + 2‖(b/T)Δx‖
///     η(j+1) = η(j) + ‖f‖ ((‖h(j)‖ + F) + (‖h(j+1)‖ + F)) T²/2
/// and f is scaled by the largest share s ≤ 1 with s η' − η'²/(4W) ≤ E1 for every 0 ≤ η' ≤ η:
///     s = E1/η + η/(4W) where η² < 4 W E1,  √(E1/W) elsewhere                 (§ 2(a′), in joules)
/// In one degree of freedom it is the same bound as reachable_bound.
///
/// Passive under the assumptions of reachable_bound, where xᵀMx is at most that of the device's inertia in every
/// pose, and hand, load, dry friction and, of a mechanism, Coriolis forces have a norm of at most `hand`.
template <class Inertia>
struct basic_reachable_work_bound {
  static constexpr guarantee passivity = guarantee::conditional;
  static constexpr bound_traits traits{
      .needs_ledger = true, .exact_travel = true, .latency = any_latency};

  Inertia inertia{};  ///< M, a lower bound
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

template <class Inertia>
template <port P>
class basic_reachable_work_bound<Inertia>::on {
 public:
  using scalar = typename P::scalar;
  using effort = typename P::effort;
  static_assert(inertia_for<Inertia, P>,
                "passive_haptics: the inertia does not model inertia_for: see port/concepts.hpp");

  constexpr explicit on(const basic_reachable_work_bound& p) noexcept
      : inertia_(p.inertia), hand_(detail::number<scalar>(p.hand)) {}
  [[nodiscard]] constexpr basic_reachable_work_bound parameters() const noexcept {
    return {.inertia = inertia_.parameters(), .hand = static_cast<double>(hand_)};
  }

  template <class...>
  static constexpr bool only_reduces = true;
  template <class State>
  [[nodiscard]] constexpr detail::what_is_left<State, P> limit(const effort& desired,
                                                               const State& state) const noexcept {
    static_assert(!State::damping_type::rubs,
                  "passive_haptics: reachable_work_bound is proved for viscous damping: count dry "
                  "friction into `hand` instead of crediting it");
    scalar credit = state.energy;
    if constexpr (State::latency > 0) promise<1>(credit, state);
    const auto share_of = [&](const effort& f) {
      const scalar W = state.damping.worst_outflow(f, state.longest_tick);
      if (W <= kernels::spendable(credit)) return scalar(1);
      const scalar norm = inertia_.norm(f);
      if (!(norm > scalar(0))) return scalar(1);
      const scalar all =
          kernels::reachable_share(credit, W, reach<State::latency + 1>(f, norm, norm, state));
      if constexpr (State::latency > 0 && State::exact) {
        const scalar each = state.energy / scalar(State::latency + 1);  // as in covered()
        return kernels::smaller(all,
                                kernels::reachable_share(each, W, reach<1>(f, norm, norm, state)));
      } else {
        return all;
      }
    };
    if constexpr (detail::differs_by_axis<typename State::damping_type, P>) {
      return detail::nearest_of<P>(
          state.damping, desired,
          [&] { return detail::yield<P>(state.damping, desired, credit, state.longest_tick); },
          share_of);
    } else {
      return {share_of(desired)};
    }
  }

 private:
  template <int J, class State>
  constexpr void promise(scalar& credit, const State& state) const noexcept {
    const effort h = state.coming(J);
    const scalar norm = inertia_.norm(h);
    if (norm > scalar(0)) {
      const scalar W = state.damping.worst_outflow(h, state.longest_tick);
      credit -= kernels::reachable_work(W, reach<J>(h, norm, norm, state)) *
                (scalar(1) + kernels::rounding<scalar>());
    }
    if constexpr (J < State::latency) promise<J + 1>(credit, state);
  }

  /// η(J) [J] of an effort f of norm `norm`; `last` is the norm of the effort held in tick J [√J/s].
  template <int J, class State>
  [[nodiscard]] constexpr scalar reach(const effort& f, scalar norm, scalar last,
                                       const State& state) const noexcept {
    const scalar T = state.longest_tick;
    const scalar up = scalar(1) + kernels::rounding<scalar>();
    const effort damper = state.damping.force(state.travel, T);
    const scalar other = hand_ + scalar(2) * inertia_.norm(damper);
    if constexpr (J == 1) {
      if (!state.motion_known) return kernels::largest<scalar>();
      const auto work = P::work(f, state.travel);
      const scalar outward = work.joules + kernels::rounding<scalar>() * work.passed;
      const scalar T0 = kernels::larger(state.dt, state.recent.longest);
      const scalar pushed = (inertia_.norm(state.held) + other) * T0 * T + (last + other) * T * T;
      return outward * T / state.dt + norm * pushed / scalar(2) * up;
    } else {
      const scalar before = inertia_.norm(effort(state.coming(J - 1)));
      return reach<J - 1>(f, norm, before, state) +
             norm * (before + last + scalar(2) * other) * T * T / scalar(2) * up;
    }
  }

  part_at<Inertia, P> inertia_;
  scalar hand_;
};

static_assert(force_bound_for<reachable_bound, space<float, 1>>);
static_assert(force_bound_for<reachable_work_bound<1>, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
