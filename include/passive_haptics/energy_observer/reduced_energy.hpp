// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The ledger of the thesis, for positions that are exact.
//
//   reduced_energy   E1 += Δxᵀ(b/dt)Δx − f_held·Δx     (2.9, 2.16)
//   capped_energy    the same, with E1 ≤ `cap`
//
// Pairing the NEW force with the last displacement is not offered: it flips the sign of the energy that the
// zero-order hold leaks, so the observer does not see that energy (lemma L2).

#include <passive_haptics/base/no_unique_address.hpp>
#include <passive_haptics/port/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

/// The reduced energy E1 [J] that has flowed from the hand into the device and is not yet spent:
///     E1(n) = E1(n−1) + Δxᵀ(b/dt)Δx − f_held·Δx                                    (2.9, 2.16)
/// with dt [s] the measured length of the tick. For a zero-order hold −f_held·Δx is exact. The damping's part is a
/// lower bound (L1), rounding only lowers E1 (docs/design/stability.md), and of a turn it books the least gain
/// (rigid_damping). A negative E1 is a debt, which is kept and shown until it is repaid. With a loan the guarantee
/// becomes E ≥ −loan (A8).
template <class Damping = isotropic_damping, ledger_sum Sum = ledger_sum::plain>
struct basic_reduced_energy {
  static constexpr guarantee passivity = guarantee::strict;
  static constexpr bool counts = true;
  static constexpr bool exact = true;
  static constexpr bool turns = true;

  Damping damping{};  ///< b [N·s/m], a lower bound
  double loan{};      ///< E1 at the start [J]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (const auto fault = damping.check()) return fault;
    if (!detail::not_negative(loan)) return {"loan", loan, "finite and ≥ 0 J"};
    return {};
  }
  template <port P>
  class on;
};

using reduced_energy = basic_reduced_energy<>;

template <class Damping, ledger_sum Sum>
template <port P>
class basic_reduced_energy<Damping, Sum>::on {
 public:
  using scalar = typename P::scalar;
  using motion = typename P::motion;
  using effort = typename P::effort;
  using damping_type = part_at<Damping, P>;
  static_assert(damping_for<Damping, P>,
                "passive_haptics: the damping does not model damping_for: see port/concepts.hpp");
  static_assert(!damping_type::rubs,
                "passive_haptics: reduced_energy takes what friction holds back elastically for "
                "spent: dry friction is credited by dual_ledger");
  static_assert(
      !detail::turns<P>() || detail::knows_turns<damping_type, P>,
      "passive_haptics: this port turns, and a turn may do other work than its ends show: "
      "reduced_energy needs rigid_damping there, which knows by how much");

  constexpr explicit on(const basic_reduced_energy& p) noexcept
      : damping_(p.damping), loan_(detail::number<scalar>(p.loan)), energy_(loan_) {}
  constexpr void set(const basic_reduced_energy& p) noexcept {
    damping_ = damping_type(p.damping);
    loan_ = detail::number<scalar>(p.loan);
  }
  [[nodiscard]] constexpr basic_reduced_energy parameters() const noexcept {
    return {.damping = damping_.parameters(), .loan = static_cast<double>(loan_)};
  }

  [[gnu::always_inline]] constexpr bool update(const motion& dx, const effort& held,
                                               scalar dt) noexcept {
    scalar gain = detail::sure_gain<P>(damping_.dissipated(dx, dt), held, dx);
    if constexpr (detail::turns<P>()) gain -= damping_.unsure(dx, held, dt);
    return add(gain);
  }
  /// The same for a turn whose end poses hide at most `hidden` [J] of work.
  constexpr bool update(const motion& dx, const effort& held, scalar dt, scalar hidden) noexcept
      requires(detail::turns<P>()) {
    return add(detail::sure_gain<P>(damping_.dissipated(dx, dt), held, dx) -
               kernels::smaller(damping_.unsure(dx, held, dt), hidden));
  }
  /// The same with the work [J] that the device reports of its motors: E1 += Δxᵀ(b/dt)Δx − work (lemma J).
  [[gnu::always_inline]] constexpr bool update(const motion& dx,
                                               const detail::reported_effort<P>& held,
                                               scalar dt) noexcept {
    const scalar spent = kernels::sure_gain(scalar(0), held.work, kernels::magnitude(held.work));
    if (!kernels::is_finite(value() + damping_.dissipated(dx, dt) + spent)) return false;
    static_cast<void>(update(dx, P::zero(), dt));
    detail::book(energy_, spent);
    return true;
  }

  /// Books a tick of length ≤ T whose motion is unknown: subtracts the worst outflow of `held`, or `most` [J] if that
  /// is less, but leaves no new debt, because the bound has covered that outflow before.
  constexpr void forfeit(const effort& held, scalar T) noexcept {
    energy_ = detail::written_off(value(), damping_.worst_outflow(held, T));
  }
  constexpr void forfeit(const effort& held, scalar T, scalar most) noexcept {
    energy_ = detail::written_off(value(), kernels::smaller(damping_.worst_outflow(held, T), most));
  }

  /// Adds `joules` ≥ 0 [J] of credit that the hand has not paid in.
  constexpr void lend(scalar joules) noexcept { detail::book(energy_, joules); }
  /// Sets E1 to the loan, as at the start.
  constexpr void reset() noexcept { energy_ = loan_; }

  [[nodiscard]] constexpr scalar value() const noexcept { return static_cast<scalar>(energy_); }
  [[nodiscard]] constexpr const damping_type& damping() const noexcept { return damping_; }

 protected:
  constexpr void keep_at_most(scalar most) noexcept {
    if (value() > most) energy_ = most;  // this only lowers E1, and a debt stays (L7)
  }

 private:
  /// Books `gain` [J]. If E1 would not be finite, it books nothing and returns false.
  [[gnu::always_inline]] constexpr bool add(scalar gain) noexcept {
    if (!kernels::is_finite(value() + gain)) [[unlikely]] {
      return false;
    }
    detail::book(energy_, gain);
    return true;
  }

  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS damping_type damping_;
  scalar loan_;
  detail::ledger_number<scalar, Sum> energy_;  ///< E1 [J]
};

/// reduced_energy with E1 ≤ `cap` [J], and E1 ≤ 0 once no force has been held for `reset_after` [s]. Discarding
/// credit leaves every proof valid (L7).
template <class Damping = isotropic_damping, ledger_sum Sum = ledger_sum::plain>
struct basic_capped_energy {
  static constexpr guarantee passivity = guarantee::strict;
  static constexpr bool counts = true;
  static constexpr bool exact = true;
  static constexpr bool turns = true;

  Damping damping{};                      ///< b [N·s/m], a lower bound
  double loan{};                          ///< E1 at the start [J]
  double cap = detail::no_limit;          ///< most credit to keep [J] (A9)
  double reset_after = detail::no_limit;  ///< force-free time after which E1 is set to 0 [s]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!(cap >= 0.0)) return {"cap", cap, "≥ 0 J"};
    if (!(reset_after >= 0.0)) return {"reset_after", reset_after, "≥ 0 s"};
    return basic_reduced_energy<Damping, Sum>{damping, loan}.check();
  }
  template <port P>
  class on;
};

using capped_energy = basic_capped_energy<>;

template <class Damping, ledger_sum Sum>
template <port P>
class basic_capped_energy<Damping, Sum>::on
    : public basic_reduced_energy<Damping, Sum>::template on<P> {
  using plain = basic_reduced_energy<Damping, Sum>;
  using ledger = typename plain::template on<P>;

 public:
  using typename ledger::effort, typename ledger::motion, typename ledger::scalar;

  constexpr explicit on(const basic_capped_energy& p) noexcept
      : ledger(plain{p.damping, p.loan}),
        cap_(detail::number<scalar>(p.cap)),
        reset_after_(detail::number<scalar>(p.reset_after)) {}
  constexpr void set(const basic_capped_energy& p) noexcept {
    ledger::set(plain{p.damping, p.loan});
    cap_ = detail::number<scalar>(p.cap);
    reset_after_ = detail::number<scalar>(p.reset_after);
  }
  [[nodiscard]] constexpr basic_capped_energy parameters() const noexcept {
    const plain p = ledger::parameters();
    return {.damping = p.damping,
            .loan = p.loan,
            .cap = static_cast<double>(cap_),
            .reset_after = static_cast<double>(reset_after_)};
  }

  [[gnu::always_inline]] constexpr bool update(const motion& dx, const effort& held,
                                               scalar dt) noexcept {
    if (!ledger::update(dx, held, dt)) return false;
    idle_ = held == P::zero() ? idle_ + dt : scalar(0);
    this->keep_at_most(idle_ >= reset_after_ ? scalar(0) : cap_);
    return true;
  }
  /// The same with reported work. The second update books no motion and only applies cap and reset.
  [[gnu::always_inline]] constexpr bool update(const motion& dx,
                                               const detail::reported_effort<P>& held,
                                               scalar dt) noexcept {
    return ledger::update(dx, held, dt) && update(P::zero(), held.force, dt);
  }
  constexpr void reset() noexcept {
    ledger::reset();
    idle_ = scalar(0);
  }

 private:
  scalar cap_, reset_after_;
  scalar idle_{};  ///< force-free time so far [s]
};

static_assert(energy_observer_for<reduced_energy, space<float, 1>>);
static_assert(energy_observer_for<capped_energy, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
