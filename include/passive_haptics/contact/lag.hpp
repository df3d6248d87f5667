// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How what is felt of one surface follows its news, so that they do not step. The news are limited, the
// motion never: with d the depth of the device in the newest surface,
//
//     own depth = d − ℓ + p
//     news       own depth stays as it is, so the lag ℓ takes up the jump, and p = 0
//     each tick  |ℓ| falls by ρ dt,   ρ = 3|ℓ₀|/P, within [R_least, R_most]/K; and, if that takes no longer than
//                0.8 s, so that ρ and u together are no faster than max(R_usual/K, 4/3 |u|)
//                p grows by u dt for the time P, but not longer than `ahead`; where no news have come for twice
//                as long, the surface may have stopped, and p is made up for as ℓ is
//                the own normal turns by ω dt as long as p grows, and towards the newest one, so turned, at its rate
//
// ℓ₀ is the lag [m] at the last news, P the time [s] that news usually take, u [m/s] and ω [1/s] how fast they move
// and turn the surface where the device is: as fast as the last ones, but not more than twice as fast as those before,
// and not at all if those went the other way. So a surface that jumps once is not thrown further, and one that goes on
// is not late. Source: docs/design/contacts.md § 6.

#include <passive_haptics/base/parameter.hpp>

#include <cstdint>
#include <optional>
#include <utility>

namespace passive_haptics {
inline namespace v0 {

/// How fast what is felt catches up with news of a surface that is pressed.
struct news_pace {
  double least_force_rate = 5.0;   ///< R_least, of what is made up for [N/s]
  double usual_force_rate = 19.5;  ///< R_usual: 0.0195 N a tick are not felt [N/s]
  double most_force_rate = 50.0;   ///< R_most [N/s]
  double longest_interval = 0.3;   ///< what counts as a time between news, at most [s]
  double ahead = 0.08;             ///< for which u is believed after the last news, at most [s]
  double oldest = 0.1;             ///< age of news that is made up for by u, at most [s]

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
    if (!detail::positive(longest_interval)) {
      return {"longest_interval", longest_interval, "finite and > 0 s"};
    }
    if (!detail::not_negative(ahead)) return {"ahead", ahead, "finite and ≥ 0 s"};
    if (!detail::not_negative(oldest)) return {"oldest", oldest, "finite and ≥ 0 s"};
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
        longest_(detail::number<Scalar>(p.longest_interval)),
        ahead_(detail::number<Scalar>(p.ahead)),
        oldest_(detail::number<Scalar>(p.oldest)) {}
  [[nodiscard]] constexpr news_pace parameters() const noexcept {
    return {.least_force_rate = static_cast<double>(least_),
            .usual_force_rate = static_cast<double>(usual_),
            .most_force_rate = static_cast<double>(most_),
            .longest_interval = static_cast<double>(longest_),
            .ahead = static_cast<double>(ahead_),
            .oldest = static_cast<double>(oldest_)};
  }

  /// ρ for a lag [m], the time between news [s], u [m/s] and 1/K [m/N].
  [[nodiscard]] constexpr Scalar speed_for(Scalar lag, Scalar interval, Scalar u,
                                           Scalar compliance) const noexcept {
    const Scalar size = kernels::magnitude(lag), same_way = lag < Scalar(0) ? -u : u;
    const Scalar its_own = kernels::magnitude(u) * Scalar(4) / Scalar(3);
    const Scalar calm =
        kernels::larger(usual_ * compliance, its_own) - kernels::larger(same_way, Scalar(0));
    const Scalar wanted =
        kernels::smaller(Scalar(3) * size / interval, kernels::larger(calm, size / Scalar(0.8)));
    return kernels::clamped(wanted, least_ * compliance, most_ * compliance);
  }
  [[nodiscard]] constexpr Scalar usual() const noexcept { return usual_; }      ///< R_usual [N/s]
  [[nodiscard]] constexpr Scalar most() const noexcept { return most_; }        ///< R_most [N/s]
  [[nodiscard]] constexpr Scalar longest() const noexcept { return longest_; }  ///< [s]
  [[nodiscard]] constexpr Scalar ahead() const noexcept { return ahead_; }      ///< [s]
  [[nodiscard]] constexpr Scalar oldest() const noexcept { return oldest_; }    ///< [s]

 private:
  Scalar least_, usual_, most_, longest_, ahead_, oldest_;
};

/// What news may say of a surface beside where it is.
template <class Space>
struct surface_motion {
  /// How fast it moves by itself where it is told [m/s]; not how it gives way, which answers to the force.
  std::optional<typename Space::coordinates> velocity{};
  /// How long ago it was so [s]. It is made up for where the velocity is told, too.
  typename Space::scalar age{};

  [[nodiscard]] constexpr bool is_usable() const noexcept {
    return age >= typename Space::scalar(0) && kernels::is_finite(age) &&
           (!velocity || Space::is_finite(*velocity));
  }
};

/// ℓ, p, and what is known of the news.
template <class Scalar>
class lag {
 public:
  /// ℓ − p [m]: how much less deep the own surface is than the newest.
  [[nodiscard]] constexpr Scalar offset() const noexcept { return behind_ - lead_; }
  /// How old the last news were when they were told, as far as that is made up for [s].
  [[nodiscard]] constexpr Scalar age() const noexcept { return age_; }
  /// Nothing is left to make up for, and nothing moves.
  [[nodiscard]] constexpr bool settled() const noexcept { return settled_; }

  /// For how long the last news have been taken on with since they were made [s], and whether they still are; 0 where it may have stopped.
  [[nodiscard]] constexpr Scalar taken_on() const noexcept {
    return silent() ? Scalar(0) : age_ + kernels::smaller(since_, ahead_);
  }
  [[nodiscard]] constexpr bool taking_on() const noexcept { return since_ < ahead_; }
  /// No news when there should have been some.
  [[nodiscard]] constexpr bool silent() const noexcept { return since_ > Scalar(2) * ahead_; }
  /// Since the last news [s].
  [[nodiscard]] constexpr Scalar since() const noexcept { return since_; }

  /// Time goes by [s].
  constexpr void grow_older(Scalar dt) noexcept { since_ += dt; }
  /// And what is not settled follows.
  constexpr void follow(Scalar dt) noexcept {
    const Scalar step = speed_ * dt;
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
    settled_ = behind_ == Scalar(0) && goes_on_ == Scalar(0);
  }
  /// What the news that are told now say of their motion there.
  struct account {
    Scalar speed{};      ///< outwards, of its own [m/s]
    Scalar age{};        ///< [s]
    bool knows = false;  ///< the speed
  };
  /// News so old [s] are younger than the last ones, or not older than `slack`.
  [[nodiscard]] constexpr bool follows(Scalar age, Scalar slack) const noexcept {
    return age <= since_ + told_age_ + slack;
  }
  /// Between the instants of the last news and of these, which are so old [s].
  [[nodiscard]] constexpr Scalar between(Scalar age) const noexcept {
    return kernels::larger(kernels::larger(since_ + told_age_ - age, since_ / Scalar(2)),
                           kernels::rounding<Scalar>());
  }
  /// News: the device is `now` deep in them, they have moved by `moved` where it is, and it was `own` deep in
  /// what was felt, or is to begin so deep; 0 for what was not felt [m].
  constexpr void hear(Scalar own, Scalar now, Scalar moved, Scalar compliance,
                      const news_pace::at<Scalar>& pace, const account& told = {}) noexcept {
    const Scalar speed = moved / between(told.age);
    expect(speed, compliance, pace, told);
    const Scalar interval =
        kernels::smaller(kernels::larger(since_, kernels::rounding<Scalar>()), pace.longest());
    // Longer ones count at once, shorter ones little by little: a network that drops some stays smooth.
    if (!(usual_ > Scalar(0))) usual_ = pace.longest();
    usual_ = kernels::larger(interval, usual_ + (interval - usual_) / Scalar(8));
    ahead_ = kernels::smaller(usual_, pace.ahead());
    since_ = Scalar(0);
    told_age_ = told.age;
    take_on(pace);
    const Scalar here = now + lead_;
    behind_ =
        own > Scalar(0) || here > Scalar(0) ? here - kernels::larger(own, Scalar(0)) : Scalar(0);
    if (!kernels::is_finite(behind_ + goes_on_)) {
      behind_ = lead_ = goes_on_ = gains_ = last_speed_ = its_ = told_speed_ = Scalar(0);
    }
    speed_ = pace.speed_for(behind_, usual_, goes_on_, compliance);
    settled_ = behind_ == Scalar(0) && lead_ == Scalar(0) && goes_on_ == Scalar(0);
  }
  /// Neither the own surface nor the newest is touched: no force can step.
  constexpr void let_go() noexcept {
    behind_ = lead_ = goes_on_ = gains_ = Scalar(0);
    settled_ = true;
  }

 private:
  /// u, u̇ and what they rest on, from the speed at which the news have moved.
  constexpr void expect(Scalar speed, Scalar compliance, const news_pace::at<Scalar>& pace,
                        const account& told) noexcept {
    const Scalar moved = kernels::magnitude(speed), calm = pace.usual() * compliance;
    const bool worse =
        told_speed_ != Scalar(0) && !(kernels::magnitude(speed - told_speed_) <= moved);
    doubts_ = worse ? static_cast<std::uint8_t>(doubts_ < 2 ? doubts_ + 1 : 2) : std::uint8_t{0};
    const Scalar before = its_, most = kernels::larger(calm, Scalar(2) * moved);
    its_ = told.knows ? kernels::clamped(told.speed, -most, most) : Scalar(0);
    told_speed_ = its_;
    fastest_ = kernels::larger(kernels::magnitude(its_), kernels::magnitude(before));
    const bool knew = std::exchange(knows_, told.knows) && told.knows;
    const Scalar rest = speed - (knew ? (its_ + before) / Scalar(2) : its_);
    Scalar of_the_rest = believed(rest, last_speed_);
    last_speed_ = rest;
    gains_ = knew ? (its_ - before) / between(told.age) : Scalar(0);
    if (knows_ && doubts_ >= 2) its_ = gains_ = of_the_rest = Scalar(0);
    if (knows_) of_the_rest = kernels::clamped(of_the_rest, -calm, calm);
    goes_on_ = its_ + of_the_rest;
  }
  /// What is told is taken to the present, and u with it; u̇ changes u by no more than the told speeds are.
  constexpr void take_on(const news_pace::at<Scalar>& pace) noexcept {
    age_ = knows_ ? kernels::smaller(told_age_, pace.oldest()) : Scalar(0);
    const Scalar most = fastest_ / (age_ + ahead_);
    gains_ = kernels::clamped(gains_, -most, most);
    lead_ = (its_ + gains_ * age_ / Scalar(2)) * age_;
    goes_on_ += gains_ * age_;
  }
  /// The newer of two speeds, but not more than twice the older; 0 if they go opposite ways.
  [[nodiscard]] static constexpr Scalar believed(Scalar newer, Scalar older) noexcept {
    if (!(newer * older > Scalar(0))) return Scalar(0);
    const Scalar most = Scalar(2) * older;
    return kernels::magnitude(newer) < kernels::magnitude(most) ? newer : most;
  }

  Scalar behind_{}, lead_{};         ///< ℓ, p [m]
  Scalar speed_{};                   ///< ρ [m/s]
  Scalar goes_on_{}, last_speed_{};  ///< u, and the speed of the last news alone [m/s]
  Scalar usual_{}, ahead_{};         ///< P, and for how long p grows [s]
  Scalar since_{};                   ///< since the last news [s]
  Scalar age_{}, told_age_{};        ///< of the last news, made up for and told [s]
  Scalar gains_{};                   ///< u̇ [m/s²]
  Scalar its_{}, fastest_{};         ///< told: the last speed believed, the larger of two [m/s]
  Scalar told_speed_{};              ///< the last, believed or not [m/s]
  std::uint8_t doubts_ = 0;          ///< how often in a row that was worse than none
  bool knows_ = false;               ///< the last news told their speed
  bool settled_ = true;
};

/// ω, the turn of a normal that two news in a row have shown: the newer, but not more than twice the older, and none
/// where they turn opposite ways. In one dimension nothing turns.
template <class Space, bool = (Space::dof > 1)>
class turning {
 public:
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;

  [[nodiscard]] constexpr bool still() const noexcept { return still_; }
  /// A unit normal, turned for a time [s].
  [[nodiscard]] constexpr vector turned(const vector& normal, scalar time) const noexcept {
    if (still()) return normal;
    const vector further = normal + vector(believed_) * time;
    const scalar length = Space::norm(further);
    return length > scalar(0) ? vector(further / length) : normal;
  }
  /// News have turned the normal by `swung`, a difference of unit vectors, within `took` [s].
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
class turning<Space, false> {
  using scalar = typename Space::scalar;

 public:
  [[nodiscard]] static constexpr bool still() noexcept { return true; }
  [[nodiscard]] static constexpr scalar turned(scalar normal, scalar /*time*/) noexcept {
    return normal;
  }
  static constexpr void hear(scalar /*swung*/, scalar /*took*/) noexcept {}
  static constexpr void stop() noexcept {}
};

}  // namespace v0
}  // namespace passive_haptics
