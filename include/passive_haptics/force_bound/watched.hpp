// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Holds what was stated of a device against its motion. Where the motion refutes it, the bound stops relying on it.
//
//   watched{reachable_bound{…}}   is the bound itself as long as nothing contradicts what was stated

#include <passive_haptics/port/composing.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace passive_haptics {
inline namespace v0 {

/// A mass of at least m that the motors' f and at most F besides push accelerates no more than both allow. For two
/// windows A, B of two ticks each (of four where the sensor's steps e are large) with mean velocities V it follows that
///     |J| ≤ ε     or     |J| ≤ ε + u·L + A_w (9/8 F + 2b(|V_A| + |V_B|))      [N·s]                   (§ 12)
///     J = m (V_B − V_A),   L = ∫ w f dt, w the hat over both, of area A_w = (T_A + T_B)/2,   ε = m e (1/T_A + 1/T_B)
/// with some unit vector u no farther than ε/|J| from J, if everything holds that reachable_bound assumes. The test is
/// made from the beginning of a contact on, then ever more rarely, at last every 96 ticks, and without a pause while
/// J takes up more than half of what is allowed.
///
/// A window that fails the test (by an outlier, by a blow on the handle) is an event::outside_force, and for 0.1 s of
/// contact the bound is the strict one, ¼fᵀB⁻¹f ≤ E1. Four such windows, each within 0.25 s of contact after the one
/// before, are not forgiven until reset(). As long as one of these causes explains all of them, the force is zero for
/// 25 ms instead of bounded strictly, and after three windows it is zero until reset():
///     wrong_sign       the device holds −f; it is found at once if the device reports −f for three ticks
///     untold_latency   f is held one to three ticks later than stated, or one sooner; reports of held forces count
/// Every other cause (a lighter or compliant device, a stronger hand, another port) stays an outside_force.
///
/// The test promises nothing beyond the bound: it does not see what stays within 9/8 F and the slack. It is mistaken
/// about a hand that pushes harder than F where nothing resists, about end stops, about jumps of the sensor, and about
/// time stamps that are off by more than about A_w F/(m |V|) of a window.
template <class Bound>
requires requires(const Bound b) {
  b.mass, b.hand_force;
}  // the two statements that a motion can refute
struct watched {
  static constexpr guarantee passivity = Bound::passivity;
  static constexpr bound_traits traits = Bound::traits;

  Bound bound{};

  [[nodiscard]] constexpr parameter_fault check() const noexcept { return bound.check(); }
  template <port P>
  class on;
};
template <class Bound>
watched(Bound) -> watched<Bound>;

template <class Bound>
requires requires(const Bound b) {
  b.mass, b.hand_force;
}
template <port P>
class watched<Bound>::on : public part_at<Bound, P> {
  using kept = part_at<Bound, P>;
  using stored = typename P::stored_effort;

 public:
  using typename kept::effort, typename kept::scalar;
  template <class Parameters>
  static constexpr int takers = detail::takers<Parameters, Bound, P>;

  constexpr explicit on(const watched& p) noexcept : kept(p.bound), stated_(p) {}
  constexpr void set(const watched& p) noexcept {
    stated_ = p;
    rely(what_);
  }
  template <class Parameters>
  constexpr void take(const Parameters& p) noexcept {
    part_at<Bound, P> next(stated_.bound);
    detail::take<Bound, P>(next, p);
    set({next.parameters()});
  }
  [[nodiscard]] constexpr watched parameters() const noexcept { return stated_; }
  constexpr void reset() noexcept { *this = on(stated_); }

  [[nodiscard]] constexpr on& watching() noexcept { return *this; }
  /// True if this tick is looked at: from the second tick of a contact on, and not during a pause.
  [[nodiscard]] constexpr bool looks() const noexcept { return rest_ < 0; }
  /// Takes the tick that is over: its motion [m], if known, the force told and held [N], its length [s], the ledger.
  template <bool Exact>
  constexpr void look(bool known, const stored& travel, const stored& told, const stored& held,
                      scalar dt, const auto& ledger) noexcept {
    scalar error(0);
    if constexpr (Exact) {  // the least motion seen is no smaller than a step of the sensor
      const scalar moved = P::norm(travel);
      if (known && moved > scalar(0) && moved < step_) step_ = moved;
      error = step_;
    } else {
      error = ledger.travel_error();
    }
    watch(known, {travel, told, held, dt}, error, detail::most_damping<P>(ledger.damping()));
  }
  /// The farthest [m] that a device may be from x + V t at a time t after a tick of T₀ with velocity V (§ 13); v is the
  /// sum of both speeds, `most` what its motors hold [N]. It is 0.12 mm at least, which is too little to do harm.
  template <bool Exact>
  [[nodiscard]] constexpr scalar far_off(scalar T0, scalar t, scalar v, scalar most,
                                         const auto& ledger) const noexcept {
    scalar error = scalar(2) * step_;
    if constexpr (!Exact) error = ledger.travel_error();
    const scalar pushed =
        most + force() * scalar(1.125) + scalar(2) * detail::most_damping<P>(ledger.damping()) * v;
    const scalar reach = t * (T0 + t) / scalar(2) * pushed / mass();
    return kernels::larger(reach + error * (scalar(1) + t / T0), scalar(2) * unsaid);
  }
  /// Says whether this tick asks for a force. If it asks for none, the next contact is looked at from its beginning.
  constexpr void look_on(bool asked) noexcept {
    if (!asked) at_ = rest_ = pause_ = 0;
    if (asked) --rest_;
  }
  /// The verdict so far; one that is worse than outside_force stops the port.
  [[nodiscard]] constexpr event seen() const noexcept { return what_; }
  /// True while the force must be zero: whether the motion changes then tells such a cause from a strong hand.
  [[nodiscard]] constexpr bool lets_go() const noexcept { return lets_go_; }
  /// True if only one window has failed, and what was stated is relied upon again.
  [[nodiscard]] constexpr bool forgives() const noexcept {
    return what_ == event::nominal && doubts_ == 1;
  }

 private:
  static constexpr int N = 4;    ///< ticks of half a window
  static constexpr int lag = 3;  ///< ticks of latency that are looked for
  static constexpr int longest_pause =
      96;                            ///< between two looks at what is far from refuted [ticks]
  static constexpr int enough = 4;   ///< so many windows are not forgiven any more
  static constexpr int says_no = 3;  ///< so many reports in a row of the opposite force decide
  static constexpr std::uint8_t sign = 1, late = 2 + 8 + 16 + 32, all_causes = sign + late;
  static constexpr scalar mistrust = scalar(0.1), letting_go = scalar(0.025),
                          memory = scalar(0.25);  // [s]
  static constexpr scalar unsaid =
      scalar(60e-6);  ///< the largest step that "exact" positions may have [m]

  struct tick_seen {
    stored travel, told, held;
    scalar dt;
  };

  /// With a hand of any force the bound that remains is the strict one.
  constexpr void rely(event what) noexcept {
    what_ = what;
    Bound p = stated_.bound;
    if (what != event::nominal) p.hand_force = 1e30;
    static_cast<kept&>(*this) = kept(p);
  }

  [[nodiscard]] constexpr scalar mass() const noexcept {
    return detail::number<scalar>(stated_.bound.mass);
  }
  [[nodiscard]] constexpr scalar force() const noexcept {
    return detail::number<scalar>(stated_.bound.hand_force);
  }

  constexpr void trust_again() noexcept {
    lets_go_ = false;
    if (what_ != event::nominal) rely(event::nominal);
  }

  constexpr void watch(bool good, const tick_seen& now, scalar error, scalar b) noexcept {
    rest_ = 0;
    if (doubts_ >= enough) return;
    if (at_ == 0) {  // a contact begins, or the motion is known again
      trust_again();
      quiet_ += mistrust / scalar(2);
      if (!alert_) at_ = lag;
      half_ = mass() * error <= force() * now.dt * now.dt ? N / 2 : N;
    }
    if (!good) {
      at_ = 0;
      return;
    }
    const effort told = now.told;
    opposed_ = P::dot(now.held, told) * scalar(-4) > P::dot(told, told) ? opposed_ + 1 : 0;
    if (opposed_ == says_no) {
      doubts_ = enough;
      return rely(event::wrong_sign);
    }
    seen_[static_cast<std::size_t>(at_)] = now;
    const int one_more = alert_ ? 1 : 0;
    if (++at_ < lag + 2 * half_ + one_more) return;
    judge(error, b);
    at_ = 0;
    if (rest_ > 0) return;
    for (; at_ < lag + one_more; ++at_) {
      seen_[static_cast<std::size_t>(at_)] = seen_[static_cast<std::size_t>(at_ + 2 * half_)];
    }
  }

  /// Judges a window of 2N ticks; the `lag` ticks before it and the one after it tell of latencies.
  constexpr void judge(scalar error, scalar b) noexcept {
    const auto at = [this](int i) -> const tick_seen& {
      return seen_[static_cast<std::size_t>(lag + i)];
    };
    effort XA = P::zero(), XB = P::zero();
    scalar TA(0), TB(0);
    for (int i = 0; i < half_; ++i) {
      XA = effort(XA + effort(at(i).travel));
      XB = effort(XB + effort(at(half_ + i).travel));
      TA += at(i).dt;
      TB += at(half_ + i).dt;
    }
    const effort VA = P::scaled(XA, scalar(1) / TA), VB = P::scaled(XB, scalar(1) / TB);
    const effort J = P::scaled(P::difference(VB, VA), mass());
    const scalar size = P::norm(J);
    const scalar reach = (TA + TB) / scalar(2) *
                         (force() * scalar(1.125) + scalar(2) * b * (P::norm(VA) + P::norm(VB)));
    const scalar off = mass() * error * (scalar(1) / TA + scalar(1) / TB);
    /// The part of `reach` that J takes up if `force(i)` was held in tick i [N·s].
    const auto needed = [&](const auto& force) {
      if (!(size > off)) return scalar(0);  // the sensor's error alone may explain J
      effort L = P::zero();
      scalar passed(0);
      for (int i = 0; i < 2 * half_; ++i) {
        if (i == half_) passed = scalar(0);
        const scalar dt = at(i).dt, mid = passed + dt / scalar(2);
        L = effort(L + P::scaled(force(i), dt * (i < half_ ? mid / TA : scalar(1) - mid / TB)));
        passed += dt;
      }
      scalar along = P::dot(J, L) / size;
      if constexpr (P::dof > 1) {  // the true J may lie beside the one seen, by an angle of sine s
        const scalar s = off / size, c = kernels::square_root(scalar(1) - s * s);
        const scalar length = P::norm(L);
        const scalar across =
            kernels::square_root(kernels::larger(length * length - along * along, scalar(0)));
        along = along >= c * length ? length : c * along + s * across;
      }
      return size - off - along;
    };
    const scalar used = needed([&](int i) { return effort(at(i).held); });
    const bool others = reports_others();
    const std::uint8_t reported = alert_ && others ? misreported() : std::uint8_t{0};
    const bool refuted = reported != 0 || !(used <= reach);
    if (doubts_ == 0 && !refuted) {
      if (!others && used * scalar(2) <= reach) {
        rest_ = pause_;
        pause_ = used * scalar(8) <= reach && pause_ < longest_pause ? 2 * pause_ + 4 : pause_;
        alert_ = false;
      } else {
        alert_ = alert_ || others;
      }
      return;
    }
    std::uint8_t possible = reported;
    if (reported == 0) {
      if (needed([&](int i) { return P::scaled(at(i).told, scalar(-1)); }) <= reach) {
        possible = sign;
      }
      for (int k = -1; k <= lag && alert_; ++k) {
        if (needed([&](int i) { return effort(at(i - k).told); }) <= reach) possible |= later_by(k);
      }
    }
    if (!alert_) possible |= late;  // the ticks around the window, which would tell, were not kept
    if (doubts_ == 0) could_be_ = all_causes;
    could_be_ &= possible;
    if (refuted) {
      lets_go_ = (could_be_ & (alert_ ? all_causes : sign)) != 0;
      ++doubts_;
      quiet_ = scalar(0);
      rely(event::outside_force);
    } else {
      lets_go_ = lets_go_ && could_be_ != 0;
      quiet_ += TA + TB;
    }
    alert_ = true;
    if (doubts_ >= (lets_go_ ? enough - 1 : enough)) {
      doubts_ = enough;
      if (lets_go_) rely((could_be_ & sign) != 0 ? event::wrong_sign : event::untold_latency);
    } else if (quiet_ > memory) {
      doubts_ = 0;
    }
    if (doubts_ < enough && quiet_ > (lets_go_ ? letting_go : mistrust)) trust_again();
  }

  /// Σ |held − told|² [N²] over the window, where what was told k ticks before counts.
  [[nodiscard]] constexpr scalar off_by(int k) const noexcept {
    scalar sum(0);
    for (int i = lag; i < lag + 2 * half_; ++i) {
      const effort off = P::difference(seen_[static_cast<std::size_t>(i)].held,
                                       seen_[static_cast<std::size_t>(i - k)].told);
      sum += P::dot(off, off);
    }
    return sum;
  }
  /// True if the device reports forces that are off by more than 3 % from those that it was told.
  [[nodiscard]] constexpr bool reports_others() const noexcept {
    scalar told(0);
    for (int i = lag; i < lag + 2 * half_; ++i) {
      const effort f = seen_[static_cast<std::size_t>(i)].told;
      told += P::dot(f, f);
    }
    return off_by(0) * scalar(1024) > told;
  }
  /// The bits of the latencies that explain these reports.
  [[nodiscard]] constexpr std::uint8_t misreported() const noexcept {
    std::uint8_t found = 0;
    for (int k = -1; k <= lag; ++k) {
      if (off_by(k) * scalar(16) <= off_by(0)) found |= later_by(k);
    }
    return found;
  }
  /// The bit of a latency that is k ticks more than stated.
  [[nodiscard]] static constexpr std::uint8_t later_by(int k) noexcept {
    return k == 0 ? std::uint8_t{0} : static_cast<std::uint8_t>(1 << (k + 2));
  }

  watched stated_;
  scalar step_ = unsaid;  ///< the least motion that the sensor has shown [m]
  scalar quiet_{};        ///< contact since the last window that failed [s]
  int rest_ = 0;          ///< ticks until the next look; below 0 a tick is looked at
  int half_ = N;          ///< ticks of half a window
  int pause_ = 0;         ///< length of the next rest [ticks]
  int at_ = 0;            ///< ticks seen in a row
  int doubts_ = 0;        ///< windows that have failed the test
  int opposed_ = 0;
  std::uint8_t could_be_ = 0;  ///< causes that explain every window since the first doubt
  bool alert_ = false;         ///< the ticks around a window are kept as well
  bool lets_go_ = false;
  event what_ = event::nominal;
  std::array<tick_seen, lag + 2 * N + 1> seen_{};
};

}  // namespace v0
}  // namespace passive_haptics
