// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One slot of a set of contacts: the newest surface of the environment (the target), and the own surface that is
// felt and follows it at a limited rate. The device's own motion is never limited:
//
//   update        the own depth d [m] is kept; the lag ℓ [m] becomes the difference          d = d_target − ℓ
//   appears       d is at most up to where λ = 0 beside the other contacts, or d before: what is repeated is no news
//   every tick    |ℓ| falls by ρ dt, or as fast as removes ℓ within t_c if that is more; the own normal turns
//                 with the target's as the device slides along it, and catches up with the turn of an update
//                 at turn_rate or, if that is faster, within the time between updates, t_c/8 to t_c
//   vanishes      ℓ grows by ρ dt and by any increase of d_target, until λ = 0
//
// The own normal first turns with the target's, on any surface, so fast sliding counts as no update. Over an edge,
// where the closest feature of a mesh changes, it turns as if the edge had the radius r, by |Δx|/r at most. A plane
// may be the tangent of a curved surface, so an update of it turns it by |Δx|/(10 r) if that is more. Where the turn
// along a curved surface is against the motion, the push is led by τ, as the depth is, which brakes a device that
// rolls in a bowl. Source: ours; docs/design/contacts.md.

#include <passive_haptics/base/no_unique_address.hpp>
#include <passive_haptics/contact/proxy.hpp>
#include <passive_haptics/normal_interpolation/carry.hpp>
#include <passive_haptics/normal_interpolation/turn_limited.hpp>
#include <passive_haptics/port/concepts.hpp>

#include <cstdint>
#include <utility>

namespace passive_haptics {
inline namespace v0 {

/// The rates at which the own surface follows its target. A target older than `stale_after` recedes as if it vanished.
struct pursuit {
  double speed = 0.05;       ///< ρ, least speed of a surface under the device [m/s]
  double catch_up = 0.04;    ///< t_c, time in which an update is followed [s]
  double turn_rate = 2.0;    ///< fastest turn of a normal [rad/s]
  double force_rate = 50.0;  ///< R, fastest change of the force by updates [N/s]
  double edge = 1e-3;        ///< r, the radius with which an edge of a mesh is felt [m]
  double stale_after =
      std::numeric_limits<double>::infinity();  ///< age at which a surface vanishes [s]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!detail::positive(speed)) return {"speed", speed, "finite and > 0 m/s"};
    if (!(catch_up > 0.0)) return {"catch_up", catch_up, "> 0 s"};
    if (!detail::positive(turn_rate)) return {"turn_rate", turn_rate, "finite and > 0 rad/s"};
    if (!(force_rate > 0.0)) return {"force_rate", force_rate, "> 0 N/s"};
    if (!detail::positive(edge)) return {"edge", edge, "finite and > 0 m"};
    if (!(stale_after > 0.0)) return {"stale_after", stale_after, "> 0 s"};
    return {};
  }
  template <class Space>
  class on;
};

template <class Space>
class pursuit::on {
 public:
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;

  constexpr explicit on(const pursuit& p) noexcept
      : speed_(detail::number<scalar>(p.speed)),
        catch_up_(detail::number<scalar>(p.catch_up)),
        force_rate_(detail::number<scalar>(p.force_rate)),
        stale_after_(detail::number<scalar>(p.stale_after)),
        per_rate_(detail::number<scalar>(1.0 / p.turn_rate)),
        edge_(detail::number<scalar>(p.edge)),
        turn_({.rate = p.turn_rate}) {}
  [[nodiscard]] constexpr pursuit parameters() const noexcept {
    return {.speed = static_cast<double>(speed_),
            .catch_up = static_cast<double>(catch_up_),
            .turn_rate = turn_.parameters().rate,
            .force_rate = static_cast<double>(force_rate_),
            .edge = static_cast<double>(edge_),
            .stale_after = static_cast<double>(stale_after_)};
  }

  /// The speed at which a lag ℓ falls, max(ρ, |ℓ|/t_c) [m/s].
  [[nodiscard]] constexpr scalar speed_for(scalar lag) const noexcept {
    return kernels::larger(speed_, kernels::magnitude(lag) / catch_up_);
  }
  /// The growth of ℓ of a contact that ends, in dt at an outward speed v: (ρ + max(−v, 0)) dt [m].
  [[nodiscard]] constexpr scalar receding(scalar v, scalar dt) const noexcept {
    return (speed_ + kernels::larger(-v, scalar(0))) * dt;
  }
  [[nodiscard]] constexpr vector turned(const vector& from, const vector& to,
                                        scalar dt) const noexcept {
    return turn_.step(from, to, dt);
  }
  /// How far a contact with λ [N] may move outwards in a tick for what the ledger holds [m].
  [[nodiscard]] constexpr scalar paid_way(scalar lambda, const auto& port) const noexcept {
    return port.paid_way(lambda, speed_ * catch_up_ / scalar(20), catch_up_ * scalar(1.25));
  }
  /// R dt, the largest change of the force by updates in dt [N].
  [[nodiscard]] constexpr scalar news(scalar dt) const noexcept { return force_rate_ * dt; }
  /// D = 0.2 s · ρ [m]: a surface is not evaluated until the device may be nearer to it than that.
  [[nodiscard]] constexpr scalar out_of_reach() const noexcept { return scalar(0.2) * speed_; }
  /// The factor ≥ 1 of the turn rate at which a normal reaches the goal of an update within the time `since` the last
  /// one [s], t_c/8 to t_c: one that goes on turning is late by no more, and noise is turned to as slowly as t_c/8.
  [[nodiscard]] constexpr scalar hurry_for(const vector& own, const vector& goal,
                                           scalar since) const noexcept {
    const scalar angle = Space::norm(vector(goal - own));
    const scalar time = kernels::smaller(kernels::larger(since, catch_up_ / scalar(8)), catch_up_);
    return kernels::larger(angle / time * per_rate_, scalar(1));
  }
  /// The time that a turn by `angle` [rad] takes at the largest rate [s].
  [[nodiscard]] constexpr scalar time_for(scalar angle) const noexcept { return angle * per_rate_; }
  [[nodiscard]] constexpr scalar edge() const noexcept { return edge_; }  ///< r [m]
  [[nodiscard]] constexpr bool stale(scalar age) const noexcept { return age > stale_after_; }

 private:
  scalar speed_, catch_up_, force_rate_, stale_after_, per_rate_, edge_;
  turn_limited::on<Space> turn_;
};

/// The own surface of one slot in a tick.
template <class Space>
struct felt_surface {
  typename Space::vector normal;   ///< own normal, unit, outward
  typename Space::vector push;     ///< −∇d; the normal, if depth is a distance
  typename Space::scalar depth{};  ///< own depth, ≤ 0 outside [m]
  bool chases = false;             ///< it has not reached the target yet

  /// True if all numbers, and the square of `push`, are finite.
  [[nodiscard]] constexpr bool is_finite() const noexcept {
    return kernels::is_finite(depth + Space::dot(push, push));
  }
};

/// A slot. press() sets its λ after each tick.
template <class Surface, class Space>
class pursued {
  /// The normal of a plane is the same everywhere, so only updates turn it.
  static constexpr bool has_edges = kind_of<Surface>() == surface_kind::faceted;
  static constexpr bool turns_along = kind_of<Surface>() != surface_kind::flat;
  static constexpr bool bends = turns_along && !has_edges;

 public:
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  using felt = felt_surface<Space>;
  static_assert(surface_for<Surface, Space>,
                "passive_haptics: the surface does not model surface_for: see port/concepts.hpp");

  /// Takes a new surface while the contact is at `here`, and was at `was` with the last one, or refuses it and keeps
  /// the last good one. A pressed contact keeps its force; any other one is treated as new.
  constexpr bool update(Surface next, const vector& was, const vector& here, const auto& rule,
                        const pursuit::on<Space>& pace) noexcept {
    owes_ = owes_ && taken();
    if (!next.prepare()) return false;
    const auto spring = rule.sampled(next.stiffness);
    if (pressed_ > scalar(0)) {
      const auto shown = next.at(here);
      const vector normal = shown.outward();
      const scalar own = target_.at(was).depth - lag_;
      const scalar lag = shown.depth - own * (spring_.stiffness * spring.compliance);
      if (!kernels::is_finite(lag) || !Space::is_finite(normal)) return false;
      lag_ = lag;
      speed_ = pace.speed_for(lag);
      hurry_ = pace.hurry_for(normal_, normal, age_);
      if constexpr (turns_along) shown_ = normal;
      state_ = state::there;
    } else {
      const bool known = state_ == state::there || state_ == state::expected;
      const scalar moved = known ? next.at(here).depth - target_.at(was).depth + lag_ : anything;
      expect(kernels::is_finite(moved) ? kernels::larger(moved, scalar(0)) : anything);
    }
    target_ = next;
    spring_ = spring;
    age_ = scalar(0);
    return true;
  }
  /// Notes that it was met at x, `since` [s] ago, if nothing presses it and its depth there is below `most` [m].
  constexpr bool stays_away(const vector& x, scalar most, scalar since,
                            const pursuit::on<Space>& pace) noexcept {
    const auto shown = target_.at(x);
    const vector normal = shown.outward();
    if (pressed_ > scalar(0) || !shown.covered() || !(shown.depth < most) ||
        !kernels::is_finite(shown.depth + Space::dot(normal, normal))) {
      return false;
    }
    lag_ = scalar(0);
    if constexpr (turns_along) place_ = x;
    meet({normal, normal, shown.depth}, shown.depth, pace);
    age_ = -since;
    return true;
  }
  /// Removes the surface; a pressed one recedes until λ = 0.
  constexpr void release() noexcept {
    owes_ = false;
    state_ = pressed_ > scalar(0) ? state::leaving : state::empty;
  }
  constexpr void reset() noexcept { *this = {}; }
  /// Recomputes the spring of the same surface for a new rule.
  constexpr void adopt(const auto& rule) noexcept {
    if (taken()) spring_ = rule.sampled(target_.stiffness);
  }

  [[nodiscard]] constexpr bool taken() const noexcept { return state_ != state::empty; }
  [[nodiscard]] constexpr bool stale() const noexcept { return state_ == state::stale; }
  /// Notes whether it presses, until owe_nothing(). owes(): it has, and its surface is still there, if farther off.
  constexpr void owe() noexcept { owes_ = owes_ || pressed_ > scalar(0); }
  constexpr void owe_nothing() noexcept { owes_ = false; }
  [[nodiscard]] constexpr bool owes() const noexcept { return owes_ && taken() && !is_ending(); }
  [[nodiscard]] constexpr const Surface& target() const noexcept { return target_; }
  [[nodiscard]] constexpr scalar lag() const noexcept { return lag_; }  ///< ℓ [m]
  /// The speed at which ℓ falls [m/s].
  [[nodiscard]] constexpr scalar speed() const noexcept { return speed_; }
  [[nodiscard]] constexpr scalar pressed() const noexcept { return pressed_; }  ///< λ [N]
  [[nodiscard]] constexpr vector normal() const noexcept { return normal_; }    ///< own normal
  constexpr void press(scalar lambda) noexcept { pressed_ = lambda; }
  [[nodiscard]] constexpr const sampled_spring<scalar>& spring() const noexcept { return spring_; }

  /// Ends a contact with λ = 0: the slot becomes empty, or expects the surface to cover the device again.
  constexpr bool vanish() noexcept {
    if (is_ending()) state_ = state::empty;
    if (state_ == state::there) expect(anything);
    return false;
  }
  /// Adds dt [s] to the age; a surface without updates for too long becomes stale.
  constexpr void grow_older(scalar dt, const pursuit::on<Space>& pace) noexcept {
    age_ += dt;
    if (state_ == state::there && pace.stale(age_)) state_ = state::stale;
  }

  /// Updates the slot for a tick with the device at x, and writes its own surface into `own`; returns false if it is
  /// empty or ends. `along`(n) is the outward speed of the device [m/s], `against` the force that an own surface which
  /// goes outwards does work against [N], `rests` is true if no contact pressed in the last tick, and `unfelt`(push) is the
  /// largest depth [m] at which a contact with that push has λ = 0 beside the others. `way`() is the distance that the
  /// contact has moved in the tick [m].
  [[nodiscard, gnu::always_inline]] constexpr bool follow(
      const vector& x, const auto& along, const auto& port, scalar against, bool rests,
      const auto& unfelt, const auto& way, const pursuit::on<Space>& pace, felt& own) noexcept {
    const scalar dt = port.dt;
    const auto shown = target_.at(x);
    own.normal = own.push = shown.outward();
    if constexpr (detail::says_push<decltype(shown)>) own.push = shown.push();
    own.depth = shown.depth;
    const bool ends = is_ending() || !shown.covered();
    if (!own.is_finite()) [[unlikely]] {
      return true;  // the caller checks is_finite() again
    }
    if (!(pressed_ > scalar(0))) {
      if (ends) return vanish();
      if (state_ == state::expected) {
        meet(own, unfelt(own.push), pace);
      } else if (rests && own.depth <= scalar(0)) {
        keep(scalar(0), own.normal);  // there is no force that could step
      }
    }
    scalar step = speed_ * dt;
    if (lag_ > scalar(0)) step = kernels::smaller(step, pace.paid_way(against, port));
    const scalar lag = ends ? lag_ + pace.receding(along(own.normal), dt) : shortened(lag_, step);
    const vector goal = own.normal;
    const vector before = normal_;
    if constexpr (bends) own.push = own.push + braking(goal, x, dt, pace);
    scalar most = turn_of_way(x, pace);
    const vector normal = along_the_target(before, goal, most, pace);
    if (!(normal == goal)) {
      own.chases = true;
      scalar time = hurry_ * dt;
      if constexpr (!turns_along) {
        time = kernels::larger(time, pace.time_for(way() / (scalar(10) * pace.edge())));
      }
      own.normal = pace.turned(normal, goal, time);
      if constexpr (has_edges) own.normal = pace.turned(own.normal, goal, pace.time_for(most));
      if (!(own.normal == goal)) own.push = carry<Space>(own.push, goal, own.normal);
    }
    normal_ = own.normal;
    own.depth -= lag;
    own.chases = own.chases || !(lag == scalar(0));
    lag_ = lag;
    return true;
  }

 private:
  enum class state : std::uint8_t { empty, expected, there, leaving, stale };

  /// True if it recedes because its surface was released or is stale.
  [[nodiscard]] constexpr bool is_ending() const noexcept {
    return state_ == state::leaving || state_ == state::stale;
  }

  /// |Δx|/r, the largest turn of a normal over an edge since the last tick [rad].
  [[nodiscard]] constexpr scalar turn_of_way(
      [[maybe_unused]] const vector& x, [[maybe_unused]] const pursuit::on<Space>& pace) noexcept {
    if constexpr (has_edges) {
      const scalar way = Space::norm(Space::difference(x, place_));
      place_ = x;
      return way / pace.edge();
    } else {
      return scalar(0);
    }
  }
  /// The turn of the push within τ, added as a lead as (S2) does for the depth, if it is against the motion: nothing
  /// else damps a device that rolls in a bowl. A turn of more than |Δx|/r is a crease, and gets no lead.
  [[nodiscard]] constexpr vector braking(const vector& goal, const vector& x, scalar dt,
                                         const pursuit::on<Space>& pace) noexcept {
    const vector turn = goal - vector(shown_), way = Space::difference(x, place_);
    place_ = x;
    const scalar r = pace.edge();
    const bool brakes = Space::dot(turn, way) < scalar(0) &&
                        Space::dot(turn, turn) * (r * r) <= Space::dot(way, way);
    return brakes ? vector(turn * (spring_.settling / dt)) : Space::zero();
  }
  /// The own normal, turned with the target's; over an edge by `most` [rad], of which the unused part remains for it.
  [[nodiscard]] constexpr vector along_the_target(
      const vector& before, [[maybe_unused]] const vector& goal, [[maybe_unused]] scalar& most,
      [[maybe_unused]] const pursuit::on<Space>& pace) noexcept {
    if constexpr (has_edges) {
      const vector then = std::exchange(shown_, goal);
      const vector there = pace.turned(then, goal, pace.time_for(most));
      most = kernels::larger(most - Space::norm(vector(goal - then)), scalar(0));
      return carry<Space>(before, then, there);
    } else if constexpr (turns_along) {
      const vector then = std::exchange(shown_, goal);
      return carry<Space>(before, then, goal);
    } else {
      return before;
    }
  }
  static constexpr scalar anything = kernels::largest<scalar>();  ///< any lag [m]
  constexpr void expect(scalar lag) noexcept {
    state_ = state::expected;
    lag_ = lag;
  }
  /// Begins a surface that has just appeared with at most the depth up to which λ = 0 for any speed (S2).
  constexpr void meet(const felt& here, scalar most, const pursuit::on<Space>& pace) noexcept {
    if (most > scalar(0)) most = most / scalar(inward_limit);
    keep(kernels::smaller(lag_, here.depth - kernels::smaller(here.depth, most)), here.normal);
    speed_ = pace.speed_for(scalar(0));
    hurry_ = scalar(1);
    state_ = state::there;
  }
  constexpr void keep(scalar lag, const vector& normal) noexcept {
    lag_ = lag;
    normal_ = normal;
    if constexpr (turns_along) shown_ = normal;
  }

  /// ℓ, moved towards zero by `step` [m].
  [[nodiscard]] static constexpr scalar shortened(scalar lag, scalar step) noexcept {
    if (kernels::magnitude(lag) <= step) return scalar(0);
    return lag < scalar(0) ? lag + step : lag - step;
  }

  struct nothing {};
  struct no_place {};
  using coordinates = typename Space::coordinates;

  Surface target_{};
  sampled_spring<scalar> spring_{};
  coordinates normal_{};  ///< own normal, unit
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS std::conditional_t<turns_along, coordinates, nothing>
      shown_{};  ///< the target's normal at the last position
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS std::conditional_t<turns_along, coordinates, no_place>
      place_{};       ///< last position of the device [m]
  scalar lag_{};      ///< ℓ [m]
  scalar speed_{};    ///< speed at which ℓ falls [m/s]
  scalar hurry_{1};   ///< factor of the turn rate of the normal
  scalar pressed_{};  ///< λ in the last tick [N]
  scalar age_{};      ///< time since the last update [s]
  state state_ = state::empty;
  bool owes_ = false;  ///< it has pressed since the news that are being made up for
};

}  // namespace v0
}  // namespace passive_haptics
