// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A ledger that recovers from faults (an outlier, a late tick), at the cost of a bounded amount of energy.
//
//   forgiving{ledger, amends}   within 0.6 s of a fault E1 is raised to A = `amends` [J] again

#include <passive_haptics/base/event.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/port/composing.hpp>

#include <algorithm>

namespace passive_haptics {
inline namespace v0 {

/// One false sample can put a ledger into a debt that it never repays. After a time θ without a fault, this one sets
/// a debt to zero, once, and then adds credit for τ = ½ s (ours, docs/design/mathematics.md § 11):
///     E1 += min(A dt/τ, A − E1)  where E1 < A
/// If the first fault in 10 s is a rejected sample or a late tick, E1 = max(E1, A) at once instead. A fault is a
/// rejected sample, a late tick, or a debt, on encoders of A/64 and more than their steps put in doubt, because the bounds
/// cause no debt unless a stated parameter is wrong; samples rejected in a row are one fault while E1 ≥ A/2. θ is
/// 0.1 s, doubles with each fault after amends have begun, and is 0.1 s again after 10 s without a fault. With D [J]
/// the debts that are set to zero, after t seconds of any faults
///     E ≥ −D − A (8 + t/2.5 s)
/// and without a fault the ledger's own guarantee holds.
template <class Ledger = reduced_energy>
struct forgiving {
  static constexpr guarantee passivity = (std::min)(Ledger::passivity, guarantee::conditional);
  static constexpr bool counts = Ledger::counts;
  static constexpr bool exact = Ledger::exact;
  static constexpr bool turns = detail::books_turns<Ledger>();

  Ledger ledger{};
  double amends{};  ///< A [J], of the order of ½F²/K of a contact; 0: no amends

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!detail::not_negative(amends)) return {"amends", amends, "finite and ≥ 0 J"};
    return ledger.check();
  }
  template <port P>
  class on;
};
template <class Ledger>
forgiving(Ledger, double) -> forgiving<Ledger>;

/// A = ½F · 5 mm [J], the energy ½F²/K of a contact that motors of limit F = `force_limit` [N] press 5 mm deep;
/// 0 if F is not finite and > 0.
[[nodiscard]] constexpr double amends_for(double force_limit) noexcept {
  return detail::positive(force_limit) ? 2.5e-3 * force_limit : 0.0;
}

template <class Ledger>
template <port P>
class forgiving<Ledger>::on : public part_at<Ledger, P> {
  using kept = part_at<Ledger, P>;

 public:
  using typename kept::effort, typename kept::motion, typename kept::scalar;
  template <class Parameters>
  static constexpr int takers = detail::takers<Parameters, Ledger, P>;

  constexpr explicit on(const forgiving& p) noexcept
      : kept(p.ledger), amends_(detail::number<scalar>(p.amends)) {}
  constexpr void set(const forgiving& p) noexcept {
    kept::set(p.ledger);
    amends_ = detail::number<scalar>(p.amends);
  }
  template <class Parameters>
  constexpr void take(const Parameters& p) noexcept {
    detail::take<Ledger, P>(static_cast<kept&>(*this), p);
  }
  [[nodiscard]] constexpr forgiving parameters() const noexcept {
    return {kept::parameters(), static_cast<double>(amends_)};
  }

  template <class Held, class... Hidden>
  requires requires(kept& k, const motion& m, const Held& f, scalar s, Hidden... h) {
    k.update(m, f, s, h...);
  }
  [[gnu::always_inline]] constexpr bool update(const motion& dx, const Held& held, scalar dt,
                                               Hidden... hidden) noexcept {
    if (!kept::update(dx, held, dt, hidden...)) return false;
    if (shaken_ || in_debt()) [[unlikely]]
      make_amends(dt);
    return true;
  }
  /// The port calls this after a rejected sample, a late tick, or a failed window that `watched` has forgiven.
  [[gnu::cold, gnu::noinline]] constexpr void disturbed() noexcept {
    const bool goes_on = paid_ && quiet_ <= scalar(0);  // samples that are lost in a row
    if (shaken_ && goes_on && this->value() >= amends_ / scalar(2)) return;
    const bool first = !shaken_ || (quiet_ <= scalar(0) && pause_ <= first_pause && !paid_);
    fault();
    if (first && this->value() < amends_) {
      this->lend(amends_ - this->value());
      paid_ = true;
    }
  }
  constexpr void reset() noexcept {
    kept::reset();
    shaken_ = lacks_ = missed_ = false;
  }

  /// True if there has been a fault in the last 10 s or longer; only then does the port ask tells().
  [[nodiscard]] constexpr bool remembers() const noexcept { return shaken_; }
  /// The event of a tick, the worse of `so_far` and the ledger's own. `cut` is true if the bound reduced the force.
  [[nodiscard, gnu::cold, gnu::noinline]] constexpr event tells(event so_far, bool cut) noexcept {
    if (lacks_ && cut) {
      missed_ = true;
      return worse(so_far, event::wall_lost);
    }
    const event now = in_debt() ? event::debt : event::nominal;
    return worse(so_far, missed_ && !lacks_ ? event::wall_back : now);
  }

 private:
  static constexpr scalar first_pause = scalar(0.1), lending = scalar(0.5),
                          forgotten = scalar(10);  // [s]

  constexpr void fault() noexcept {
    if (!shaken_) {
      pause_ = first_pause;
    } else if (paid_ || quiet_ > pause_) {
      pause_ *= scalar(2);
    }
    shaken_ = true;
    paid_ = false;
    quiet_ = scalar(0);
  }
  [[nodiscard]] constexpr bool in_debt() const noexcept {
    if constexpr (exact) {
      return this->value() < scalar(0);
    } else {
      return this->value() < -amends_ / scalar(64) && kept::overdrawn();
    }
  }
  [[gnu::cold, gnu::noinline]] constexpr void make_amends(scalar dt) noexcept {
    if (!lacks_) missed_ = false;  // wall_back has been reported
    const bool waits = shaken_ && quiet_ <= pause_;
    if (!waits && in_debt()) {
      fault();
      lacks_ = amends_ > scalar(0);
      return;
    }
    const bool lends = !paid_ && quiet_ <= pause_ + lending;
    quiet_ += dt;
    if (quiet_ > pause_ && lends && amends_ > scalar(0) && this->value() < amends_) {
      const scalar E1 = waits ? kernels::larger(this->value(), scalar(0)) : this->value();
      this->lend(kernels::smaller(E1 + amends_ / lending * dt, amends_) - this->value());
    }
    lacks_ = lends && amends_ > scalar(0) && this->value() < amends_;
    shaken_ = missed_ || quiet_ <= kernels::larger(forgotten, pause_ + lending);
  }

  scalar amends_;
  scalar pause_{};       ///< θ [s]
  scalar quiet_{};       ///< time since the last fault [s]
  bool shaken_ = false;  ///< there was a fault in the last 10 s
  bool paid_ = false;    ///< E1 was raised to A at once
  bool lacks_ = false;   ///< E1 < A, and credit is still to be added
  bool missed_ = false;  ///< a force was reduced while lacks_
};

static_assert(energy_observer_for<forgiving<>, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
