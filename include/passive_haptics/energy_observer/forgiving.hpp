// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A way back from what a fault has done to a ledger.
//
//   forgiving{ledger, amends}   a while after a fault E1 rises to A again

#include <passive_haptics/base/event.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/port/composing.hpp>

#include <algorithm>

namespace passive_haptics {
inline namespace v0 {

/// A ledger that is kept to the letter trusts nobody again after one false sample. When a pause θ has gone by without
/// a fault, this one writes a debt off, once, and lends for τ = ½ s
///     E1 += min(A dt/τ, A − E1)  where E1 < A;
/// a refused sample or a late tick that is the first fault in 10 s it forgives at once, E1 = max(E1, A), and only so.
/// A fault is a sample that is refused, a late tick, or a debt, of A/64 where positions are known to a step only: the
/// bounds here leave none unless something that was stated is not so. θ is 0.1 s, twice as long each time that there
/// is a fault after amends, and 0.1 s again when there was none for 10 s. So with D, what the faults themselves have
/// done, after t seconds of whatever faults
///     E ≥ −D − A (8 + t/2.5 s),
/// and without a fault it is all that the ledger itself promises (docs/design/mathematics.md § 11).
template <class Ledger = reduced_energy>
struct forgiving {
  static constexpr guarantee passivity = (std::min)(Ledger::passivity, guarantee::conditional);
  static constexpr bool counts = Ledger::counts;
  static constexpr bool exact = Ledger::exact;
  static constexpr bool turns = detail::books_turns<Ledger>();

  Ledger ledger{};
  double amends{};  ///< A [J], of the order of ½F²/K of a contact; 0: nothing is forgiven

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!detail::not_negative(amends)) return {"amends", amends, "finite and ≥ 0 J"};
    return ledger.check();
  }
  template <port P>
  class on;
};
template <class Ledger>
forgiving(Ledger, double) -> forgiving<Ledger>;

/// A [J] of motors that hold `force_limit` F [N]: ½F²/K of a contact that F presses 5 mm deep; 0 if F is no limit.
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
  /// There was a fault: the port says so.
  constexpr void disturbed() noexcept {
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

  /// Has there been a fault in the last 10 s? Only then has tells() something to say, a debt included.
  [[nodiscard]] constexpr bool remembers() const noexcept { return shaken_; }
  /// What a tick is to be called that was called `so_far`, and whose force was cut, or not.
  [[nodiscard, gnu::cold, gnu::noinline]] constexpr event tells(event so_far, bool cut) noexcept {
    if (lacks_ && cut) {
      missed_ = true;
      return worse(so_far, event::wall_lost);
    }
    return worse(so_far, missed_ && !lacks_ ? event::wall_back : poor());
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
    if constexpr (exact) return this->value() < scalar(0);
    return this->value() < -amends_ / scalar(64);
  }
  [[nodiscard]] constexpr event poor() const noexcept {
    bool owed = this->value() < scalar(0);
    if constexpr (requires(const kept k) { k.overdrawn(); }) owed = owed && kept::overdrawn();
    return owed ? event::debt : event::nominal;
  }
  [[gnu::cold, gnu::noinline]] constexpr void make_amends(scalar dt) noexcept {
    if (!lacks_) missed_ = false;  // that it is back has been told
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
  scalar quiet_{};       ///< since the last fault [s]
  bool shaken_ = false;  ///< there was a fault in the last 10 s
  bool paid_ = false;    ///< its amends have been made at once
  bool lacks_ = false;   ///< E1 < A, and amends are to come
  bool missed_ = false;  ///< meanwhile a force was cut
};

static_assert(energy_observer_for<forgiving<>, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
