// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Energy observers: how the energy at the device port is counted.
//
//   reduced_energy   E1 += Δxᵀ(b/dt)Δx − f_held·Δx     the ledger of the thesis (2.9, 2.16)
//   quantised_energy the least E1 that positions known  encoders whose steps matter
//                    to a step of q allow
//   no_observer      nothing                           with no_bound only
//
// Not offered: pairing the NEW force with the last displacement. It flips the sign of the energy
// that the zero-order hold leaks and makes the observer blind (lemma L2).

#include <passive_haptics/concepts.hpp>

#include <limits>

namespace passive_haptics {
inline namespace v0 {

/// The reduced energy E1 [J] that has flowed from the hand into the device and is not yet spent:
///     E1(n) = E1(n−1) + Δxᵀ(b/dt)Δx − f_held·Δx                                    (2.9, 2.16)
/// exact for a zero-order hold but for the damping, which it never overstates (lemma L1), and for
/// rounding, which only lowers it (docs/design/stability.md). `dt` is the measured length of the
/// tick. A negative E1 is a debt: it is kept, it is visible, it is repaid. Start with `.energy > 0`
/// and the guarantee becomes E ≥ −that much (A8).
template <class Space, class Damping = isotropic_damping<Space>,
          class Ledger = typename Space::scalar>
struct reduced_energy {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr guarantee passivity = guarantee::strict;
  static constexpr bool counts = true;

  Damping damping{};                                ///< b [N·s/m], a lower bound
  scalar cap = std::numeric_limits<scalar>::max();  ///< most credit to keep [J] (A9, L7)
  scalar reset_after =
      std::numeric_limits<scalar>::max();  ///< force-free time that voids credit [s]
  Ledger energy{};                         ///< E1 [J]; its first value is the loan
  scalar idle{};                           ///< force-free time so far [s]

  [[gnu::always_inline]] constexpr bool update(const vector& displacement, const vector& held,
                                               scalar dt) noexcept {
    const scalar gain =
        detail::sure_gain<Space>(damping.dissipated(displacement, dt), held, displacement);
    if (!kernels::is_finite(value() + gain)) [[unlikely]] {
      return false;
    }
    detail::book(energy, gain);
    idle = Space::dot(held, held) > scalar(0) ? scalar(0) : idle + dt;
    const scalar most = idle >= reset_after ? scalar(0) : cap;
    if (value() > most) energy = most;  // only ever lowers: a debt stays (L7)
    return true;
  }

  /// A tick passed and nobody saw the motion: write off the worst that `held` can have done, down
  /// to an empty ledger. Any bound that kept its promise has covered exactly that.
  constexpr void forfeit(const vector& held, scalar T) noexcept {
    energy = detail::written_off(value(), damping.worst_outflow(held, T));
  }

  [[nodiscard]] constexpr scalar value() const noexcept { return static_cast<scalar>(energy); }

  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept {
    if (const auto fault = damping.check()) return fault;
    if (!(cap >= scalar(0))) return {"cap", cap, "≥ 0 J"};
    if (!(reset_after >= scalar(0))) return {"reset_after", reset_after, "≥ 0 s"};
    if (!(value() >= scalar(0)) || !kernels::is_finite(value())) {
      return {"energy", value(), "finite and ≥ 0 J at the start"};
    }
    return {};
  }
};

/// The least energy that has flowed in, whatever the true positions within the steps shown: a lower
/// bound of E1, so every bound keeps its promise. With |x̂ − x| ≤ q/2 per axis (a constant shift
/// aside), summation by parts of Σ f·(e(k+1) − e(k)) gives
///     E1 ≥ Σ credit − Σ f_held·Δx̂ − q/2 (Σ ‖f(k) − f(k−1)‖₁ + ‖f_held‖₁)
/// and the credit is the larger of what the window's ticks and the window as a whole are sure of,
///     Σ Δᵀ(b/dt)Δ,  Δ = Δx̂ shortened by q on each axis;   the same with the travel and the time of
///     the whole window (lemma L1), which sees slow motions.
/// docs/design/mathematics.md § 3. Every change of the force costs q/2 of it: a force that hunts
/// empties this ledger, and a first touch finds it empty; `.energy` > 0 is the loan for it (A8).
template <class Space, class Damping = isotropic_damping<Space>,
          class Ledger = typename Space::scalar>
struct quantised_energy {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  using coordinates = typename Space::coordinates;
  static constexpr guarantee passivity = guarantee::strict;
  static constexpr bool counts = true;

  Damping damping{};                                ///< b [N·s/m], a lower bound
  scalar quantum{};                                 ///< q [m], an upper bound of one step
  scalar cap = std::numeric_limits<scalar>::max();  ///< most credit to keep [J] (A9, L7)
  scalar window = scalar(0.032);                    ///< length of a window [s]
  Ledger energy{};                                  ///< [J]; its first value is the loan
  coordinates last_held{};                          ///< [N]
  coordinates travel{};                             ///< Δx̂ since the window began [m]
  scalar elapsed{};                                 ///< since the window began [s]
  scalar summed{};                                  ///< credit of its ticks, one by one [J]
  scalar booked{};                                  ///< credit of it that is in `energy` [J]

  constexpr bool update(const vector& displacement, const vector& held, scalar dt) noexcept {
    const quantised_energy before = *this;
    const vector change = held - vector(last_held);
    detail::book(energy, detail::sure_gain<Space>(scalar(0), held, displacement));
    detail::book(energy, -quantum / scalar(2) * sum_of_magnitudes(change) *
                             (scalar(1) + kernels::rounding<scalar>()));
    last_held = held;

    elapsed += dt;
    travel = vector(vector(travel) + displacement);
    summed += damping.dissipated(surely_moved(displacement), dt);
    const scalar as_a_whole = damping.dissipated(surely_moved(travel), elapsed);
    const scalar most =
        kernels::larger(summed, as_a_whole) * (scalar(1) - scalar(8) * kernels::rounding<scalar>());
    const scalar sure = kernels::larger(booked, most);
    detail::book(energy, sure - booked);
    booked = sure;
    if (elapsed >= window) begin_window();
    if (value() > cap) energy += cap - value();
    if (kernels::is_finite(value())) return true;
    *this = before;
    return false;
  }

  constexpr void forfeit(const vector& held, scalar T) noexcept {
    energy = detail::written_off(value(), damping.worst_outflow(held, T));
    last_held = Space::zero();
    begin_window();
  }

  [[nodiscard]] constexpr scalar value() const noexcept {
    return static_cast<scalar>(energy) - quantum / scalar(2) * sum_of_magnitudes(last_held);
  }
  /// How far the true Δx may be from the one shown [m].
  [[nodiscard]] constexpr scalar displacement_error() const noexcept {
    return quantum * kernels::square_root(scalar(Space::dof));
  }

  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept {
    if (const auto fault = damping.check()) return fault;
    if (!(quantum >= scalar(0)) || !kernels::is_finite(quantum)) {
      return {"quantum", quantum, "finite and ≥ 0 m"};
    }
    if (!(cap >= scalar(0))) return {"cap", cap, "≥ 0 J"};
    if (!(window > scalar(0)) || !kernels::is_finite(window)) {
      return {"window", window, "finite and > 0 s"};
    }
    if (!(value() >= scalar(0)) || !kernels::is_finite(value())) {
      return {"energy", value(), "finite and ≥ 0 J at the start"};
    }
    return {};
  }

 private:
  [[nodiscard]] static constexpr scalar sum_of_magnitudes(const vector& v) noexcept {
    scalar sum(0);
    for (int i = 0; i < Space::dof; ++i) sum += kernels::magnitude(Space::component(v, i));
    return sum;
  }
  [[nodiscard]] constexpr vector surely_moved(const vector& shown) const noexcept {
    vector least = shown;
    for (int i = 0; i < Space::dof; ++i) {
      const scalar way = Space::component(shown, i);
      const scalar length = kernels::larger(kernels::magnitude(way) - quantum, scalar(0));
      Space::component(least, i) = way < scalar(0) ? -length : length;
    }
    return least;
  }
  constexpr void begin_window() noexcept {
    travel = Space::zero();
    elapsed = summed = booked = scalar(0);
  }
};

/// Counts nothing, promises nothing. For comparison, and for worlds proved passive otherwise.
template <class Space>
struct no_observer {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr guarantee passivity = guarantee::none;
  static constexpr bool counts = false;

  /// Answers for the damping that nobody has stated.
  struct unknown_damping {
    [[nodiscard]] constexpr scalar worst_outflow(const vector& /*force*/,
                                                 scalar /*T*/) const noexcept {
      return scalar(0);
    }
  };
  [[no_unique_address]] unknown_damping damping{};

  constexpr bool update(const vector& /*dx*/, const vector& /*held*/, scalar /*dt*/) noexcept {
    return true;
  }
  constexpr void forfeit(const vector& /*held*/, scalar /*T*/) noexcept {}
  [[nodiscard]] constexpr scalar value() const noexcept { return scalar(0); }
  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept { return {}; }
};

static_assert(energy_observer_for<reduced_energy<space<float, 1>>, space<float, 1>>);
static_assert(energy_observer_for<quantised_energy<space<float, 1>>, space<float, 1>>);
static_assert(energy_observer_for<no_observer<space<float, 1>>, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
