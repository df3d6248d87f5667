// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Ports of a rigid body, right ones and ones that leave out a term, which are the controls of the tests in six
// degrees of freedom.
#include "rigid_attacks.hpp"
#include <passive_haptics/contact/given_force.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/force_bound/actuator_limit.hpp>
#include <passive_haptics/force_bound/rigid_reachable_bound.hpp>
#include <passive_haptics/force_bound/strict_bound.hpp>
#include <passive_haptics/port/passive_port.hpp>

#include <cmath>

namespace rigid {

/// The device of docs/design/six_dof.md: T = 1 ms, 0.15 kg, moments 1, 3 and 1.5e-4 kg·m², a hand of 5 N and
/// 0.2 N·m.
inline constexpr ph::rigid_damping damping{.linear = 0.03, .angular = 1e-4};
inline constexpr ph::rigid_reachable_bound reachable{
    .inertia = {.mass = 0.15, .least = 1e-4, .spread = 2e-4},
    .hand_force = 5.0,
    .hand_torque = 0.2,
    .linear_damping_most = 0.03,
    .angular_damping_most = 1e-4};

template <int Latency>
inline constexpr ph::late_loop_limits<Latency> loop{
    .longest_tick = 1e-3, .top_speed = 1e4, .workspace = ph::loop_limits::never};

template <class P = body, int Latency = 0, class Damping = ph::rigid_damping, class Bound>
[[nodiscard]] auto bounded_by(const Bound& bound, double loan = 0.0,
                              const Damping& b = {0.03, 1e-4}) {
  return ph::passive_port{P{}, ph::given_force{},
                          ph::basic_reduced_energy<Damping>{.damping = b, .loan = loan}, bound,
                          loop<Latency>};
}

/// A rigid_damping whose coning margin is dt|θ × τ|²/(Part b_ω), or 0 for Part = 0.
template <int Part>
struct other_margin {
  double linear{}, angular{};
  [[nodiscard]] constexpr ph::parameter_fault check() const noexcept { return {}; }

  template <class P>
  struct on : ph::part_at<ph::rigid_damping, P> {
    using base = ph::part_at<ph::rigid_damping, P>;
    constexpr explicit on(const other_margin& p) noexcept : base({p.linear, p.angular}) {}
    [[nodiscard]] constexpr other_margin parameters() const noexcept {
      return {base::parameters().linear, base::parameters().angular};
    }
    [[nodiscard]] double unsure(const typename P::motion& m, const typename P::effort& held,
                                double dt) const noexcept {
      const auto turn = P::angular(m);
      if (turn.squaredNorm() > 1) return base::unsure(m, held, dt);
      if constexpr (Part == 0) return 0.0;
      return dt * d3::cross(turn, P::angular(held)).squaredNorm() /
             ((Part == 0 ? 1 : Part) * this->along_axis(3));
    }
  };
};

/// Takes 2 vec(q₁q₀*) for the turn, so it has 2 sin(θ/2) in place of the angle θ.
struct sine_pairing : body {
  [[nodiscard]] static motion between(const pose& from, const pose& to) noexcept {
    const motion right = body::between(from, to);
    const vec3 turn = angular(right);
    const double angle = turn.norm();
    return angle > 1e-9 ? join(linear(right), turn * (2 * std::sin(angle / 2) / angle)) : right;
  }
};
/// Takes the logarithm of SE(3), about the first handle point, for the motion.
struct twist_pairing : body {
  [[nodiscard]] static motion between(const pose& from, const pose& to) noexcept {
    const motion right = body::between(from, to);
    const vec3 gone = linear(right), turn = angular(right);
    const double a = turn.norm();
    const double k =
        a < 1e-4 ? 1.0 / 12 : (1 / (a * a) - (1 + std::cos(a)) / (2 * a * std::sin(a)));
    const vec3 across = d3::cross(turn, gone);
    return join(gone - across / 2 + d3::cross(turn, across) * k, turn);
  }
};

/// Bounds force and torque apart, each as if the ledger were its own.
struct bounded_apart {
  static constexpr ph::guarantee passivity = ph::guarantee::strict;
  static constexpr ph::bound_traits traits = ph::strict_bound::traits;
  [[nodiscard]] constexpr ph::parameter_fault check() const noexcept { return {}; }

  template <ph::port P>
  struct on {
    constexpr explicit on(const bounded_apart& /*p*/) noexcept {}
    [[nodiscard]] typename P::effort limit(const typename P::effort& desired,
                                           const auto& state) const noexcept {
      const vec3 none(0, 0, 0);
      const auto half = [&state](const typename P::effort& w) {
        return
            typename P::effort(w * state.damping.affordable(w, state.credit(), state.longest_tick));
      };
      return half(P::join(P::linear(desired), none)) + half(P::join(none, P::angular(desired)));
    }
  };
};

/// rigid_reachable_bound in a loop that is a tick late, without what the wrench of the tick before, and the
/// wrench itself, do in the tick in which it is held.
struct without_last_bracket {
  static constexpr ph::guarantee passivity = ph::guarantee::conditional;
  static constexpr ph::bound_traits traits = ph::rigid_reachable_bound::traits;
  ph::rigid_reachable_bound bound{};
  [[nodiscard]] constexpr ph::parameter_fault check() const noexcept { return bound.check(); }

  template <ph::port P>
  struct on {
    constexpr explicit on(const without_last_bracket& p) noexcept
        : bound(p.bound), inertia(p.bound.inertia) {}
    [[nodiscard]] constexpr without_last_bracket parameters() const noexcept {
      return {bound.parameters()};
    }
    /// η of w in the coming tick, F and all as in rigid_reachable_bound.
    [[nodiscard]] double reach(const typename P::effort& w, double next,
                               const auto& state) const noexcept {
      const auto p = bound.parameters();
      const double T = state.longest_tick, rate = 2 * P::angular(state.travel).norm() / state.dt;
      const double speed = 2 * P::linear(state.travel).norm() / state.dt;
      const double F = inertia.norm(p.hand_force + p.linear_damping_most * speed,
                                    p.hand_torque + p.angular_damping_most * rate) +
                       inertia.of_turning(rate);
      const double held = inertia.norm(typename P::effort(state.held));
      const double beside =
          P::angular(w).norm() *
          ph::kernels::unseen_turn(rate * state.dt / 2, inertia.turning_by(held + F), state.dt);
      return w.dot(state.travel) * T / state.dt +
             inertia.norm(w) * ((held + F) * state.dt * T + (next + F) * T * T) / 2 + beside;
    }
    [[nodiscard]] ph::share<double> limit(const typename P::effort& desired,
                                          const auto& state) const noexcept {
      const double T = state.longest_tick;
      const typename P::effort coming = state.commanded[0];
      const double h = inertia.norm(coming);
      const double promised = ph::kernels::reachable_work(state.damping.worst_outflow(coming, T),
                                                          reach(coming, h, state));
      const double W = state.damping.worst_outflow(desired, T);
      return {ph::kernels::reachable_share(state.energy - promised, W, reach(desired, h, state))};
    }
    typename ph::rigid_reachable_bound::template on<P> bound;
    ph::part_at<ph::rigid_inertia, P> inertia;
  };
};

}  // namespace rigid
