// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The ledger for encoders whose steps matter.
//
//   quantised_energy   the least E1 that positions known to a step of q allow

#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/no_unique_address.hpp>

namespace passive_haptics {
inline namespace v0 {

/// The least energy that has flowed in, whatever the true positions within the steps shown: a lower
/// bound of E1, so a bound that only spends it keeps its promise. With |x̂ − x| ≤ q/2 per axis (a
/// constant shift aside), summation by parts of Σ f·(e(k+1) − e(k)) gives
///     E1 ≥ Σ credit − Σ f_held·Δx̂ − q/2 (Σ ‖f(k) − f(k−1)‖₁ + ‖f_held‖₁)
/// and the credit is the larger of what the window's ticks and the window as a whole are sure of,
///     Σ Δᵀ(b/dt)Δ,  Δ = Δx̂ shortened by q on each axis;   the same with the travel and the time of
///     the whole window (lemma L1), which sees slow motions.
/// docs/design/mathematics.md § 3. Every change of the force costs q/2 of it: a force that hunts
/// empties this ledger, and a first touch finds it empty; a loan is for that (A8).
template <class Damping = isotropic_damping, ledger_sum Sum = ledger_sum::plain>
struct basic_quantised_energy {
  static constexpr guarantee passivity = guarantee::strict;
  static constexpr bool counts = true;
  static constexpr bool exact = false;

  Damping damping{};                                     ///< b [N·s/m], a lower bound
  double quantum{};                                      ///< q [m], an upper bound of one step
  double loan{};                                         ///< [J]
  double cap = std::numeric_limits<double>::infinity();  ///< most credit to keep [J] (A9, L7)
  double window = 0.032;                                 ///< length of a window [s]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (const auto fault = damping.check()) return fault;
    if (!detail::not_negative(quantum)) return {"quantum", quantum, "finite and ≥ 0 m"};
    if (!detail::not_negative(loan)) return {"loan", loan, "finite and ≥ 0 J"};
    if (!(cap >= 0.0)) return {"cap", cap, "≥ 0 J"};
    if (!detail::positive(window)) return {"window", window, "finite and > 0 s"};
    return {};
  }
  template <port P>
  class on;
};

using quantised_energy = basic_quantised_energy<>;

template <class Damping, ledger_sum Sum>
template <port P>
class basic_quantised_energy<Damping, Sum>::on {
 public:
  using scalar = typename P::scalar;
  using motion = typename P::motion;
  using effort = typename P::effort;
  using damping_type = part_at<Damping, P>;
  static_assert(damping_for<Damping, P>,
                "passive_haptics: the damping does not model damping_for: see concepts.hpp");

  constexpr explicit on(const basic_quantised_energy& p) noexcept : damping_(p.damping) {
    set(p);
    reset();
  }
  constexpr void set(const basic_quantised_energy& p) noexcept {
    damping_ = damping_type(p.damping);
    quantum_ = detail::number<scalar>(p.quantum);
    loan_ = detail::number<scalar>(p.loan);
    cap_ = detail::number<scalar>(p.cap);
    window_ = detail::number<scalar>(p.window);
  }
  [[nodiscard]] constexpr basic_quantised_energy parameters() const noexcept {
    return {.damping = damping_.parameters(),
            .quantum = static_cast<double>(quantum_),
            .loan = static_cast<double>(loan_),
            .cap = static_cast<double>(cap_),
            .window = static_cast<double>(window_)};
  }

  constexpr bool update(const motion& shown, const effort& held, scalar dt) noexcept {
    auto energy = now_.energy;
    const effort change = held - effort(now_.last_held);
    detail::book(energy, detail::sure_gain<P>(scalar(0), held, shown));
    detail::book(energy, -quantum_ / scalar(2) * sum_of_magnitudes(change) *
                             (scalar(1) + kernels::rounding<scalar>()));

    const motion travel = motion(now_.travel) + shown;
    const scalar elapsed = now_.elapsed + dt;
    const scalar summed = now_.summed + damping_.dissipated(surely_moved(shown), dt);
    const scalar as_a_whole = damping_.dissipated(surely_moved(travel), elapsed);
    const scalar most =
        kernels::larger(summed, as_a_whole) * (scalar(1) - scalar(8) * kernels::rounding<scalar>());
    const scalar sure = kernels::larger(now_.booked, most);
    detail::book(energy, sure - now_.booked);
    const scalar left = value_of(energy, held);
    if (!kernels::is_finite(left)) return false;
    if (left > cap_) energy += cap_ - left;

    now_.energy = energy;
    now_.last_held = held;
    now_.travel = travel;
    now_.elapsed = elapsed;
    now_.summed = summed;
    now_.booked = sure;
    if (elapsed >= window_) begin_window();
    return true;
  }

  constexpr void forfeit(const effort& held, scalar T) noexcept {
    now_.energy = detail::written_off(value(), damping_.worst_outflow(held, T));
    now_.last_held = P::zero();
    begin_window();
  }
  constexpr void reset() noexcept {
    now_ = {};
    now_.last_held = now_.travel = P::zero();
    now_.energy = loan_;
  }

  [[nodiscard]] constexpr scalar value() const noexcept {
    return value_of(now_.energy, now_.last_held);
  }
  /// How far the true Δx may be from the one shown [m].
  [[nodiscard]] constexpr scalar travel_error() const noexcept {
    return quantum_ * kernels::square_root(scalar(P::dof));
  }
  [[nodiscard]] constexpr const damping_type& damping() const noexcept { return damping_; }

 private:
  struct state {
    detail::ledger_number<scalar, Sum> energy{};  ///< [J]
    typename P::stored_effort last_held{};        ///< [N]
    typename P::stored_pose travel{};             ///< Δx̂ since the window began [m]
    scalar elapsed{};                             ///< since the window began [s]
    scalar summed{};                              ///< credit of its ticks, one by one [J]
    scalar booked{};                              ///< credit of it that is in `energy` [J]
  };

  [[nodiscard]] static constexpr scalar sum_of_magnitudes(const effort& v) noexcept {
    scalar sum(0);
    for (int i = 0; i < P::dof; ++i) sum += kernels::magnitude(P::component(v, i));
    return sum;
  }
  [[nodiscard]] constexpr scalar value_of(const auto& energy, const effort& held) const noexcept {
    return static_cast<scalar>(energy) - quantum_ / scalar(2) * sum_of_magnitudes(held);
  }
  [[nodiscard]] constexpr motion surely_moved(const motion& shown) const noexcept {
    motion least = shown;
    for (int i = 0; i < P::dof; ++i) {
      const scalar way = P::component(shown, i);
      const scalar length = kernels::larger(kernels::magnitude(way) - quantum_, scalar(0));
      P::component(least, i) = way < scalar(0) ? -length : length;
    }
    return least;
  }
  constexpr void begin_window() noexcept {
    now_.travel = P::zero();
    now_.elapsed = now_.summed = now_.booked = scalar(0);
  }

  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS damping_type damping_;
  scalar quantum_{}, loan_{}, cap_{}, window_{};
  state now_{};
};

static_assert(energy_observer_for<quantised_energy, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
