// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The admittance side of a two-port: motion out to the tool in the environment, force back.

#include <passive_haptics/base/seconds.hpp>
#include <passive_haptics/port/concepts.hpp>
#include <passive_haptics/two_port/packet.hpp>

#include <limits>

namespace passive_haptics {
inline namespace v0 {

struct admittance_parameters {
  double stiffness{};  ///< K [N/m]: in a step f changes by at most K ‖Δp‖; 0: f is held over a step
  double drift_rate{};  ///< share of the position drift that is corrected in a second [1/s]
  double top_speed = std::numeric_limits<double>::infinity();  ///< top speed of the tool [m/s]
  double loan{};                                               ///< E1 at the start [J]
  double cap = std::numeric_limits<double>::infinity();        ///< most credit to keep [J] (L7)

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!detail::not_negative(stiffness)) return {"stiffness", stiffness, "finite and ≥ 0 N/m"};
    if (!detail::not_negative(drift_rate)) return {"drift_rate", drift_rate, "finite and ≥ 0 1/s"};
    if (!(top_speed > 0.0)) return {"top_speed", top_speed, "> 0 m/s"};
    if (!detail::not_negative(loan)) return {"loan", loan, "finite and ≥ 0 J"};
    if (!(cap >= 0.0)) return {"cap", cap, "≥ 0 J"};
    return {};
  }
};

template <class Space>
struct admittance_result {
  typename Space::vector displacement;  ///< Δp', by which the environment is to move the tool [m]
  typename Space::vector drift;         ///< position of the hand less that of the tool [m]
  typename Space::scalar energy;        ///< E1 = E_in_rx − E_out [J]
  event what = event::nominal;          ///< the worst that happened in the step
  bool limited = false;                 ///< the controller changed the desired motion
};

/// The passivity controller β and its observer, in discrete time. Step k of the environment takes
/// the force f(k) of the environment on the tool [N], known BEFORE the tool moves, and moves the
/// tool by Δp'(k). The energy w [J] that goes into the environment is then known and not predicted:
///     w = −f(k)·Δp'(k) + K ‖Δp'‖²/2  ≤  E1 = E_in_rx − E_out                    at every step
///     w > 0: E_out += w      w < 0: E_in += −w
/// Of the desired motion Δp, only the part along f is reduced:  Δp' = Δp + β f  with the least β ≥ 0 that suffices
/// (v' = v − β f of § 2(d), where f is the force INTO the environment). So E_out ≤ E_in_rx exactly: no energy
/// is carried over, and f needs no threshold.
///
/// Strict, K = 0: for every environment that consumes (Δp', f) in discrete time, i.e. whose port
/// energy is Σ f(k)·Δp'(k), however active it is.
/// Strict, K > 0: for every environment in continuous time whose force on the straight way changes
/// by at most K per metre, and that moves by itself between steps only. Its cost is Colgate's: a
/// motion costs K ‖Δp‖²/2 [J] a step, in free space too, which the loan or a hand that works against a force must
/// have paid in. settle() returns the unused part. If K = 0 is stated for an environment with K > 0, that
/// environment receives up to K ‖Δp'‖²/2 a step that no ledger counts.
///
/// Drift: motion that was reduced, by the ledger or top_speed, stays missing, unless drift_rate > 0 adds the share
/// drift_rate·dt of it to each step. It is added to Δp, so it is paid for like any motion. (The purpose is that
/// of Chawda and O'Malley's drift compensators, from memory; the law is ours.)
///
/// It assumes that the tool moves as commanded, and that f is the force of that step.
template <class Space, class Ledger = typename Space::scalar>
class admittance_side {
 public:
  using space_type = Space;
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  using packet_type = port_packet<scalar, typename Space::coordinates>;
  static constexpr guarantee passivity = guarantee::strict;

  /// `start` [m] is where tool and hand both are at first.
  constexpr explicit admittance_side(const admittance_parameters& parameters = {},
                                     const vector& start = Space::zero()) noexcept
      : parameters_(parameters),
        energy_(detail::number<scalar>(parameters.loan)),
        target_(start),
        followed_(start),
        position_(start),
        sound_(!parameters.check()) {}

  [[nodiscard]] constexpr parameter_fault check() const noexcept { return parameters_.check(); }
  /// Sets new parameters, unless they have a fault. The ledger and the position stay; no new loan is lent.
  constexpr parameter_fault set(const admittance_parameters& p) noexcept {
    const auto fault = p.check();
    if (fault) return fault;
    parameters_ = p;
    sound_ = true;
    cut();
    return fault;
  }

  /// Takes a packet {E_in [J], position [m]} from the other side. A position that is not finite is ignored.
  constexpr void receive(const packet_type& packet) noexcept {
    energy_ += received_.gain(packet.energy);
    cut();
    if (packet.number <= newest_ || !Space::is_finite(packet.payload)) return;
    newest_ = packet.number;
    target_ = packet.payload;
  }

  /// Takes a step of the environment of `length` [s] that begins under `force` [N] on the tool. If the force is
  /// not finite or the length ≤ 0, it returns no motion and event::rejected_sample; the next step makes up for it.
  [[nodiscard]] constexpr admittance_result<Space> step(const vector& force,
                                                        seconds<scalar> length) noexcept {
    const scalar dt = length.count();
    reserved_ = scalar(0);
    if (!sound_) return result(Space::zero(), event::rejected_parameters, false);
    if (!Space::is_finite(force) || !(dt > scalar(0)) || !kernels::is_finite(dt)) {
      return result(Space::zero(), event::rejected_sample, false);
    }
    const vector wanted = desired_motion(dt);
    const vector moved = affordable(wanted, force);
    book(Space::dot(force, moved) - leak(moved));
    followed_ = target_;
    const vector at = position_;
    position_ = vector(at + moved);
    event what = newest_ == 0 ? event::no_target : event::nominal;
    if (value() < scalar(0)) what = worse(what, event::debt);
    return result(moved, what, !(moved == wanted));
  }
  /// Does not compile: a bare number as the length could as well be a force.
  template <std::convertible_to<scalar> Number>
  admittance_result<Space> step(const vector& /*force*/, const Number& /*length*/) noexcept {
    detail::refuse_bare_time<Number>();
    return result(Space::zero(), event::nominal, false);
  }

  /// Takes, after a step with K > 0, the work [J] that the environment did on the tool in it, ∫ f·dp',
  /// exact or a lower bound: the part of the step's reserve that was not needed becomes credit again.
  constexpr void settle(scalar work) noexcept {
    if (!kernels::is_finite(work)) return;
    energy_ += work - reserved_;
    reserved_ = work;
    cut();
  }

  /// The packet {E_in [J], force [N]} for the other side, to send after each step; `force` is the new one.
  [[nodiscard]] constexpr packet_type packet(const vector& force) noexcept {
    return {static_cast<scalar>(promised_), ++number_, force};
  }
  [[nodiscard]] constexpr vector position() const noexcept { return position_; }  ///< tool [m]
  [[nodiscard]] constexpr scalar energy() const noexcept { return value(); }      ///< E1 [J]

 private:
  [[nodiscard]] constexpr scalar value() const noexcept { return static_cast<scalar>(energy_); }
  constexpr void cut() noexcept {
    const scalar cap = detail::number<scalar>(parameters_.cap);
    if (value() > cap) energy_ = cap;
  }

  /// The motion of the hand since the last step, and drift_rate·dt of the drift, at most at top_speed.
  [[nodiscard]] constexpr vector desired_motion(scalar dt) const noexcept {
    const vector goal = target_;
    const vector followed = followed_;
    const vector here = position_;
    const scalar some =
        kernels::smaller(detail::number<scalar>(parameters_.drift_rate) * dt, scalar(1));
    const vector wanted = goal - followed + (followed - here) * some;
    const scalar length = Space::norm(wanted);
    const scalar most = detail::number<scalar>(parameters_.top_speed) * dt;
    return length > most ? vector(wanted * (most / length)) : wanted;
  }

  /// K ‖Δp‖²/2 [J], the most that a force which changes by K per metre can add to −f·Δp.
  [[nodiscard]] constexpr scalar leak(const vector& motion) const noexcept {
    return detail::number<scalar>(parameters_.stiffness) * Space::dot(motion, motion) / scalar(2);
  }

  /// The motion nearest to `wanted` with −f·Δp ≤ E1; for K > 0 it is then shortened until E1 covers the leak,
  /// too. Rounding only ever shortens it.
  [[nodiscard]] constexpr vector affordable(const vector& wanted,
                                            const vector& force) const noexcept {
    const scalar rounding = scalar(8) * std::numeric_limits<scalar>::epsilon();
    const scalar credit = kernels::larger(value(), scalar(0));
    const scalar asked = -Space::dot(force, wanted);
    vector moved = wanted;
    if (asked > credit) {
      const scalar square = Space::dot(force, force);
      if (!(square > scalar(0))) return Space::zero();
      const scalar margin = rounding * Space::norm(force) * Space::norm(wanted);
      moved = vector(wanted + force * ((asked - credit + margin) / square));
    }
    const scalar cost = leak(moved);
    const scalar outflow = -Space::dot(force, moved);
    if (!(cost > scalar(0)) || outflow + cost <= credit) return moved;
    // cost s² + outflow s = credit
    const scalar root = kernels::square_root(outflow * outflow + scalar(4) * cost * credit);
    const scalar s = outflow > scalar(0) ? scalar(2) * credit / (outflow + root)
                                         : (root - outflow) / (scalar(2) * cost);
    return moved * (s * (scalar(1) - rounding));
  }

  /// Books the work of the environment on the tool [J]: work > 0 is promised to the other side, work < 0 is
  /// taken from E1.
  constexpr void book(scalar work) noexcept {
    reserved_ = work;
    (work > scalar(0) ? promised_ : energy_) += work;
  }

  [[nodiscard]] constexpr admittance_result<Space> result(const vector& moved, event what,
                                                          bool limited) const noexcept {
    const vector goal = target_;
    const vector here = position_;
    return {moved, vector(goal - here), value(), what, limited};
  }

  admittance_parameters parameters_;
  Ledger energy_{};                     ///< E1 [J]
  Ledger promised_{};                   ///< E_in [J], never falls
  received_energy<scalar> received_{};  ///< E_in_rx [J]
  scalar reserved_{};                   ///< work booked for the last step [J]
  typename Space::coordinates target_{}, followed_{}, position_{};
  std::uint64_t newest_ = 0, number_ = 0;
  bool sound_ = true;
};

}  // namespace v0
}  // namespace passive_haptics
