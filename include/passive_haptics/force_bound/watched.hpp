// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Tests the stated mass and hand force against the measured motion, and stops relying on them once it refutes them.
//
//   watched{reachable_bound{…}}   the same bound, as long as the motion is consistent with mass and hand_force

#include <passive_haptics/port/composing.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace passive_haptics {
inline namespace v0 {

/// A mass of at least m [kg] under the motors' force f [N] and others of at most F [N] has a bounded acceleration. So
/// for two windows A, B of two ticks each (four if m e > F dt², with e the sensor's step [m]) and mean velocities V
///     |J| ≤ ε     or     |J| ≤ ε + u·L + A_w (9/8 F + 2b(|V_A| + |V_B|))      [N·s]                   (§ 12)
///     J = m (V_B − V_A),   L = ∫ w f dt, w the hat over both, of area A_w = (T_A + T_B)/2,   ε = m e (1/T_A + 1/T_B)
/// with some unit vector u at an angle to J whose sine is at most ε/|J|, under the assumptions of reachable_bound. The
/// test begins with a contact. Its pauses grow up to 124 ticks while |J| − ε − u·L is below 1/8 of the last term, and
/// there is none while it is above half of it.
///
/// A window that fails the test (by an outlier, by a blow on the handle) is an event::outside_force, and for 0.1 s of
/// contact the bound is the strict one, ¼fᵀB⁻¹f ≤ E1. After four such windows, each within 0.25 s of contact after the
/// one before, it is the strict one until reset(). As long as one of the following causes explains all failed windows,
/// the force is zero for 25 ms instead of strictly bounded, and after three windows it is zero until reset():
///     wrong_sign       the device holds −f; it is found at once if the device reports −f for three ticks
///     untold_latency   f is held one to three ticks later than stated, or one sooner; reports of held forces count
/// Every other cause (a lighter or compliant device, a stronger hand, another port) stays an outside_force.
///
/// The test adds nothing to the bound's guarantee: it does not detect forces within 9/8 F and the margins. It fails
/// falsely for a hand that accelerates the device with more than F, for end stops, for jumps of the sensor, and for
/// time stamps whose relative error in a window exceeds about A_w F/(m |V|). (ours, § 12)
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
  /// True if this tick is tested: from the second tick of a contact on, and not during a pause.
  [[nodiscard]] constexpr bool looks() const noexcept { return rest_ < 0; }
  /// Takes the last tick: its motion [m], if known, the force commanded and held [N], its length [s], the ledger.
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
  /// The largest possible distance [m] from x + V t at a time t [s] after a tick of T₀ [s] with mean velocity V (§ 13).
  /// v is the sum of both speeds [m/s], `most` the motors' limit [N]. It is 0.12 mm at least: under 9 N that is 1 mJ.
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
  /// `asked` is true if a force is desired in this tick. If none is, the next contact is tested from its beginning.
  constexpr void look_on(bool asked) noexcept {
    if (!asked) at_ = rest_ = pause_ = 0;
    if (asked) --rest_;
  }
  /// The result so far; wrong_sign and untold_latency stop the port.
  [[nodiscard]] constexpr event seen() const noexcept { return what_; }
  /// True while the force must be zero: whether the motion then changes tells these causes from a strong hand.
  [[nodiscard]] constexpr bool lets_go() const noexcept { return lets_go_; }
  /// True if only one window has failed, and mass and hand force are relied upon again.
  [[nodiscard]] constexpr bool forgives() const noexcept {
    return what_ == event::nominal && doubts_ == 1;
  }

 private:
  static constexpr int N = 4;    ///< ticks of half a window
  static constexpr int lag = 3;  ///< the most ticks of unstated latency that are looked for
  static constexpr int longest_pause = 96;  ///< pauses of this many ticks or more do not grow
  static constexpr int enough = 4;          ///< failed windows after which the strict bound stays
  static constexpr int says_no = 3;         ///< reports of the opposite force in a row that decide
  static constexpr std::uint8_t sign = 1, late = 2 + 8 + 16 + 32, all_causes = sign + late;
  static constexpr scalar mistrust = scalar(0.1), letting_go = scalar(0.025),
                          memory = scalar(0.25);  // [s]
  static constexpr scalar unsaid =
      scalar(60e-6);  ///< the largest step that "exact" positions may have [m]

  struct tick_seen {
    stored travel, told, held;
    scalar dt;
  };

  /// After an event the hand force counts as 1e30 N, under which the bound is the strict one.
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

  /// Tests a window of 2 half_ ticks; the `lag` ticks before it and the one after it show latencies.
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

  /// Σ |held − told|² [N²] over the window, `told` being the command of k ticks before.
  [[nodiscard]] constexpr scalar off_by(int k) const noexcept {
    scalar sum(0);
    for (int i = lag; i < lag + 2 * half_; ++i) {
      const effort off = P::difference(seen_[static_cast<std::size_t>(i)].held,
                                       seen_[static_cast<std::size_t>(i - k)].told);
      sum += P::dot(off, off);
    }
    return sum;
  }
  /// True if the device reports held forces that differ from the commanded ones by more than 3 %.
  [[nodiscard]] constexpr bool reports_others() const noexcept {
    scalar told(0);
    for (int i = lag; i < lag + 2 * half_; ++i) {
      const effort f = seen_[static_cast<std::size_t>(i)].told;
      told += P::dot(f, f);
    }
    return off_by(0) * scalar(1024) > told;
  }
  /// The bits of the latencies k that explain the reported forces.
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
  int rest_ = 0;          ///< ticks until the next test; below 0 a tick is tested
  int half_ = N;          ///< ticks in half a window
  int pause_ = 0;         ///< length of the next pause [ticks]
  int at_ = 0;            ///< ticks kept in a row
  int doubts_ = 0;        ///< windows that have failed the test
  int opposed_ = 0;
  std::uint8_t could_be_ = 0;  ///< causes that explain every window since the first doubt
  bool alert_ = false;         ///< the ticks around a window are kept, too
  bool lets_go_ = false;
  event what_ = event::nominal;
  std::array<tick_seen, lag + 2 * N + 1> seen_{};
};

}  // namespace v0
}  // namespace passive_haptics
