// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Bounds of a wrench, for a handle that moves and turns (rigid_body).
//
//   rigid_reachable_bound   covers the motion that the handle's inertia admits in the next tick
//   rigid_actuator_limit    |f| and |τ| at most those of the motors
//
// One share scales the whole wrench, because a force and a torque bounded apart would spend the ledger twice.

#include <passive_haptics/device/rigid_damping.hpp>
#include <passive_haptics/device/rigid_inertia.hpp>
#include <passive_haptics/port/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

/// reachable_work_bound for a rigid_body. With ‖w‖ of rigid_inertia and W = ¼wᵀB⁻¹w, the most work that w can
/// do in the tick that begins now is
///     η = w·Δξ T/T₀ + ‖w‖ ((‖held‖ + F) T₀T + (‖w‖ + F) T²)/2 + |τ|(|θ| + α T₀²)α T₀T/12
/// where F [√J/s] is a bound on the norm of all forces but the motors', the sum of
///     hand_force + 2 b_max|Δp|/T₀, hand_torque + 2 b_ω,max|θ|/T₀      the hand, and the damper at most
///     |ω|² √(m|c|² + (I_max − I_min)²/(4I)), |ω| = 2|θ|/T₀            centrifugal and gyroscopic forces
/// The last term bounds the error of the turn that the end poses of the last tick show (docs/design/six_dof.md),
/// with α = (‖held‖ + F)/√I [rad/s²] the largest angular acceleration. The wrench is scaled by the share s ≤ 1:
///     s = E1/η + η/(4W) where η² < 4 W E1,  √(E1/W) elsewhere
/// In a loop one tick late, the wrench commanded before is covered first, and then w, as in reachable_work_bound.
///
/// Passive (the true E ≥ 0; the ledger is a lower bound of E and may show a debt) under ALL of these:
///   - the inertia is nowhere below that of rigid_inertia, in any pose; the hand's wrench at the handle point
///     has at most hand_force and hand_torque;
///   - in any direction the damping at the handle is between the ledger's b and both upper bounds (above: no loss found);
///   - in the coming ticks the handle is at most twice as fast as its mean in the last one, or so slow that its
///     damper and its gyroscopic forces are small compared with the hand's;
///   - ticks are ≤ longest_tick, poses are exact, and the held wrench is known and constant in the world frame.
/// The share also keeps |τ| ≤ 4b_ω/T (lemma C). For motors that hold joint torques use strict_bound and reported_work.
struct rigid_reachable_bound {
  static constexpr guarantee passivity = guarantee::conditional;
  static constexpr bound_traits traits{.needs_ledger = true, .latency = 1, .turns = true};

  rigid_inertia inertia{};        ///< a lower bound of the device's inertia
  double hand_force{};            ///< largest force of all but motors and damper [N]
  double hand_torque{};           ///< largest torque of these about the handle point [N·m]
  double linear_damping_most{};   ///< b_max, an upper bound in any direction [N·s/m]
  double angular_damping_most{};  ///< b_ω,max, an upper bound about any axis [N·m·s/rad]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    using detail::not_negative, detail::positive;
    if (const auto fault = inertia.check()) return fault;
    if (!not_negative(hand_force)) return {"hand_force", hand_force, "finite and ≥ 0 N"};
    if (!not_negative(hand_torque)) return {"hand_torque", hand_torque, "finite and ≥ 0 N·m"};
    if (!positive(linear_damping_most)) {
      return {"linear_damping_most", linear_damping_most, "finite and > 0 N·s/m: an upper bound"};
    }
    if (!positive(angular_damping_most)) {
      return {"angular_damping_most", angular_damping_most,
              "finite and > 0 N·m·s/rad: an upper bound"};
    }
    return {};
  }
  template <port P>
  class on;
};

template <port P>
class rigid_reachable_bound::on {
 public:
  using scalar = typename P::scalar;
  using effort = typename P::effort;
  static_assert(
      detail::moves_and_turns<P>,
      "passive_haptics: rigid_reachable_bound knows the inertia of a handle that moves and turns: "
      "other ports need reachable_bound or reachable_work_bound");

  constexpr explicit on(const rigid_reachable_bound& p) noexcept
      : inertia_(p.inertia),
        hand_force_(detail::number<scalar>(p.hand_force)),
        hand_torque_(detail::number<scalar>(p.hand_torque)),
        linear_most_(detail::number<scalar>(p.linear_damping_most)),
        angular_most_(detail::number<scalar>(p.angular_damping_most)) {}
  [[nodiscard]] constexpr rigid_reachable_bound parameters() const noexcept {
    return {.inertia = inertia_.parameters(),
            .hand_force = static_cast<double>(hand_force_),
            .hand_torque = static_cast<double>(hand_torque_),
            .linear_damping_most = static_cast<double>(linear_most_),
            .angular_damping_most = static_cast<double>(angular_most_)};
  }

  template <class State>
  [[nodiscard]] constexpr share<scalar> limit(const effort& desired,
                                              const State& state) const noexcept {
    const scalar T = state.longest_tick;
    const scalar known = kernels::coning_share(scalar(1), inertia_.template squared<3>(desired),
                                               state.damping.along_axis(3), T);
    const effort wrench = desired * known;
    const scalar W = state.damping.worst_outflow(wrench, T);
    if constexpr (State::latency == 0) {
      if (W <= kernels::spendable(state.energy))
        return share{known};  // the worst motion is covered
    }
    const surroundings all = around(state);
    const scalar norm = inertia_.norm(wrench);
    scalar credit = state.energy;
    scalar before = norm;
    scalar later(0);
    if constexpr (State::latency > 0) {
      const effort coming = state.coming(1);
      before = inertia_.norm(coming);
      later = kernels::later_reach(norm, before, norm, all.pushed, T);
      if (before > scalar(0)) {
        const scalar worst = state.damping.worst_outflow(coming, T);
        credit -= kernels::reachable_work(worst, reach(coming, before, before, all, state)) *
                  (scalar(1) + kernels::rounding<scalar>());
      }
    }
    if (W <= kernels::spendable(credit) || !(norm > scalar(0))) return share{known};
    const scalar most = reach(wrench, norm, before, all, state) + later;
    scalar allowed = kernels::reachable_share(credit, W, most);
    if constexpr (State::latency >
                  0) {  // its share, or commands would take turns: see reachable_bound
      const scalar each = state.energy / scalar(State::latency + 1);
      allowed = kernels::smaller(
          allowed, kernels::reachable_share(each, W, reach(wrench, norm, norm, all, state)));
    }
    return share{known * allowed};
  }

  /// Names damping and tick where the torque has reached 4b_ω/T, the largest that is let pass (lemma C).
  constexpr void explain(explanation& e, const auto& damping, scalar T,
                         int /*late*/) const noexcept {
    const double most = 4.0 * static_cast<double>(damping.along_axis(3) / T);
    if (e.torque > 0.95 * most) e.now = softened_by::damping_and_tick;
  }

  /// The most work [J] that w can have done in a time `dt` [s] without samples, and the part of it that the end poses
  /// of a turn may hide. (mathematics.md § 2(a″))
  [[nodiscard, gnu::cold, gnu::noinline]] constexpr detail::unseen_work<scalar> unseen(
      const detail::seen_tick<P>& seen, const auto& /*damping*/, const effort& w,
      scalar dt) const noexcept {
    const scalar gone = kernels::square_root(seen.square), turned_by = scalar(10) * gone;
    const scalar most = kernels::largest<scalar>(), T0 = seen.dt, c = inertia_.offset();
    const surroundings all = around(
        gone, turned_by, T0, kernels::larger(inertia_.norm(effort(seen.held)), inertia_.norm(w)));
    const scalar last = (all.held + all.pushed) * T0 / scalar(2);
    const scalar travelled = gone / T0 + inertia_.moving_by(last);
    const scalar turned = (turned_by + kernels::unseen_turn(turned_by, all.turning, T0)) / T0 +
                          inertia_.turning_by(last);
    const auto turn = [&](scalar pushed, scalar t) {
      return inertia_.swing() * (turned + inertia_.turning_by(pushed) * t);
    };
    const auto move = [&](scalar pushed, scalar t) {
      return travelled + inertia_.moving_by(pushed) * t + scalar(2) * c * turn(pushed, dt);
    };
    const scalar without = all.held + inertia_.norm(hand_force_, hand_torque_);
    const scalar speed = scalar(2) * move(without, dt), rate = scalar(2) * turn(without, dt);
    const scalar pushed = all.held + inertia_.norm(scalar(hand_force_ + linear_most_ * speed),
                                                   scalar(hand_torque_ + angular_most_ * rate));
    if (!(all.turn <= scalar(1) && move(pushed, dt) <= speed && turn(pushed, dt) <= rate)) {
      return {most, most};
    }
    const scalar up = dt * (scalar(1) + kernels::rounding<scalar>());
    const scalar torque = inertia_.template length<3>(w);
    const scalar path = turn(pushed, dt / scalar(2)) * up;
    return {inertia_.template length<0>(w) * move(pushed, dt / scalar(2)) * up + torque * path,
            torque * kernels::unseen_arc(path)};
  }

 private:
  /// The forces on the handle and its motion in the last tick, taken as bounds for the coming ones.
  struct surroundings {
    scalar held;     ///< ‖held‖ [√J/s]
    scalar pushed;   ///< F, the norm of all other forces [√J/s]
    scalar turn;     ///< |θ| [rad]
    scalar turning;  ///< α [rad/s²]
  };
  [[nodiscard]] constexpr surroundings around(const auto& state) const noexcept {
    return around(inertia_.template length<0>(state.travel),
                  inertia_.template length<3>(state.travel), state.dt,
                  inertia_.norm(effort(state.held)));
  }
  [[nodiscard]] constexpr surroundings around(scalar travel, scalar turn, scalar dt,
                                              scalar held) const noexcept {
    const scalar speed = scalar(2) / dt;
    const scalar rate = speed * turn;
    const scalar pushed = inertia_.norm(scalar(hand_force_ + linear_most_ * speed * travel),
                                        scalar(hand_torque_ + angular_most_ * rate)) +
                          inertia_.of_turning(rate);
    return {held, pushed, turn, inertia_.turning_by(held + pushed)};
  }

  /// η [J] of a wrench w of norm `norm` in the tick that begins now, during which a wrench of norm `next` is held.
  [[nodiscard]] constexpr scalar reach(const effort& w, scalar norm, scalar next,
                                       const surroundings& all, const auto& state) const noexcept {
    if (!state.motion_known || !(all.turn <= scalar(1))) return kernels::largest<scalar>();
    const scalar T = state.longest_tick;
    const auto work = P::work(w, state.travel);
    const scalar outward = work.joules + kernels::rounding<scalar>() * work.passed;
    const scalar last =
        (all.held + all.pushed) * kernels::larger(state.dt, state.recent.longest) * T;
    const scalar pushed = norm * (last + (next + all.pushed) * T * T) / scalar(2);
    const scalar beside = inertia_.template length<3>(w) *
                          kernels::unseen_turn(all.turn, all.turning, state.dt) * T / state.dt;
    return outward * T / state.dt + (pushed + beside) * (scalar(1) + kernels::rounding<scalar>());
  }

  part_at<rigid_inertia, P> inertia_;
  scalar hand_force_, hand_torque_, linear_most_, angular_most_;
};

/// |f| ≤ `force` and |τ| ≤ `torque`, the limits of the motors. One share scales the whole wrench.
struct rigid_actuator_limit {
  static constexpr guarantee passivity = guarantee::none;
  static constexpr bound_traits traits{.exact_travel = false, .latency = any_latency};

  double force{};   ///< largest force [N]
  double torque{};  ///< largest torque [N·m]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!detail::not_negative(force)) return {"force", force, "finite and ≥ 0 N"};
    if (!detail::not_negative(torque)) return {"torque", torque, "finite and ≥ 0 N·m"};
    return {};
  }

  template <port P>
  class on {
   public:
    using scalar = typename P::scalar;
    static_assert(
        detail::moves_and_turns<P>,
        "passive_haptics: rigid_actuator_limit bounds a force and a torque: other ports need "
        "actuator_limit or motor_limits");

    constexpr explicit on(const rigid_actuator_limit& p) noexcept
        : force_(detail::number<scalar>(p.force)), torque_(detail::number<scalar>(p.torque)) {}
    [[nodiscard]] constexpr rigid_actuator_limit parameters() const noexcept {
      return {.force = static_cast<double>(force_), .torque = static_cast<double>(torque_)};
    }
    [[nodiscard]] constexpr share<scalar> limit(const typename P::effort& desired,
                                                const auto& /*state*/) const noexcept {
      using lengths = part_at<rigid_inertia, P>;
      const scalar f = lengths::template length<0>(desired);
      const scalar t = lengths::template length<3>(desired);
      scalar least(1);
      if (f > force_) least = force_ / f;
      if (t * least > torque_) least = torque_ / t;
      return {least};
    }
    [[nodiscard]] constexpr typename P::effort most_held() const noexcept {
      typename P::effort most = P::zero();
      P::component(most, 0) = scalar(2) * force_;
      P::component(most, 3) = scalar(2) * torque_;
      return most;
    }
    [[nodiscard]] constexpr bool can_hold(const typename P::effort& held) const noexcept {
      using lengths = part_at<rigid_inertia, P>;
      return detail::can_be_held(lengths::template length<0>(held), force_) &&
             detail::can_be_held(lengths::template length<3>(held), torque_);
    }
    constexpr void explain(explanation& e, const auto& /*damping*/, scalar /*T*/,
                           int /*late*/) const noexcept {
      e.saturate(static_cast<double>(force_), static_cast<double>(torque_));
    }

   private:
    scalar force_, torque_;
  };
};

}  // namespace v0
}  // namespace passive_haptics
