// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One type for every composition on the page, so that a menu can choose it while the page runs.
//
// By hand: a menu of all controllers, to be compared:
//     constexpr std::array menu{PAGE_CONTROLLER(wall_touch, "strict", "…", ph::local_model{…})};
//
// The expression that is compiled is also the text that the page offers to be pasted.

#include "settings.hpp"
#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/published/published.hpp>

#include <array>
#include <cstddef>
#include <new>
#include <type_traits>

namespace page {

namespace ph = passive_haptics;

/// What a tick says, whatever the composition.
template <class Space>
struct answer {
  typename Space::vector force;
  double ledger = 0;
  ph::event what = ph::event::nominal;
};

/// A composition that hears of `Surfaces` planes at once; copying it copies the state.
template <class S, int Surfaces, int Bytes = 3072>
class any_touch {
 public:
  using Space = S;
  using plane = ph::half_space<Space>;
  using news = std::array<plane, Surfaces>;
  using sample = ph::device_sample<Space>;

  template <class Touch>
  requires(!std::same_as<Touch, any_touch>) any_touch(const Touch& touch)
  noexcept  // NOLINT: the same
      : calls_(&table<Touch>) {
    static_assert(std::is_trivially_copy_constructible_v<Touch> && sizeof(Touch) <= sizeof(bytes_));
    ::new (static_cast<void*>(bytes_)) Touch(touch);
  }

  void hear(const news& all) noexcept { calls_->hear(bytes_, all); }
  [[nodiscard]] answer<Space> tick(const sample& now) noexcept { return calls_->tick(bytes_, now); }
  /// The planes that the controller itself works with at this moment.
  [[nodiscard]] news local() const noexcept { return calls_->local(bytes_); }
  [[nodiscard]] ph::parameter_fault check() const noexcept { return calls_->check(bytes_); }
  /// Before it is replaced: a mesh has room for so many fingers, and this one ends.
  void let_go() noexcept {
    if (calls_->let_go != nullptr) calls_->let_go(bytes_);
  }

 private:
  struct calls {
    void (*hear)(void*, const news&);
    answer<Space> (*tick)(void*, const sample&);
    news (*local)(const void*);
    ph::parameter_fault (*check)(const void*);
    void (*let_go)(void*);
  };

  template <class Touch>
  static void tell(Touch& touch, const news& all) noexcept {
    if constexpr (requires { touch.first.update(all[0]); }) {
      touch.first.update(all[0]);
      touch.second.update(all[1]);
    } else if constexpr (requires { touch.source().template contact<1>(); }) {
      touch.source().template contact<0>().update(all[0]);
      touch.source().template contact<1>().update(all[1]);
    } else if constexpr (requires { touch.update(all[0]); }) {
      touch.update(all[0]);
    } else {
      for (int i = 0; i < Surfaces; ++i) touch.source().update(i, all[static_cast<std::size_t>(i)]);
    }
  }
  template <class Touch>
  static news local_of(const Touch& touch) noexcept {
    if constexpr (requires { touch.first; }) {
      return {touch.first.local(), touch.second.local()};
    } else if constexpr (requires { touch.source().template contact<1>(); }) {
      return {touch.source().template contact<0>().local(),
              touch.source().template contact<1>().local()};
    } else if constexpr (requires { touch.local(); }) {
      return {touch.local()};
    } else {
      news all{};
      for (int i = 0; i < Surfaces; ++i) {
        all[static_cast<std::size_t>(i)] = touch.source().slot(i).target();
      }
      return all;
    }
  }
  template <class Touch>
  static answer<Space> answered(Touch& touch, const sample& now) noexcept {
    if constexpr (requires {
                    touch.first;
                  }) {  // a port each, which knows of its own force alone: added
      const ph::seconds dt{now.dt};
      const auto one = touch.first.tick(now.position, dt),
                 other = touch.second.tick(now.position, dt);
      return {one.force + other.force, static_cast<double>(one.energy + other.energy),
              ph::worse(one.what, other.what)};
    } else {
      const auto out = touch.tick(now);
      return {out.force, static_cast<double>(out.energy), out.what};
    }
  }
  template <class Touch>
  static ph::parameter_fault checked(const Touch& touch) noexcept {
    if constexpr (requires { touch.first; }) {
      const auto fault = touch.first.check();
      return fault ? fault : touch.second.check();
    } else {
      return touch.check();
    }
  }

  template <class Touch>
  [[nodiscard]] static constexpr auto end_of() noexcept -> void (*)(void*) {
    if constexpr (requires(Touch & touch) { touch.let_go(); }) {
      return [](void* t) { static_cast<Touch*>(t)->let_go(); };
    } else {
      return nullptr;
    }
  }
  template <class Touch>
  static constexpr calls table{
      [](void* t, const news& all) { tell(*static_cast<Touch*>(t), all); },
      [](void* t, const sample& now) { return answered(*static_cast<Touch*>(t), now); },
      [](const void* t) { return local_of(*static_cast<const Touch*>(t)); },
      [](const void* t) { return checked(*static_cast<const Touch*>(t)); }, end_of<Touch>()};

  const calls* calls_;
  alignas(std::max_align_t) std::byte bytes_[Bytes];
};

/// A bare spring of your own, behind a guard: make_guard has no surface.
template <class Guard, class Plane>
class guarded {
 public:
  static constexpr ph::guarantee passivity = Guard::passivity;

  constexpr explicit guarded(const Guard& guard) noexcept : guard_(guard) {}
  void update(const Plane& wall) noexcept { wall_ = wall; }
  [[nodiscard]] const Plane& local() const noexcept { return wall_; }
  [[nodiscard]] ph::parameter_fault check() const noexcept { return guard_.check(); }
  [[nodiscard]] auto tick(const auto& now) noexcept {
    const auto here = wall_.at(now.position);
    const double pressed = here.depth > 0 ? wall_.stiffness * here.depth : 0.0;
    return guard_.tick(now, wall_.normal * pressed);
  }

 private:
  Guard guard_;
  Plane wall_{};
};

/// A line of a menu.
template <class Touch>
struct controller {
  const char* name;
  const char* says;  ///< in a sentence, what it does and what that costs
  const char* text;  ///< the composition, as C++
  ph::guarantee promise;
  Touch (*make)(const premises&);
};

/// What a composition promises, its type says; two ports on one device promise nothing, whatever each says.
template <class Touch>
[[nodiscard]] constexpr ph::guarantee promise_of() noexcept {
  if constexpr (requires { Touch::passivity; }) return Touch::passivity;
  return ph::guarantee::none;
}

/// `Make` makes the composition.
template <class Touch, class Make>
[[nodiscard]] constexpr controller<Touch> line(const char* name, const char* says, const char* text,
                                               Make /*make*/) noexcept {
  return {name, says, text, promise_of<std::invoke_result_t<Make, const premises&>>(),
          [](const premises& told) { return Touch(Make{}(told)); }};
}

}  // namespace page

// Macros, since no template turns an expression into its text; the first one expands what the expression
// itself abbreviates. The names that it may use are those of `premises`.
#define PAGE_CONTROLLER(touch, name, says, ...) \
  PAGE_CONTROLLER_AS_IS(touch, name, says, __VA_ARGS__)
#define PAGE_CONTROLLER_AS_IS(touch, name, says, ...)                                             \
  page::line<touch>(name, says, #__VA_ARGS__, [](const page::premises& told) {                    \
    [[maybe_unused]] const auto [mass, damping, friction, quantum, motors, hand_force, roughness, \
                                 mode, tick] = told;                                              \
    return __VA_ARGS__;                                                                           \
  })

// A force of your own, given to a guard: the text is the guard's alone.
#define PAGE_GUARD(touch, name, says, ...) PAGE_GUARD_AS_IS(touch, name, says, __VA_ARGS__)
#define PAGE_GUARD_AS_IS(touch, name, says, ...)                                                  \
  page::line<touch>(name, says, #__VA_ARGS__, [](const page::premises& told) {                    \
    [[maybe_unused]] const auto [mass, damping, friction, quantum, motors, hand_force, roughness, \
                                 mode, tick] = told;                                              \
    const auto guard = __VA_ARGS__;                                                               \
    return page::guarded<std::remove_const_t<decltype(guard)>, touch::plane>(guard);              \
  })

// Abbreviations of what a reader sees in full, for PAGE_CONTROLLER.
#define DEVICE                                                                    \
  ph::exact_device {                                                              \
    .mass = mass, .damping = damping, .force_limit = motors, .longest_tick = tick \
  }
#define HAND                       \
  ph::known_hand {                 \
    .force = hand_force + friction \
  }
#define LEDGER         \
  ph::reduced_energy { \
    .damping = damping \
  }
#define LIMITS                             \
  ph::loop_limits {                        \
    .longest_tick = tick, .top_speed = 100 \
  }
#define REACHABLE                                     \
  ph::reachable_bound {                               \
    .mass = mass, .hand_force = hand_force + friction \
  }
#define HELD(bound)             \
  ph::bound_chain {             \
    bound, ph::actuator_limit { \
      .most = motors            \
    }                           \
  }
