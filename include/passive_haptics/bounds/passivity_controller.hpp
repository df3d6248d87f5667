// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Time-domain passivity: count the energy, and damp when it has turned negative (PO/PC).
//
//   series_passivity_controller     f = f* − α v   position in, force out       NOT passive
//   parallel_passivity_controller   v = v* + β f   force in, velocity out       NOT passive
//
// They repay a deficit that has already happened, and only if the motion (the force) goes on as it
// did. With a hand that damps they are hardly felt.
//
// Not offered: the published pairing of the NEW force with the last displacement. On a sampled wall
// it counts the leak of the hold with the wrong sign and never acts (lemma L2; a test shows it).

#include <passive_haptics/concepts.hpp>

#include <cstdint>
#include <limits>

namespace passive_haptics {
inline namespace v0 {

/// Whether the damping of the device pays for the environment too.
enum class damping_credit : std::uint8_t {
  none,     ///< counts the environment alone; needs no observer
  counted,  ///< acts only when device and environment together have lost
};

/// A damper that repays what the port has lost (series form, impedance causality):
///     E(n) = E(n−1) − f_held·Δx [+ Δxᵀ(b/dt)Δx]
///     f = f* − α v,   α = (E_thr + r K d²/2 − E) dt/‖Δx‖²  in [0, max_damping],   v = Δx/dt
/// What α may not take is carried to the next tick. Keeps its own E, so no_observer will do unless
/// the damping is counted. f may push inwards. Sources: Hannaford and Ryu 2002 (the idea and α);
/// the pairing with the held force is docs/design/mathematics.md § 2(c); r = 1 is inspired by the
/// reference energy of Ryu, Preusche, Hannaford and Hirzinger 2005: it repays during the whole
/// release instead of in one late burst.
///
/// NOT passive. Uncapped, E(n+1) = −f*·Δx(n+1) + E(n)(1 − Δx(n+1)/Δx(n)): the deficit is repaid if
/// the motion goes on and DOUBLES if it turns round. A damper of α on a free mass m is stable for
/// α < 2 m/T and overshoots above 0.343 m/T: take max_damping ≤ 0.35 to 0.5 m/T.
template <class Space, damping_credit Credit = damping_credit::none>
struct series_passivity_controller {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr guarantee passivity = guarantee::none;
  static constexpr bound_traits traits{.needs_ledger = Credit == damping_credit::counted};

  scalar max_damping{};   ///< largest α [N·s/m], > 0
  scalar threshold{};     ///< E_thr [J]; below zero it is a loan
  scalar reference{};     ///< r, share of the spring's energy that must still be there, 0 to 1
  scalar least_speed{};   ///< no action below this [m/s]
  scalar least_travel{};  ///< nor for ‖Δx‖ below this [m]: one quantum of the encoder
  scalar reset_after =
      std::numeric_limits<scalar>::max();  ///< force-free time that voids E > 0 [s]
  scalar energy{};                         ///< E [J]; its first value is a loan
  scalar idle{};                           ///< force-free time so far [s]
  bool started = false;                    ///< has there been a tick?

  [[nodiscard]] constexpr vector limit(const vector& desired, const auto& state) noexcept {
    book(state);
    started = true;
    const scalar square = Space::dot(state.displacement, state.displacement);
    const scalar least = kernels::larger(least_speed * state.dt, least_travel);
    if (!(square > scalar(0)) || square < least * least) return desired;
    const bool touching = Space::dot(desired, desired) > scalar(0);
    const scalar depth = touching ? kernels::larger(state.target_depth, scalar(0)) : scalar(0);
    const scalar wanted = threshold + reference * state.stiffness * depth * depth / scalar(2);
    if (!(energy < wanted)) return desired;
    const scalar damping = kernels::smaller((wanted - energy) * state.dt / square, max_damping);
    return desired - state.displacement * (damping / state.dt);
  }

  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept {
    if (!(max_damping > scalar(0)) || !kernels::is_finite(max_damping)) {
      return {"max_damping", max_damping, "finite and > 0 N·s/m"};
    }
    if (!kernels::is_finite(threshold)) return {"threshold", threshold, "finite, in J"};
    if (!(reference >= scalar(0) && reference <= scalar(1))) {
      return {"reference", reference, "in [0, 1]"};
    }
    if (!(least_speed >= scalar(0)) || !kernels::is_finite(least_speed)) {
      return {"least_speed", least_speed, "finite and ≥ 0 m/s"};
    }
    if (!(least_travel >= scalar(0)) || !kernels::is_finite(least_travel)) {
      return {"least_travel", least_travel, "finite and ≥ 0 m"};
    }
    if (!(reset_after >= scalar(0))) return {"reset_after", reset_after, "≥ 0 s"};
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
    energy -= Space::dot(state.held, state.displacement);
    if constexpr (Credit == damping_credit::counted) {
      energy += state.damping.dissipated(state.displacement, state.dt);
    }
    if (state.dt > state.longest_tick) energy = kernels::smaller(energy, written_off);
    idle = Space::dot(state.held, state.held) > scalar(0) ? scalar(0) : idle + state.dt;
    if (idle >= reset_after) energy = kernels::smaller(energy, scalar(0));
  }
};

/// A leak in the velocity that repays what the port has lost (parallel form, admittance causality):
/// for a device that is told a velocity and tells the force of the hand on it. Not a force bound and
/// no part of a local_model; call it once per tick, last thing before the velocity goes out.
///     E(n) = E(n−1) + dt v_held·f̄(n)
///     v = v* + β f̄,   β = (E_thr − E − dt v*·f̄) / (dt ‖f̄‖²)  in [0, max_mobility]
/// f̄(n) [N] is the MEAN force of the hand over the tick that has just ended, the one over which
/// v_held was held: with it E is the energy at the port exactly, whatever the force did in between.
/// A force sampled at the end of the tick understates it for a springy hand, k v²dt²/2 per tick; a
/// force sampled at its start, which is the published pairing, overstates it by as much and never
/// sees a sampled virtual mass go active (the dual of lemma L2). Source: Hannaford and Ryu 2002
/// (β); the pairing is derived here.
///
/// NOT passive. While β is not capped, ‖f̄‖ ≥ least_force and all ticks are as long,
///     E(n+1) ≥ E_thr + dt v·(f̄(n+1) − f̄(n))
/// so a force that stays cannot draw energy, and one that turns round within a tick can. Assumes
/// that the robot holds the velocity it was told, or that the one it held is given.
template <class Space>
struct parallel_passivity_controller {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr guarantee passivity = guarantee::none;

  scalar max_mobility{};  ///< largest β [m/(N·s)], > 0
  scalar threshold{};     ///< E_thr [J]; below zero it is a loan
  scalar least_force{};   ///< no action below this [N]: the noise of the sensor
  scalar energy{};        ///< E [J]; its first value is a loan
  typename Space::coordinates velocity_held{};  ///< [m/s]; begin with none

  /// The velocity to hold next [m/s], from the one that is desired, the mean force of the hand on
  /// the device over the last tick [N] and the length of that tick [s]. Takes the velocity it
  /// returned last to have been held.
  [[nodiscard]] constexpr vector velocity(const vector& desired, const vector& force,
                                          scalar dt) noexcept {
    return velocity(desired, force, dt, velocity_held);
  }
  /// The same for a robot that tells the velocity it really held [m/s]. A value that is not finite
  /// or a dt ≤ 0 gives velocity zero and writes off all credit.
  [[nodiscard]] constexpr vector velocity(const vector& desired, const vector& force, scalar dt,
                                          const vector& held) noexcept {
    const scalar gained = dt * Space::dot(held, force);
    const scalar square = Space::dot(force, force);
    const scalar predicted = energy + gained + dt * Space::dot(desired, force);
    if (!(dt > scalar(0)) || !kernels::is_finite(predicted) || !kernels::is_finite(square)) {
      energy = kernels::smaller(energy, scalar(0));
      velocity_held = Space::zero();
      return Space::zero();
    }
    energy += gained;
    vector next = desired;
    if (predicted < threshold && square > scalar(0) && square >= least_force * least_force) {
      next += force * kernels::smaller((threshold - predicted) / (dt * square), max_mobility);
    }
    velocity_held = next;
    return next;
  }

  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept {
    if (!(max_mobility > scalar(0)) || !kernels::is_finite(max_mobility)) {
      return {"max_mobility", max_mobility, "finite and > 0 m/(N·s)"};
    }
    if (!kernels::is_finite(threshold)) return {"threshold", threshold, "finite, in J"};
    if (!(least_force >= scalar(0)) || !kernels::is_finite(least_force)) {
      return {"least_force", least_force, "finite and ≥ 0 N"};
    }
    if (!(energy >= scalar(0)) || !kernels::is_finite(energy)) {
      return {"energy", energy, "finite and ≥ 0 J at the start"};
    }
    return {};
  }
};

static_assert(force_bound_for<series_passivity_controller<space<float, 1>>, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
