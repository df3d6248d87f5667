// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Ledgers for a force that is not constant between samples: it comes a fraction of a tick late, or lags behind.
//
//   split_tick{ledger}       the force changes τ of a tick after the sample             exact positions, strict
//   lagging_force{ledger}    the force follows with a time constant, as in a low-pass   exact positions, strict
//   between_samples{dual}    as split_tick, for encoders and for bounds with a reach    conditional
//
//     ph::passive_port{scene{}, ph::given_force{}, ph::split_tick{ph::reduced_energy{.damping = 0.1}, 0.3, 0.4, 1e-3},
//                      ph::strict_bound{}, ph::loop_limits{.longest_tick = 1e-3}}
//
// With a force φ(t) of mean φ̄ within a tick, the energy gained is at least b Δ²/T − φ̄·Δ less T/(4b) times the variance
// of φ, and some motion with the same Δ attains that (ours; Theorem D, mathematics.md § 14). The ledgers book just that.

#include <passive_haptics/energy_observer/dual_ledger.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>

#include <algorithm>
#include <cmath>

namespace passive_haptics {
inline namespace v0 {

namespace detail {
/// The common part of the two strict ledgers. Their value is E1 less a reserve for the force that the motors still hold after
/// the next sample, so that strict_bound, ¼fᵀB⁻¹f ≤ value(), applies unchanged. The travel within a part of a tick is not
/// known, so travel_error() is unbounded for a bound that uses a reach.
template <class Ledger>
struct uneven_force {
  static_assert(Ledger::exact,
                "passive_haptics: this ledger of a late force takes positions as exact: "
                "encoders need between_samples");
  static constexpr guarantee passivity = Ledger::passivity;
  static constexpr bool counts = Ledger::counts;
  static constexpr bool exact =
      false;  // bounds that read the motion themselves are not proved with it
};
}  // namespace detail

/// In each tick the force f₋ of the last one is held for the first part τ, and f after it:
///     E1 += b Δ²/T − (τ f₋ + (1 − τ) f)·Δ − τ (1 − τ) W(f − f₋),     W(f) = ¼ fᵀB⁻¹f
/// for that τ in [fraction, fraction_above] which makes it least, in each tick; fraction_above · W(f) [J] is reserved. With
/// late_loop_limits<k> the force comes k + τ ticks late. Any τ between is covered, also one that changes from tick to tick.
/// `held` of a device_sample is the force that begins in the tick.
template <class Ledger = reduced_energy>
struct split_tick : detail::uneven_force<Ledger> {
  constexpr split_tick(const Ledger& l = {}, double at_least = 0.0, double at_most = 1.0,
                       double T = 1e-3) noexcept
      : ledger(l), fraction(at_least), fraction_above(at_most), longest_tick(T) {}

  Ledger ledger;
  double fraction;        ///< τ, at least
  double fraction_above;  ///< τ, at most
  double longest_tick;    ///< T of the loop [s]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!(fraction >= 0.0 && fraction <= 1.0)) {
      return {"fraction", fraction, "from 0 to 1: whole ticks are late_loop_limits<k>"};
    }
    if (!(fraction_above >= fraction && fraction_above <= 1.0)) {
      return {"fraction_above", fraction_above, "from fraction to 1"};
    }
    if (!detail::positive(longest_tick)) return {"longest_tick", longest_tick, "finite and > 0 s"};
    return ledger.check();
  }
  template <port P>
  class on;
};

template <class Ledger>
template <port P>
class split_tick<Ledger>::on : public part_at<Ledger, P> {
  using kept = part_at<Ledger, P>;

 public:
  using typename kept::effort, typename kept::motion, typename kept::scalar;

  constexpr explicit on(const split_tick& p) noexcept : kept(p.ledger) { set(p); }
  constexpr void set(const split_tick& p) noexcept {
    kept::set(p.ledger);
    least_ = detail::number<scalar>(p.fraction);
    most_ = detail::number<scalar>(p.fraction_above);
    T_ = detail::number<scalar>(p.longest_tick);
  }
  [[nodiscard]] constexpr split_tick parameters() const noexcept {
    return {kept::parameters(), static_cast<double>(least_), static_cast<double>(most_),
            static_cast<double>(T_)};
  }

  constexpr bool update(const motion& dx, const effort& held, scalar dt) noexcept {
    const effort before = last_, change = P::difference(held, before);
    const scalar W = this->damping().worst_outflow(change, dt);
    const auto work = P::work(change, dx);
    scalar t = work.joules < scalar(0) ? most_ : least_;
    if (W > scalar(0))
      t = kernels::clamped(scalar(0.5) * (scalar(1) - work.joules / W), least_, most_);
    const effort mean = effort(P::scaled(before, t) + P::scaled(held, scalar(1) - t));
    if (!kept::update(dx, mean, dt)) return false;
    const scalar up = scalar(1) + scalar(4) * kernels::rounding<scalar>();
    const scalar more =
        this->damping().worst_outflow(held, T_) * up - this->damping().worst_outflow(before, T_);
    // rounding of the mean, and of τ, which is at the minimum of a parabola
    const scalar passed =
        scalar(4) * kernels::rounding<scalar>() * (work.passed + P::work(held, dx).passed);
    this->lend(-(t * (scalar(1) - t) * W * up + most_ * more + passed));
    last_ = held;
    return true;
  }
  /// Books a tick of unknown motion; the outflow of the force before is reserved already.
  constexpr void forfeit(const effort& held, scalar T) noexcept {
    kept::forfeit(held, T);
    last_ = held;
  }
  constexpr void reset() noexcept {
    kept::reset();
    last_ = P::zero();
  }
  [[nodiscard]] static constexpr scalar travel_error() noexcept {
    return kernels::largest<scalar>();
  }

 private:
  scalar least_{}, most_{}, T_{};
  typename P::stored_effort last_{};
};

/// The force y after a first-order lag of time constant θ, of an actuator or a filter: θ ẏ = f − y. The ledger books the mean
/// and the variance of y in the tick, in closed form, and reserves θ yᵀb⁻¹y/4 [J]. With that strict_bound applies unchanged:
/// the outflow of y in a tick of any length up to T plus the reserve at its end is at most ¼fᵀB⁻¹f + θ yᵀb⁻¹y/4. θ has to be
/// known: with a smaller or a larger θ stated, a hand can draw energy.
template <class Ledger = reduced_energy>
struct lagging_force : detail::uneven_force<Ledger> {
  constexpr lagging_force(const Ledger& l = {}, double theta = 0.0) noexcept
      : ledger(l), time_constant(theta) {}

  Ledger ledger;
  double time_constant;  ///< θ [s]; 1/(2π f_c) of a low-pass of f_c [Hz]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!detail::not_negative(time_constant) || time_constant > 0.1) {
      return {"time_constant", time_constant, "from 0 to 0.1 s"};
    }
    return ledger.check();
  }
  template <port P>
  class on;
};

template <class Ledger>
template <port P>
class lagging_force<Ledger>::on : public part_at<Ledger, P> {
  using kept = part_at<Ledger, P>;

 public:
  using typename kept::effort, typename kept::motion, typename kept::scalar;

  constexpr explicit on(const lagging_force& p) noexcept : kept(p.ledger) { set(p); }
  constexpr void set(const lagging_force& p) noexcept {
    kept::set(p.ledger);
    theta_ = detail::number<scalar>(p.time_constant);
  }
  [[nodiscard]] constexpr lagging_force parameters() const noexcept {
    return {kept::parameters(), static_cast<double>(theta_)};
  }

  bool update(const motion& dx, const effort& held, scalar dt) noexcept {
    const scalar z = theta_ > scalar(0) ? dt / theta_ : kernels::largest<scalar>();
    const scalar gone = -std::expm1(-z);  // 1 − e⁻ᶻ of the way
    const effort off = P::difference(effort(force_), held);
    const effort next = effort(held + P::scaled(off, scalar(1) - gone));
    if (blind_ > scalar(0)) {  // y is not known again yet: the tick is written off
      kept::forfeit(held, dt);
      blind_ -= dt;
    } else {
      const effort mean = effort(held + P::scaled(off, z > scalar(0) ? gone / z : scalar(1)));
      if (!kept::update(dx, mean, dt)) return false;
      const scalar off_by = scalar(8) * kernels::rounding<scalar>(), up = scalar(1) + off_by;
      this->lend(-(this->damping().worst_outflow(off, dt) * variance(z, gone) * up +
                   this->damping().worst_outflow(next, theta_) * up -
                   this->damping().worst_outflow(effort(force_), theta_) +
                   off_by * (P::work(off, dx).passed + P::work(held, dx).passed)));
    }
    force_ = next;
    return true;
  }
  /// Books a tick of unknown motion; the outflow of y is reserved already.
  constexpr void forfeit(const effort& held, scalar T) noexcept {
    kept::forfeit(held, T);
    blind_ = scalar(40) * theta_;
  }
  constexpr void reset() noexcept {
    kept::reset();
    force_ = P::zero();
    blind_ = scalar(0);
  }
  [[nodiscard]] static constexpr scalar travel_error() noexcept {
    return kernels::largest<scalar>();
  }

 private:
  /// The variance of e^{−t/θ} over a tick of `z` = dt/θ, with g = 1 − e⁻ᶻ: g (2 − g)/(2z) − g²/z².
  [[nodiscard]] static scalar variance(scalar z, scalar g) noexcept {
    const scalar exact = g * (scalar(2) - g) / (scalar(2) * z) - g * g / (z * z);
    return kernels::smaller(z * z / scalar(12), kernels::larger(exact, scalar(0)) +
                                                    scalar(16) * kernels::rounding<scalar>());
  }

  scalar theta_{}, blind_{};
  typename P::stored_effort force_{};  ///< y at the sample
};
/// A ledger over the positions at which the force changes, ξ_n = x(t_n + τT) [m]. The samples on both sides give
///     ξ̂_n = (1 − τ) x̂_n + τ x̂_n+1,     |ξ_n − ξ̂_n| ≤ ½ q',     q' = q + α τ (1 − τ) T² + w v T
/// if the device's acceleration is at most α. Between ξ_n and ξ_n+1 one force is held, so a dual_ledger with the step q'
/// applies unchanged (ours; Theorem E, § 14). ξ_n is known one sample later, so a loop that is k + τ ticks late needs
/// late_loop_limits<k + 1>. Every bound for encoders is proved with it. w = fraction_above − fraction is the width of the
/// interval of τ, and v the top speed of the loop's limits.
///
/// α is assumed, at least (force_limit + hand and friction)/mass, plus b v/m for the damper.
template <class Ledger = dual_ledger>
struct between_samples {
  static_assert(
      !Ledger::exact,
      "passive_haptics: between_samples is for dual_ledger and quantised_energy, which may "
      "be told a step of 0");
  static constexpr guarantee passivity = (std::min)(Ledger::passivity, guarantee::conditional);
  static constexpr bool counts = Ledger::counts;
  static constexpr bool exact = false;

  Ledger ledger{};             ///< with q of the sensor itself
  double fraction{};           ///< τ, at least
  double fraction_above{};     ///< τ, at most
  double acceleration{};       ///< α [m/s²]
  double longest_tick = 1e-3;  ///< T of the loop [s]
  double top_speed = 5.0;      ///< v of the loop [m/s]; used if w > 0

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!(fraction >= 0.0 && fraction <= 1.0)) {
      return {"fraction", fraction, "from 0 to 1: whole ticks are late_loop_limits<k + 1>"};
    }
    if (!(fraction_above >= fraction && fraction_above <= 1.0)) {
      return {"fraction_above", fraction_above, "from fraction to 1"};
    }
    if (!detail::not_negative(acceleration)) {
      return {"acceleration", acceleration, "finite and ≥ 0 m/s²"};
    }
    if (!detail::positive(longest_tick)) return {"longest_tick", longest_tick, "finite and > 0 s"};
    if (!detail::positive(top_speed)) return {"top_speed", top_speed, "finite and > 0 m/s"};
    return ledger.check();
  }
  template <port P>
  class on;
};

template <class Ledger>
template <port P>
class between_samples<Ledger>::on : public part_at<Ledger, P> {
  using kept = part_at<Ledger, P>;

 public:
  using typename kept::effort, typename kept::motion, typename kept::scalar;
  static_assert(detail::has_geometry<P>,
                "passive_haptics: between_samples knows one acceleration for all directions of a "
                "space: joints need whole ticks of latency");

  constexpr explicit on(const between_samples& p) noexcept : kept(widened(p)) { set(p); }
  constexpr void set(const between_samples& p) noexcept {
    kept::set(widened(p));
    stated_ = p;
    middle_ = detail::number<scalar>((p.fraction + p.fraction_above) / 2.0);
    a_ = detail::number<scalar>(p.acceleration);
    T_ = detail::number<scalar>(p.longest_tick);
  }
  [[nodiscard]] constexpr between_samples parameters() const noexcept { return stated_; }

  constexpr bool update(const motion& dx, const effort& held, scalar dt) noexcept {
    if (!known_) {  // the position at which the force began is unknown
      kept::forfeit(held, kernels::larger(T_, dt));
    } else {
      const motion went = motion(motion(travel_) * (scalar(1) - middle_) + dx * middle_);
      if (!kept::update(went, held, (scalar(1) - middle_) * dt_ + middle_ * dt)) return false;
    }
    travel_ = dx;
    dt_ = dt;
    known_ = true;
    return true;
  }
  constexpr void forfeit(const effort& held, scalar T) noexcept {
    kept::forfeit(held, T);
    travel_ = P::zero();
    known_ = false;
  }
  constexpr void reset() noexcept {
    kept::reset();
    travel_ = P::zero();
    known_ = false;
  }
  /// The error [m] of the next travels along the force, as a bound predicts them from the last one.
  [[nodiscard]] constexpr scalar travel_error() const noexcept {
    const scalar T = kernels::larger(T_, dt_);
    return kept::travel_error() + a_ * T * T / scalar(2);
  }

 private:
  [[nodiscard]] static constexpr Ledger widened(const between_samples& p) noexcept {
    const double worst = kernels::clamped(0.5, p.fraction, p.fraction_above);
    Ledger l = p.ledger;
    l.quantum = l.quantum.width +
                p.acceleration * worst * (1.0 - worst) * p.longest_tick * p.longest_tick +
                (p.fraction_above - p.fraction) * p.top_speed * p.longest_tick;
    return l;
  }

  between_samples stated_;
  scalar middle_{}, a_{}, T_{}, dt_{};
  bool known_ = false;
  typename P::stored_effort travel_{};
};

static_assert(energy_observer_for<split_tick<>, space<float, 1>>);
static_assert(energy_observer_for<lagging_force<>, space<float, 1>>);
static_assert(energy_observer_for<between_samples<>, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
