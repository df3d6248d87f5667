// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One slot of a set of contacts: the newest surface that the world has told, and what is felt of it, which
// follows at a limited speed. The news are limited, the motion never:
//
//   new shape     the depth that is felt stays; the lag ℓ becomes the difference             d = d_target − ℓ
//   appears       no deeper than what the contacts that are there press anyway, so with λ = 0
//   every tick    |ℓ| falls by ρ dt, or by what makes up for the last news within t_c, if that is more; the
//                 own normal turns with the target's where the device moves along it, and makes up for what
//                 news have turned at a limited rate, or within t_c if that is more
//   vanishes      ℓ grows by ρ dt and by whatever the device goes deeper, until λ = 0
//
// The own normal is carried along with the target's first, whatever the surface: sliding is no news, however
// fast. Over an edge, where the closest feature of a mesh changes, it turns as if the edge were rounded by r:
// by |Δx|/r at most. Where a bend turns the push against the motion it is led by τ, as the depth is: that brakes
// what rolls in a bowl. Source: docs/design/contacts.md.

#include <passive_haptics/base/no_unique_address.hpp>
#include <passive_haptics/contact/proxy.hpp>
#include <passive_haptics/normal_interpolation/carry.hpp>
#include <passive_haptics/normal_interpolation/turn_limited.hpp>
#include <passive_haptics/port/concepts.hpp>

#include <cstdint>
#include <utility>

namespace passive_haptics {
inline namespace v0 {

/// How fast what is felt follows the world. What is older than `stale_after` recedes as what has vanished does.
struct pursuit {
  double speed = 0.05;       ///< ρ, of a surface under the finger, at least [m/s]
  double catch_up = 0.04;    ///< t_c, in which news of what is pressed are made up for [s]
  double turn_rate = 2.0;    ///< of a normal [rad/s]
  double force_rate = 50.0;  ///< R, of what is asked, where nothing but news changes it [N/s]
  double edge = 1e-3;        ///< r, by which an edge of a mesh feels rounded [m]
  double stale_after = std::numeric_limits<double>::infinity();  ///< without news it vanishes [s]

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

  /// How fast a lag ℓ is to be made up for [m/s].
  [[nodiscard]] constexpr scalar speed_for(scalar lag) const noexcept {
    return kernels::larger(speed_, kernels::magnitude(lag) / catch_up_);
  }
  /// What a contact that ends loses of its depth in dt, at an outward speed v [m].
  [[nodiscard]] constexpr scalar receding(scalar v, scalar dt) const noexcept {
    return (speed_ + kernels::larger(-v, scalar(0))) * dt;
  }
  [[nodiscard]] constexpr vector turned(const vector& from, const vector& to,
                                        scalar dt) const noexcept {
    return turn_.step(from, to, dt);
  }
  /// By how much news may change the force in dt [N].
  [[nodiscard]] constexpr scalar news(scalar dt) const noexcept { return force_rate_ * dt; }
  /// D: a surface is left alone until the device may come nearer to it than that [m].
  [[nodiscard]] constexpr scalar out_of_reach() const noexcept { return scalar(0.2) * speed_; }
  /// ≥ 1: how many times faster than the turn rate a normal must turn to make up for the last news within t_c.
  [[nodiscard]] constexpr scalar hurry_for(const vector& own, const vector& goal) const noexcept {
    const scalar angle = Space::norm(vector(goal - own));
    return kernels::larger(angle / catch_up_ * per_rate_, scalar(1));
  }
  /// `from`, turned towards `to` by an angle at most [rad].
  [[nodiscard]] constexpr vector turned_by(const vector& from, const vector& to,
                                           scalar angle) const noexcept {
    return turned(from, to, angle * per_rate_);
  }
  [[nodiscard]] constexpr scalar edge() const noexcept { return edge_; }  ///< r [m]
  [[nodiscard]] constexpr bool stale(scalar age) const noexcept { return age > stale_after_; }

 private:
  scalar speed_, catch_up_, force_rate_, stale_after_, per_rate_, edge_;
  turn_limited::on<Space> turn_;
};

/// What one slot has to say in a tick.
template <class Space>
struct felt_surface {
  typename Space::vector normal;   ///< of its own, unit, outward
  typename Space::vector push;     ///< −∇depth; the normal, for a distance
  typename Space::scalar depth{};  ///< of its own, ≤ 0 outside [m]
  bool chases = false;             ///< it is not yet what the world has told

  /// Numbers, all of them, and no push beyond what a square can say.
  [[nodiscard]] constexpr bool is_finite() const noexcept {
    return kernels::is_finite(depth + Space::dot(push, push));
  }
};

/// A slot. λ is told to it after each tick.
template <class Surface, class Space>
class pursued {
  /// A plane is the same everywhere, so it turns by news alone.
  static constexpr bool has_edges = kind_of<Surface>() == surface_kind::faceted;
  static constexpr bool turns_along = kind_of<Surface>() != surface_kind::flat;
  static constexpr bool bends = turns_along && !has_edges;

 public:
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  using felt = felt_surface<Space>;
  static_assert(surface_for<Surface, Space>,
                "passive_haptics: the surface does not model surface_for: see port/concepts.hpp");

  /// Takes a new surface while the contact is at `here`, and was at `was` with the last one, or refuses it
  /// and keeps the last good one. One that is pressed keeps the force it has; any other is met anew.
  constexpr bool update(Surface next, const vector& was, const vector& here, const auto& rule,
                        const pursuit::on<Space>& pace) noexcept {
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
      hurry_ = pace.hurry_for(normal_, normal);
      if constexpr (turns_along) shown_ = normal;
      state_ = state::there;
    } else {
      state_ = state::expected;
    }
    target_ = next;
    spring_ = spring;
    age_ = scalar(0);
    return true;
  }
  /// Nothing is there any more: what is pressed recedes until it is not.
  constexpr void release() noexcept {
    state_ = pressed_ > scalar(0) ? state::leaving : state::empty;
  }
  constexpr void reset() noexcept { *this = {}; }
  /// The same surface, as stiff as another rule lets it be.
  constexpr void adopt(const auto& rule) noexcept {
    if (taken()) spring_ = rule.sampled(target_.stiffness);
  }

  [[nodiscard]] constexpr bool taken() const noexcept { return state_ != state::empty; }
  [[nodiscard]] constexpr bool stale() const noexcept { return state_ == state::stale; }
  [[nodiscard]] constexpr const Surface& target() const noexcept { return target_; }
  [[nodiscard]] constexpr scalar lag() const noexcept { return lag_; }  ///< ℓ [m]
  /// With which it is made up for [m/s].
  [[nodiscard]] constexpr scalar speed() const noexcept { return speed_; }
  [[nodiscard]] constexpr scalar pressed() const noexcept { return pressed_; }  ///< λ [N]
  [[nodiscard]] constexpr vector normal() const noexcept { return normal_; }    ///< its own
  constexpr void press(scalar lambda) noexcept { pressed_ = lambda; }
  [[nodiscard]] constexpr const sampled_spring<scalar>& spring() const noexcept { return spring_; }

  /// What ends and is not pressed: gone, or met anew where it is covered again.
  constexpr bool vanish() noexcept {
    if (state_ == state::leaving || state_ == state::stale) state_ = state::empty;
    if (state_ == state::there) state_ = state::expected;
    return false;
  }
  /// Time goes by [s]: a surface without news for too long leaves.
  constexpr void grow_older(scalar dt, const pursuit::on<Space>& pace) noexcept {
    age_ += dt;
    if (state_ == state::there && pace.stale(age_)) state_ = state::stale;
  }

  /// Brings the slot to a tick in which the device is at x, and writes what is felt of its surface there into
  /// `own`; false if it is empty or ends. `along`(n) is the outward speed of the device [m/s], `rests` says
  /// that no contact pressed in the last tick, and `unfelt`(push) is the depth [m] that a contact pushing so
  /// may have before the contacts that are there leave it any force.
  [[nodiscard, gnu::always_inline]] constexpr bool follow(const vector& x, const auto& along,
                                                          scalar dt, bool rests, const auto& unfelt,
                                                          const pursuit::on<Space>& pace,
                                                          felt& own) noexcept {
    const auto shown = target_.at(x);
    own.normal = own.push = shown.outward();
    if constexpr (detail::says_push<decltype(shown)>) own.push = shown.push();
    own.depth = shown.depth;
    const bool ends = state_ == state::leaving || state_ == state::stale || !shown.covered();
    if (!own.is_finite()) [[unlikely]] {
      return true;  // the caller sees what has come of it
    }
    if (!(pressed_ > scalar(0))) {
      if (ends) return vanish();
      if (state_ == state::expected) {
        meet(own, unfelt(own.push), pace);
      } else if (rests && own.depth <= scalar(0)) {
        keep(scalar(0), own.normal);  // no contact is felt, so no force can step
      }
    }
    const scalar lag =
        ends ? lag_ + pace.receding(along(own.normal), dt) : shortened(lag_, speed_ * dt);
    const vector goal = own.normal;
    const vector before = normal_;
    if constexpr (bends) own.push = own.push + braking(goal, x, dt, pace);
    scalar most = turn_of_way(x, pace);
    const vector normal = along_the_target(before, goal, most, pace);
    if (!(normal == goal)) {
      own.chases = true;
      own.normal = pace.turned(normal, goal, hurry_ * dt);
      if constexpr (has_edges) own.normal = pace.turned_by(own.normal, goal, most);
      if (!(own.normal == goal)) own.push = carry<Space>(own.push, goal, own.normal);
    }
    if (!(before == own.normal)) normal_ = own.normal;
    own.depth -= lag;
    own.chases = own.chases || !(lag == scalar(0));
    lag_ = lag;
    return true;
  }

 private:
  enum class state : std::uint8_t { empty, expected, there, leaving, stale };

  /// What the way since the last tick lets a normal turn by over an edge [rad].
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
  /// How a push turns in τ from now, as (S2) leads the depth, where that brakes: nothing else damps a device that rolls
  /// in a bowl. What turns by more than the way over r is no bend but a crease.
  [[nodiscard]] constexpr vector braking(const vector& goal, const vector& x, scalar dt,
                                         const pursuit::on<Space>& pace) noexcept {
    const vector turn = goal - vector(shown_), way = Space::difference(x, place_);
    place_ = x;
    const scalar r = pace.edge();
    const bool brakes = Space::dot(turn, way) < scalar(0) &&
                        Space::dot(turn, turn) * (r * r) <= Space::dot(way, way);
    return brakes ? vector(turn * (spring_.settling / dt)) : Space::zero();
  }
  /// The own normal, carried along with the target's; over an edge by `most` [rad], of which what is not needed
  /// remains for what is left of the edge.
  [[nodiscard]] constexpr vector along_the_target(
      const vector& before, [[maybe_unused]] const vector& goal, [[maybe_unused]] scalar& most,
      [[maybe_unused]] const pursuit::on<Space>& pace) noexcept {
    if constexpr (has_edges) {
      const vector then = std::exchange(shown_, goal);
      const vector there = pace.turned_by(then, goal, most);
      most = kernels::larger(most - Space::norm(vector(goal - then)), scalar(0));
      return carry<Space>(before, then, there);
    } else if constexpr (turns_along) {
      const vector then = std::exchange(shown_, goal);
      return carry<Space>(before, then, goal);
    } else {
      return before;
    }
  }
  /// A surface that has just appeared is no deeper than it can be with λ = 0, whatever the speed (S2).
  constexpr void meet(const felt& here, scalar most, const pursuit::on<Space>& pace) noexcept {
    if (most > scalar(0)) most = most / scalar(inward_limit);
    keep(here.depth - kernels::smaller(here.depth, most), here.normal);
    speed_ = pace.speed_for(scalar(0));
    hurry_ = scalar(1);
    state_ = state::there;
  }
  constexpr void keep(scalar lag, const vector& normal) noexcept {
    lag_ = lag;
    normal_ = normal;
    if constexpr (turns_along) shown_ = normal;
  }

  /// ℓ, nearer to zero by a step [m].
  [[nodiscard]] static constexpr scalar shortened(scalar lag, scalar step) noexcept {
    if (kernels::magnitude(lag) <= step) return scalar(0);
    return lag < scalar(0) ? lag + step : lag - step;
  }

  struct nothing {};
  struct no_place {};
  using coordinates = typename Space::coordinates;

  Surface target_{};
  sampled_spring<scalar> spring_{};
  coordinates normal_{};  ///< its own, unit
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS std::conditional_t<turns_along, coordinates, nothing>
      shown_{};  ///< the target's, where the device was last
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS std::conditional_t<turns_along, coordinates, no_place>
      place_{};       ///< of the device, where it was last [m]
  scalar lag_{};      ///< ℓ [m]
  scalar speed_{};    ///< with which it is made up for [m/s]
  scalar hurry_{1};   ///< how much faster than the turn rate its normal turns
  scalar pressed_{};  ///< λ in the last tick [N]
  scalar age_{};      ///< since the last news [s]
  state state_ = state::empty;
};

}  // namespace v0
}  // namespace passive_haptics
