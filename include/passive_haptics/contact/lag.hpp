// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The surface that is felt (the own one) follows the updates of the newest one at a limited rate, so that the force
// does not step. The device's own motion is never limited. With d [m] the depth in the newest surface, which bends as its
// planes have shown (bending.hpp),
//
//     own depth = d − ℓ + p
//     update     the own depth is kept: the lag ℓ [m] takes the jump of d, and the lead p [m] is 0
//     each tick  |ℓ| falls by ρ dt,   ρ = 3|ℓ₀|/P, within [R_least, R_most]/K; and, if that takes no longer than
//                0.8 s, ρ + u is at most max(R_usual/K, 4/3 |u|) or, if w > R_usual/K, w + w min(P/10 ms, 1)
//                p grows by u dt for the time P, but no longer than `ahead`; if no update has come for twice as
//                long, the surface may have stopped, and p is reduced to 0 in the same way as ℓ
//                outwards the own surface moves by no more than what the ledger pays for (port_state::paid_way)
//                the own normal turns by ω dt while p grows, and at its own rate towards the newest one so turned
//
// ℓ₀ is the lag at the last update, P [s] the usual time between updates, and vₙ [m/s] the velocity of the surface at
// the device between the last two. u is the next one, as far as it is foreseen (base/foresight.hpp).
//
//     w = max(|vₙ|, |vₙ₋₁|) if the surface is steady, 2 Σ v'ₙ v'ₙ₋₁ > max(Σ v'ₙ₋₁², vₙ²); else w = 0, and |ℓ| falls by
//     at most |ℓ₀|/2 while p grows, unless the device has moved at vₙ/4 since the last update
//
// So a surface that stood and jumps is not extrapolated, and one that moves on, to and fro as well, is not late. One
// that yields late to the force itself would swing for ever without |ℓ₀|/2. ω [1/s] is the turn between the last two
// updates, at most twice that of the two before, and 0 if that had the opposite sign. Source: ours;
// docs/design/contacts.md § 6.

#include <passive_haptics/base/foresight.hpp>
#include <passive_haptics/base/parameter.hpp>

#include <optional>
#include <utility>

namespace passive_haptics {
inline namespace v0 {

/// The rates at which the own surface follows updates of a pressed one.
struct news_pace {
  double least_force_rate = 5.0;   ///< R_least, least rate of the force [N/s]
  double usual_force_rate = 19.5;  ///< R_usual [N/s]: 0.0195 N per ms are not felt
  double most_force_rate = 50.0;   ///< R_most, largest rate [N/s]
  double ahead = 0.08;             ///< longest extrapolation by u after an update [s]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!detail::positive(least_force_rate)) {
      return {"least_force_rate", least_force_rate, "finite and > 0 N/s"};
    }
    if (!(usual_force_rate >= least_force_rate)) {
      return {"usual_force_rate", usual_force_rate, "≥ least_force_rate"};
    }
    if (!(most_force_rate >= usual_force_rate)) {
      return {"most_force_rate", most_force_rate, "≥ usual_force_rate"};
    }
    if (!detail::not_negative(ahead)) return {"ahead", ahead, "finite and ≥ 0 s"};
    return {};
  }
  template <class Scalar>
  class at;
};

template <class Scalar>
class news_pace::at {
 public:
  constexpr explicit at(const news_pace& p) noexcept
      : least_(detail::number<Scalar>(p.least_force_rate)),
        usual_(detail::number<Scalar>(p.usual_force_rate)),
        most_(detail::number<Scalar>(p.most_force_rate)),
        ahead_(detail::number<Scalar>(p.ahead)) {}
  [[nodiscard]] constexpr news_pace parameters() const noexcept {
    return {.least_force_rate = static_cast<double>(least_),
            .usual_force_rate = static_cast<double>(usual_),
            .most_force_rate = static_cast<double>(most_),
            .ahead = static_cast<double>(ahead_)};
  }

  /// ρ [m/s] for a lag [m], the time between updates P [s], u and w [m/s], and 1/K [m/N].
  [[nodiscard]] constexpr Scalar speed_for(Scalar lag, Scalar interval, Scalar u, Scalar w,
                                           Scalar compliance) const noexcept {
    const Scalar size = kernels::magnitude(lag), same_way = lag < Scalar(0) ? -u : u;
    const Scalar not_felt = usual_ * compliance;
    Scalar most = kernels::larger(not_felt, kernels::magnitude(u) * Scalar(4) / Scalar(3));
    if (w > not_felt) {
      most = kernels::larger(most, w + w * kernels::smaller(interval / Scalar(0.01), Scalar(1)));
    }
    const Scalar calm = most - kernels::larger(same_way, Scalar(0));
    const Scalar wanted =
        kernels::smaller(Scalar(3) * size / interval, kernels::larger(calm, size / Scalar(0.8)));
    return kernels::clamped(wanted, least_ * compliance, most_ * compliance);
  }
  [[nodiscard]] constexpr Scalar usual() const noexcept { return usual_; }  ///< R_usual [N/s]
  [[nodiscard]] constexpr Scalar most() const noexcept { return most_; }    ///< R_most [N/s]
  [[nodiscard]] constexpr Scalar ahead() const noexcept { return ahead_; }  ///< [s]
  static constexpr Scalar longest() noexcept { return Scalar(0.3); }        ///< largest P [s]
  static constexpr Scalar oldest() noexcept { return Scalar(0.1); }  ///< largest age used [s]

 private:
  Scalar least_, usual_, most_, ahead_;
};

/// The motion of a surface, which an update may state.
template <class Space>
struct surface_motion {
  /// Its own velocity at the stated place [m/s], without the part by which it yields to the force.
  std::optional<typename Space::coordinates> velocity{};
  /// The age of the update [s], which is compensated if the velocity is stated.
  typename Space::scalar age{};

  [[nodiscard]] constexpr bool is_usable() const noexcept {
    return age >= typename Space::scalar(0) && kernels::is_finite(age) &&
           (!velocity || Space::is_finite(*velocity));
  }
};

/// How the speeds v of updates go on: the next one that is foreseen, and w.
template <class Scalar>
class going_on {
 public:
  /// Takes v [m/s], out of line, once for both that a lag has.
  [[gnu::cold, gnu::noinline]] constexpr void hear(Scalar v) noexcept {
    sees_.hear(v * v, v * last_, v * older_);
    older_ = std::exchange(last_, v);
  }
  /// What is foreseen of the next one [m/s].
  [[nodiscard]] constexpr Scalar next() const noexcept {
    return sees_.last() * last_ + sees_.before() * older_;
  }
  [[nodiscard]] constexpr bool is_steady() const noexcept { return sees_.is_steady(); }
  /// |v| [m/s].
  [[nodiscard]] constexpr Scalar last() const noexcept { return kernels::magnitude(last_); }
  /// w [m/s].
  [[nodiscard]] constexpr Scalar fastest() const noexcept {
    return is_steady() ? kernels::larger(last(), kernels::magnitude(older_)) : Scalar(0);
  }

 private:
  Scalar last_{}, older_{};  ///< v, and the one before [m/s]
  foresight<Scalar> sees_;
};

/// The lag ℓ, the lead p, and the motion of the updates.
template <class Scalar>
class lag {
 public:
  /// ℓ − p [m], the depth in the newest surface less the own depth.
  [[nodiscard]] constexpr Scalar offset() const noexcept { return behind_ - lead_; }
  /// True if ℓ is 0 and nothing moves.
  [[nodiscard]] constexpr bool settled() const noexcept { return settled_; }

  /// The time for which the last update is extrapolated so far [s], 0 if the surface may have stopped; whether it is.
  [[nodiscard]] constexpr Scalar taken_on() const noexcept {
    return silent() ? Scalar(0) : age_ + kernels::smaller(since_, ahead_);
  }
  [[nodiscard]] constexpr bool taking_on() const noexcept { return since_ < ahead_; }
  /// True if no update has come for twice the usual time.
  [[nodiscard]] constexpr bool silent() const noexcept { return since_ > Scalar(2) * ahead_; }

  /// The time since the last update [s].
  [[nodiscard]] constexpr Scalar since() const noexcept { return since_; }
  /// Adds dt [s] to that time.
  constexpr void grow_older(Scalar dt) noexcept { since_ += dt; }
  /// Moves ℓ and p on by one tick of dt [s], and the own surface outwards by `most` [m] at most.
  constexpr void follow(Scalar dt, Scalar most = kernels::largest<Scalar>()) noexcept {
    const Scalar step = speed_ * dt, before = offset();
    if (kernels::magnitude(behind_) <= step) {
      behind_ = Scalar(0);
    } else {
      behind_ += behind_ < Scalar(0) ? step : -step;
    }
    if (since_ <= ahead_) {
      goes_on_ += gains_ * dt;
      lead_ += goes_on_ * dt;
    } else if (silent()) {
      behind_ -= lead_;
      lead_ = goes_on_ = gains_ = Scalar(0);
    }
    if (before - offset() > most) behind_ = before - most + lead_;
    settled_ = behind_ == Scalar(0) && goes_on_ == Scalar(0);
  }
  /// The stated motion of an update at the device.
  struct account {
    Scalar speed{};      ///< outward, of the surface itself [m/s]
    Scalar age{};        ///< [s]
    bool knows = false;  ///< `speed` is stated
    Scalar way{};        ///< of the device since the last update [m]
  };
  /// True if an update of that age [s] is younger than the last one, or older by at most `slack` [s].
  [[nodiscard]] constexpr bool follows(Scalar age, Scalar slack) const noexcept {
    return age <= since_ + told_age_ + slack;
  }
  /// The time between the instants of the last update and of one of that age [s]. Updates that state neither age nor speed
  /// and come at once, because those before were late, are no faster motion: they took half of the longest of late.
  [[nodiscard, gnu::noinline]] constexpr Scalar between(Scalar age) const noexcept {
    const bool stated = age > Scalar(0) || told_age_ > Scalar(0) || knows_;
    return kernels::larger(seems(age), stated ? Scalar(0) : longest_ / Scalar(2));
  }
  /// An update: `now` is the depth in it, `moved` its displacement at the device, and `own` the own depth so far or at
  /// the beginning of the contact, 0 without contact [m].
  [[gnu::cold, gnu::noinline]] constexpr void hear(Scalar own, Scalar now, Scalar moved,
                                                   Scalar compliance,
                                                   const news_pace::at<Scalar>& pace,
                                                   const account& told = {}) noexcept {
    const Scalar took = took_by(moved, told.age);
    const Scalar usual = kernels::smaller(since_, pace.longest() / Scalar(2));
    longest_ = kernels::larger(usual, longest_ + (usual - longest_) / Scalar(5));
    if (!(since_ < Scalar(1))) longest_ = Scalar(0);
    expect(moved / took, took, compliance, pace, told);
    const Scalar interval =
        kernels::smaller(kernels::larger(since_, kernels::rounding<Scalar>()), pace.longest());
    // P follows a longer interval at once and a shorter one slowly, for a network that drops updates.
    if (!(usual_ > Scalar(0))) usual_ = pace.longest();
    usual_ = kernels::larger(interval, usual_ + (interval - usual_) / Scalar(8));
    ahead_ = kernels::smaller(usual_, pace.ahead());
    since_ = Scalar(0);
    told_age_ = told.age;
    take_on(pace);
    const Scalar here = now + lead_;
    behind_ =
        own > Scalar(0) || here > Scalar(0) ? here - kernels::larger(own, Scalar(0)) : Scalar(0);
    if (!kernels::is_finite(behind_ + goes_on_)) return void(*this = {});
    const auto& by = heard();
    speed_ = pace.speed_for(behind_, usual_, goes_on_, by.fastest(), compliance);
    if (told.way < by.last() * took / Scalar(4) && !by.is_steady())
      speed_ = kernels::smaller(speed_, kernels::magnitude(behind_) / (Scalar(2) * ahead_));
    settled_ = behind_ == Scalar(0) && lead_ == Scalar(0) && goes_on_ == Scalar(0);
  }
  /// Drops ℓ and p, for a device that touches neither surface, so that no force can step.
  constexpr void let_go() noexcept {
    behind_ = lead_ = goes_on_ = gains_ = Scalar(0);
    settled_ = true;
  }

 private:
  /// between(), if no update was late [s].
  [[nodiscard]] constexpr Scalar seems(Scalar age) const noexcept {
    return kernels::larger(kernels::larger(since_ + told_age_ - age, since_ / Scalar(2)),
                           kernels::rounding<Scalar>());
  }
  /// between() of an update that has moved the surface by `moved` [m]: no longer than that takes at the speed of the one
  /// before, because updates of uneven instants come at once as well.
  [[nodiscard]] constexpr Scalar took_by(Scalar moved, Scalar age) const noexcept {
    const Scalar most = between(age), way = kernels::magnitude(moved);
    return way < moved_ * most ? kernels::larger(seems(age), way / moved_) : most;
  }
  /// Where updates one by one do not go on steadily, those within this time [s] are heard as one, because each may tell more
  /// of its noise than of its way.
  static constexpr Scalar as_one = Scalar(0.0075);
  /// Updates one by one, or as one: those are late by that time, and would swing where the surface yields to the force.
  [[nodiscard]] constexpr const going_on<Scalar>& heard() const noexcept {
    return steady_.is_steady() || !longer_.is_steady() ? steady_ : longer_;
  }
  /// Updates u and u̇ from the speed between the last two updates and the stated one.
  constexpr void expect(Scalar speed, Scalar took, Scalar compliance,
                        const news_pace::at<Scalar>& pace, const account& told) noexcept {
    const Scalar moved = kernels::magnitude(speed), calm = pace.usual() * compliance;
    const bool worse = !(kernels::magnitude(speed - told_speed_) <= moved);
    const bool again = std::exchange(worse_, worse) && worse;
    // What begins is believed to be as fast as R_most only, because what jumps may be told to be as fast, and stops.
    const Scalar went =
        kernels::larger(std::exchange(moved_, moved), kernels::magnitude(told_speed_));
    const Scalar begins = kernels::larger(Scalar(2) * went, pace.most() * compliance);
    const Scalar before = its_;
    const Scalar most = kernels::larger(calm, kernels::smaller(Scalar(2) * moved, begins));
    its_ = told.knows ? kernels::clamped(told.speed, -most, most) : Scalar(0);
    told_speed_ = its_;
    fastest_ = kernels::larger(kernels::magnitude(its_), kernels::magnitude(before));
    const bool knew = std::exchange(knows_, told.knows) && told.knows;
    const Scalar rest = speed - (knew ? (its_ + before) / Scalar(2) : its_);
    heard_ += rest * took;
    heard_for_ += took;
    if (!(heard_for_ < as_one)) {
      longer_.hear(heard_ / heard_for_);
      heard_ = heard_for_ = Scalar(0);
    }
    steady_.hear(rest);
    Scalar of_the_rest = heard().next();
    gains_ = knew ? (its_ - before) / took : Scalar(0);
    if (knows_ && again) its_ = gains_ = of_the_rest = Scalar(0);
    if (knows_) of_the_rest = kernels::clamped(of_the_rest, -calm, calm);
    goes_on_ = its_ + of_the_rest;
  }
  /// Extrapolates the stated motion to the present, where u̇ changes u by at most the larger stated speed.
  constexpr void take_on(const news_pace::at<Scalar>& pace) noexcept {
    age_ = knows_ ? kernels::smaller(told_age_, pace.oldest()) : Scalar(0);
    const Scalar most = fastest_ / (age_ + ahead_);
    gains_ = kernels::clamped(gains_, -most, most);
    lead_ = (its_ + gains_ * age_ / Scalar(2)) * age_;
    goes_on_ += gains_ * age_;
  }

  Scalar behind_{}, lead_{};          ///< ℓ, p [m]
  Scalar speed_{};                    ///< ρ [m/s]
  Scalar goes_on_{};                  ///< u [m/s]
  going_on<Scalar> steady_, longer_;  ///< of updates one by one, and of those that are heard as one
  Scalar heard_{}, heard_for_{};      ///< ways that longer_ has not yet heard [m], their time [s]
  Scalar usual_{}, ahead_{};          ///< P, and the time for which p grows [s]
  Scalar since_{};                    ///< time since the last update [s]
  Scalar longest_{};  ///< such a time, the longest one that is not long ago; 0 after a pause [s]
  Scalar age_{}, told_age_{};  ///< age of the last update, compensated and stated [s]
  Scalar gains_{};             ///< u̇ [m/s²]
  Scalar its_{}, fastest_{};   ///< last stated speed used, larger one of the last two [m/s]
  Scalar told_speed_{};        ///< last stated speed [m/s]
  Scalar moved_{};             ///< how fast the update before has moved the surface [m/s]
  bool worse_ = false;         ///< at the last update that was worse than 0 m/s
  bool knows_ = false;         ///< the last update stated its speed
  bool settled_ = true;
};

/// ω [1/s], the turn of a normal between updates: that between the last two, limited to twice the one before, and 0 if
/// their directions differ by more than 90°. In one dimension nothing turns.
template <class Space, bool = (Space::dof > 1)>
class turning {
 public:
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;

  [[nodiscard]] constexpr bool still() const noexcept { return still_; }
  /// A unit normal after it has turned with ω for a time [s].
  [[nodiscard]] constexpr vector turned(const vector& normal, scalar time) const noexcept {
    if (still()) return normal;
    const vector further = normal + vector(believed_) * time;
    const scalar length = Space::norm(further);
    return length > scalar(0) ? vector(further / length) : normal;
  }
  /// Takes the turn `swung` of an update, a difference of unit vectors, within `took` [s].
  constexpr void hear(const vector& swung, scalar took) noexcept {
    const vector newer = swung / took, older = last_;
    const scalar square = Space::dot(newer, newer), most = scalar(4) * Space::dot(older, older);
    last_ = newer;
    still_ = !(Space::dot(newer, older) > scalar(0)) || !kernels::is_finite(square);
    if (still_) return;
    believed_ =
        square <= most ? newer : vector(newer * kernels::square_root(scalar(most / square)));
  }
  constexpr void stop() noexcept { still_ = true; }

 private:
  typename Space::coordinates believed_ = Space::zero(), last_ = Space::zero();  ///< [1/s]
  bool still_ = true;
};
template <class Space>
struct turning<Space, false> {
  [[nodiscard]] static constexpr bool still() noexcept { return true; }
  [[nodiscard]] static constexpr auto turned(auto normal, auto /*time*/) noexcept { return normal; }
  static constexpr void hear(auto /*swung*/, auto /*took*/) noexcept {}
  static constexpr void stop() noexcept {}
};

}  // namespace v0
}  // namespace passive_haptics
