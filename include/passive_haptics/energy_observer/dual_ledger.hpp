// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The ledger for positions that are known to an encoder step only, with or without dry friction.
//
//   dual_ledger         credits dry friction: stiff on real encoders     b, c, p and q are stated
//   basic_dual_ledger   any damping, several sliders (identification/sliders.hpp), a step for each axis or one that is
//                       known better where it is crossed (identification/crossed_step.hpp), a compensated sum
//   quantised_energy    no friction credited                             quantised_energy.hpp
//
//     ph::dual_ledger{.damping = {.coefficient = 0.05, .coulomb = 0.13, .presliding = 15e-6},
//                     .quantum = 55e-6}
//
// On encoders dry friction pays for the steps, without end up to the stiffness of design/stiffness_budget.hpp.

#include <passive_haptics/base/no_unique_address.hpp>
#include <passive_haptics/device/dry_friction.hpp>
#include <passive_haptics/device/encoder_steps.hpp>
#include <passive_haptics/energy_observer/friction_certificates.hpp>
#include <passive_haptics/port/concepts.hpp>

#include <limits>

namespace passive_haptics {
inline namespace v0 {

/// A lower bound of the energy E [J] that has flowed in, over all true positions x = x̂ + e with |eᵢ| ≤ qᵢ/2 (encoder
/// steps, apart from a constant shift, or noise) and over all energy that elastic friction can store. With any
/// friction force u, |u| ≤ c, chosen in each tick, and f the force held during the tick,
///     A ← A + (u − f)·Δx̂ − ½ Σ qᵢ|σᵢ + fᵢ − uᵢ| − p|u − u_last|,     σ ← u − f
/// Then E ≥ A − ½ Σ qᵢ|σᵢ| − |u|²p/(2c) − loan, and value() is the best of several such bounds that are kept at once
/// (friction_certificates.hpp). Without friction u = 0: summation by parts. Ours: docs/design/mathematics.md § 6.
///
/// The damper is credited in windows: Δᵀ(b/dt)Δ, with Δ the measured motion less qᵢ on each axis, summed over its
/// ticks or taken over the whole window (L1), whichever is larger. Only the latter credits slow motions.
///
/// If friction is elastic, the ledger begins 5/2 c p below its loan and regains that as the device slips. Then
/// E ≥ −½ c p − loan for ever; ½ c p is the most that the friction's springs can store at the start.
template <class Damping = isotropic_damping, class Steps = encoder_step,
          ledger_sum Sum = ledger_sum::plain>
struct basic_dual_ledger {
  static constexpr guarantee passivity = requires { Steps::mass; }
  ? guarantee::conditional : guarantee::strict;  // steps that count on a mass: crossed_step.hpp
  static constexpr bool counts = true;
  static constexpr bool exact = false;

  Damping damping{};  ///< b and c are lower bounds, p is an upper bound
  Steps quantum{};    ///< q [m], an upper bound of one step
  double loan{};      ///< credit at the start [J]
  double cap = std::numeric_limits<double>::infinity();  ///< most credit to keep [J] (A9, L7)
  double window = 0.032;  ///< length of a window of the damper's credit [s]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (const auto fault = damping.check()) return fault;
    if (const auto fault = quantum.check()) return fault;
    if (!detail::not_negative(loan)) return {"loan", loan, "finite and ≥ 0 J"};
    if (!(cap >= 0.0)) return {"cap", cap, "≥ 0 J"};
    if (!detail::positive(window)) return {"window", window, "finite and > 0 s"};
    return {};
  }
  template <port P>
  class on;
};

using dual_ledger = basic_dual_ledger<damping_and_friction>;

template <class Damping, class Steps, ledger_sum Sum>
template <port P>
class basic_dual_ledger<Damping, Steps, Sum>::on {
 public:
  using scalar = typename P::scalar;
  using motion = typename P::motion;
  using effort = typename P::effort;
  using damping_type = part_at<Damping, P>;
  static_assert(damping_for<Damping, P>,
                "passive_haptics: the damping does not model damping_for: see port/concepts.hpp");
  static_assert(
      !damping_type::rubs || detail::friction_for<damping_type, P>,
      "passive_haptics: this damping credits dry friction, but does not say what of it is "
      "elastic: see damping_and_friction");

  constexpr explicit on(const basic_dual_ledger& p) noexcept
      : damping_(p.damping), steps_(p.quantum) {
    set(p);
    reset();
  }
  constexpr void set(const basic_dual_ledger& p) noexcept {
    const scalar reserved = reserve();
    damping_ = damping_type(p.damping);
    steps_ = steps_type(p.quantum);
    loan_ = detail::number<scalar>(p.loan);
    cap_ = detail::number<scalar>(p.cap);
    window_ = detail::number<scalar>(p.window);
    if constexpr (rubs) {
      certificates_.set(damping_, steps_);
      if constexpr (slides) sliders_ = {};
      detail::book(energy_, -kernels::larger(reserve() - reserved, scalar(0)));
    }
    take_stock();
  }
  [[nodiscard]] constexpr basic_dual_ledger parameters() const noexcept {
    return {.damping = damping_.parameters(),
            .quantum = steps_.parameters(),
            .loan = static_cast<double>(loan_),
            .cap = static_cast<double>(cap_),
            .window = static_cast<double>(window_)};
  }

  constexpr bool update(const motion& shown, const effort& held, scalar dt) noexcept {
    const effort change = held - effort(last_held_);
    const scalar doubt = steps_.doubt(change), owed = steps_.doubt(held);
    const bool moved = !(P::squared(shown) == scalar(0));
    credit_window now = window_now_;
    now.elapsed += dt;
    scalar gain = -doubt;
    if (moved) gain += detail::sure_gain<P>(damped(now, shown, dt), held, shown);
    auto energy = energy_;
    detail::book(energy, gain);
    if (!kernels::is_finite(static_cast<scalar>(energy) - owed)) return false;

    energy_ = energy;
    last_held_ = held;
    window_now_ = now;
    if (now.elapsed >= window_) begin_window();
    if constexpr (rubs) {
      if constexpr (crosses) steps_.see(shown, held, dt, damping_);
      certificates_.follow(change, doubt, damping_, steps_);
      if (moved) {
        const scalar slipped = certificates_.slip(shown, damping_, steps_);
        detail::book(energy_, slipped);
        if constexpr (slides) {
          const scalar wound = sliders_.slip(slipped, shown, damping_, steps_);
          certificates_.fall_behind(wound);
          detail::book(energy_, wound);
        }
        if (!(static_cast<scalar>(energy_) <= most_kept())) energy_ = most_kept();  // L7
      }
      if constexpr (crosses) detail::book(energy_, certificates_.give_back(steps_));
    }
    take_stock(owed);
    if (value_ > cap_) {
      detail::book(energy_, cap_ - value_);
      take_stock(owed);
    }
    if (value_ < scalar(0)) [[unlikely]] {
      doubted_ += doubt;
    } else {
      doubted_ = scalar(0);
    }
    return true;
  }

  /// Books a tick of length ≤ T whose motion is unknown: subtracts the worst outflow of `held`, or `most` [J] if that
  /// is less, and the energy that friction may store, but only down to the start value of a ledger without a
  /// loan. forfeit(0, T) subtracts the friction's part only.
  constexpr void forfeit(const effort& held, scalar T) noexcept {
    lose(held, damping_.worst_outflow(held, T));
  }
  constexpr void forfeit(const effort& held, scalar T, scalar most) noexcept {
    lose(held, kernels::smaller(damping_.worst_outflow(held, T), most));
  }
  /// Adds `joules` ≥ 0 [J] of credit that the hand has not paid in.
  constexpr void lend(scalar joules) noexcept {
    detail::book(energy_, joules);
    take_stock();
  }
  constexpr void reset() noexcept {
    energy_ = loan_;
    doubted_ = scalar(0);
    last_held_ = P::zero();
    begin_window();
    if constexpr (crosses) steps_ = steps_type(steps_.parameters());
    if constexpr (rubs) certificates_.reset();
    if constexpr (slides) sliders_ = {};
    detail::book(energy_, -reserve());
    take_stock();
  }

  [[nodiscard]] constexpr scalar value() const noexcept { return value_; }
  /// True if more energy was given out than came in: the value is below its start value without a loan, and by more than
  /// the steps have put in doubt since it was last ≥ 0, which it charges as if all of it were lost, and c q, which the
  /// certificate that was the best then may lose at a turn (§ 11).
  [[nodiscard, gnu::cold, gnu::noinline]] constexpr bool overdrawn() const noexcept {
    scalar in_doubt = scalar(2) * (doubted_ + steps_.doubt(effort(last_held_)));
    if constexpr (rubs) in_doubt += damping_.most_friction() * steps_.travel_error();
    return value_ <
           -(reserve() + in_doubt) * (scalar(1) + scalar(16) * kernels::rounding<scalar>());
  }
  /// The largest distance between the true Δx and the measured one [m].
  [[nodiscard]] constexpr scalar travel_error() const noexcept { return steps_.travel_error(); }
  [[nodiscard]] constexpr const damping_type& damping() const noexcept { return damping_; }
  [[nodiscard]] constexpr const auto& steps() const noexcept { return steps_; }

 private:
  using steps_type = part_at<Steps, P>;
  static constexpr bool rubs = damping_type::rubs;
  constexpr void lose(const effort& held, scalar lost) noexcept {
    if constexpr (rubs) {
      lost += certificates_.given_up(held, effort(last_held_), damping_, steps_);
      certificates_.reset();
      if constexpr (crosses) steps_.forget();
      if constexpr (slides) sliders_ = {};
    }
    energy_ = detail::written_off(value_, lost, -reserve());
    last_held_ = P::zero();
    begin_window();
    take_stock();
  }
  /// The most that the ledger keeps [J], so that sums of it stay finite.
  [[nodiscard]] static constexpr scalar most_kept() noexcept {
    return kernels::largest<scalar>() / scalar(8);
  }
  struct no_friction {
    using credits = no_friction;
  };
  static constexpr bool crosses = rubs && !std::is_empty_v<typename steps_type::owed>;
  using certificates_type =
      std::conditional_t<rubs, detail::friction_certificates<P, typename steps_type::owed>,
                         no_friction>;
  static constexpr bool slides = requires { typename damping_type::credits; };
  using sliders_type = typename std::conditional_t<slides, damping_type, no_friction>::credits;

  struct credit_window {
    typename P::stored_effort travel{};  ///< Δx̂ since the window began [m]
    scalar elapsed{};                    ///< time since it began [s]
    scalar summed{};                     ///< credit of its ticks, one by one [J]
    scalar booked{};                     ///< credit of the window that is booked already [J]
  };

  /// 5/2 c p [J], reserved because elastic friction may return energy (§ 6).
  [[nodiscard]] constexpr scalar reserve() const noexcept {
    if constexpr (rubs) return kernels::smaller(scalar(5) * damping_.most_stored(), most_kept());
    return scalar(0);
  }
  /// Adds a tick to the window; returns the least energy that the damper took and that is not yet booked [J].
  [[nodiscard]] constexpr scalar damped(credit_window& now, const motion& shown,
                                        scalar dt) const noexcept {
    const motion travel = motion(now.travel) + shown;
    now.travel = travel;
    now.summed += viscous(steps_.surely(shown), dt);
    const scalar as_a_whole = viscous(steps_.surely(travel), now.elapsed);
    const scalar most = kernels::larger(now.summed, as_a_whole) *
                        (scalar(1) - scalar(8) * kernels::rounding<scalar>());
    const scalar sure = kernels::larger(now.booked, most);
    const scalar gained = sure - now.booked;
    now.booked = sure;
    return gained;
  }
  [[nodiscard]] constexpr scalar viscous(const motion& dx, scalar dt) const noexcept {
    if constexpr (rubs) return damping_.viscous(dx, dt);
    return damping_.dissipated(dx, dt);
  }
  constexpr void begin_window() noexcept {
    window_now_ = {};
    window_now_.travel = P::zero();
  }
  constexpr void take_stock() noexcept { take_stock(steps_.doubt(effort(last_held_))); }
  constexpr void take_stock(scalar owed) noexcept {  // the doubt of the last held force [J]
    if constexpr (rubs) {
      const scalar lead = certificates_.lead(effort(last_held_), owed, steps_);
      value_ = kernels::smaller(static_cast<scalar>(energy_) + lead, most_kept());
    } else {
      value_ = static_cast<scalar>(energy_) - owed;
    }
  }

  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS damping_type damping_;
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS steps_type steps_;
  scalar loan_{}, cap_{}, window_{};
  detail::ledger_number<scalar, Sum> energy_{};  ///< A of the choice u = 0 [J]
  scalar value_{};                               ///< the best lower bound of the energy [J]
  scalar doubted_{};  ///< ½ Σ qᵢ|Δfᵢ| of the ticks since the value was last ≥ 0 [J]
  typename P::stored_effort last_held_ = P::zero();  ///< the last, −σ of the choice u = 0 [N]
  credit_window window_now_{};
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS certificates_type certificates_{};  ///< the other choices
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS sliders_type sliders_{};            ///< the single sliders' own
};

static_assert(energy_observer_for<dual_ledger, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
