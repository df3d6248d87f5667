// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The surface that is felt of one contact between its updates (the own one), where the newest told one is at depth d
// with the normal n:
//
//     bends    d and n as the finger moves, for planes of what is curved (bending.hpp)
//     lags     own depth = d − ℓ + p: what an update moves is made up for, and what moves on goes on (lag.hpp)
//     turns    n by ω, the turn between updates (lag.hpp)
//
// A contact whose law does not ease its updates has surface_as_told, which does nothing of it.

#include <passive_haptics/base/no_unique_address.hpp>
#include <passive_haptics/contact/bending.hpp>
#include <passive_haptics/contact/lag.hpp>
#include <passive_haptics/port/concepts.hpp>

#include <type_traits>
#include <utility>

namespace passive_haptics {
inline namespace v0 {

template <class Space, class Constraint>
class own_surface {
 public:
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;

  /// Forgets the updates.
  constexpr void reset() noexcept {
    lag_ = {};
    bend_ = {};
  }
  /// Takes the longest tick [s]; an update may come just before or after a tick, so ages are compared with a slack of it.
  constexpr void adopt(scalar longest_tick) noexcept { slack_ = longest_tick; }
  constexpr void grow_older(scalar dt) noexcept { lag_.grow_older(dt); }

  /// Before an update: `target` was the newest surface up to the last tick, unless that has been `replaced` already.
  constexpr void expect(const Constraint& target, bool replaced) noexcept {
    if (!replaced) shown_ = target;
    told_ = {};
  }
  /// False for what is not finite, and if `published` for what is older than the last update.
  [[nodiscard]] constexpr bool accepts(const surface_motion<Space>& how, bool published,
                                       bool replaced) const noexcept {
    const bool younger = replaced ? how.age <= told_.age + slack_ : lag_.follows(how.age, slack_);
    return how.is_usable() && (younger || !published);
  }
  /// Takes the stated motion of the update.
  constexpr void state(const surface_motion<Space>& how) noexcept { told_ = how; }

  /// True while it has not reached the newest surface.
  [[nodiscard]] constexpr bool lags() const noexcept { return !lag_.settled() || !turn_.still(); }
  [[nodiscard]] constexpr bool is_curved() const noexcept {
    if constexpr (bends) return bend_.is_curved();
    return false;
  }
  /// The newest surface at x, which was told to be `told` there, as far as it is known to bend.
  [[nodiscard, gnu::always_inline]] constexpr auto newest(
      const auto& told, [[maybe_unused]] const vector& x) const noexcept {
    if constexpr (bends) {
      const auto bent = bend_.at(told.outward(), x);
      return bent_plane{told.depth - bent.sag, bent.normal};
    } else {
      return told;
    }
  }
  /// The own depth [m], for that in the newest surface.
  [[nodiscard, gnu::always_inline]] constexpr scalar depth(scalar newest) noexcept {
    if (lags()) [[unlikely]] {
      const scalar own = newest - lag_.offset();
      if (own > scalar(0) || newest > scalar(0)) return own;
      turn_.stop();
      lag_.let_go();  // neither is touched, so no force can step
    }
    return newest;
  }
  /// Takes the own normal on with the device's way [m] and by ω in a tick of dt [s], and the one that it turns towards.
  [[gnu::always_inline]] constexpr void take_on(vector& own, vector& goal,
                                                [[maybe_unused]] const auto& way,
                                                scalar dt) const noexcept {
    if constexpr (bends) own = bend_.onwards(own, way);
    goal = turn_.turned(goal, lag_.taken_on());
    if (lag_.taking_on()) own = turn_.turned(own, dt);
  }

  /// Moves on by a tick, outwards by what the port pays for.
  [[gnu::always_inline]] constexpr void follow(const auto& port) noexcept {
    if (!lag_.settled()) {
      const scalar force = Space::norm(vector(port.held));
      const scalar spent = Space::work(port.held, port.travel).joules;
      lag_.follow(port.dt, port.paid_way(force, scalar(1e-4), scalar(0.05), spent, scalar(1e-4)));
    }
    if (lag_.silent()) turn_.stop();
  }
  /// Takes an update, `told` at x, which counted by `weight` before, with the laws before and now; a pressed contact keeps
  /// its force, but not if a wall of one dimension is on the other side now.
  template <class Law>
  constexpr void hear(const Constraint& target, const auto& told, const vector& x, scalar weight,
                      const Law& before, const Law& law) noexcept {
    const auto was = newest(shown_.at(x), x);
    const vector was_outward = was.outward();
    const vector way = x - vector(std::exchange(heard_at_, x));
    const scalar took = lag_.between(told_.age);
    const bool turned_over =
        Space::dof == 1 && !(Space::dot(told.outward(), was_outward) > scalar(0));
    const bool known = weight > scalar(0) && was.covered() && !turned_over;
    if constexpr (bends) {
      if (known) {
        bend_.hear(shown_, target, x, way, lag_.since(), told_.age);
      } else {
        bend_ = {};
      }
    }
    const auto now = newest(told, x);
    const vector outward = now.outward();
    const scalar compliance = law.depth(scalar(1), scalar(0));
    scalar own = known ? was.depth - lag_.offset() : scalar(0);
    const bool as_stiff = before.depth(scalar(1), scalar(0)) == compliance;
    if (own > scalar(0) && !(as_stiff && weight == scalar(1)))
      own = law.depth(weight * before.force(own, scalar(0)), scalar(0));
    turn_.hear(known ? vector(outward - was_outward) : Space::zero(), took);
    const bool knows = told_.velocity.has_value();
    lag_.hear(own, now.depth, known ? now.depth - was.depth : scalar(0), compliance, law.pace(),
              {knows ? Space::dot(vector(*told_.velocity), outward) : scalar(0), told_.age, knows,
               Space::norm(way)});
    told_ = {};
  }

 private:
  static constexpr bool bends = Space::dof > 1 && requires(Constraint plane) {
    requires Constraint::kind == surface_kind::flat;
    plane.point;
    plane.normal;
  };
  struct bent_plane {
    scalar depth;  ///< [m]
    vector normal;
    [[nodiscard]] constexpr const vector& outward() const noexcept { return normal; }
    [[nodiscard]] static constexpr bool covered() noexcept { return true; }
  };
  struct flat {};

  lag<scalar> lag_;
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS turning<Space> turn_;
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS std::conditional_t<bends, bending<Space>, flat> bend_;
  Constraint shown_{};  ///< the newest surface of the last tick, to compare with an update
  surface_motion<Space>
      told_{};      ///< the stated motion of the newest one, until the next tick takes it
  scalar slack_{};  ///< the longest tick [s]
  typename Space::coordinates heard_at_ = Space::zero();  ///< x at the last update [m]
};

/// A surface that is felt as it was told.
template <class Space>
struct surface_as_told {
  using scalar = typename Space::scalar;
  static constexpr void reset() noexcept {}
  static constexpr void adopt(scalar /*longest_tick*/) noexcept {}
  static constexpr void grow_older(scalar /*dt*/) noexcept {}
  [[nodiscard]] static constexpr bool lags() noexcept { return false; }
  [[nodiscard]] static constexpr bool is_curved() noexcept { return false; }
  [[nodiscard]] static constexpr const auto& newest(const auto& told, const auto& /*x*/) noexcept {
    return told;
  }
  [[nodiscard]] static constexpr scalar depth(scalar newest) noexcept { return newest; }
};

}  // namespace v0
}  // namespace passive_haptics
