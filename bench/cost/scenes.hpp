// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The three scenes whose cost is measured, composed from the library and written by hand.
//
//   wall         1 DOF: fixed half-space, turn_at_once, spring, reduced energy, strict bound
//   half_space   3 DOF: fixed half-space, turn_at_once, damped spring, reduced energy, reachable bound
//   triangle     3 DOF: followed triangle, turn_limited, spring, reduced energy, thesis rule
//
// Both sides of a scene are plain values that tick, take a new target and can be copied.

#include "../by_hand/by_hand.hpp"
#include <passive_haptics/passive_haptics.hpp>

#include <array>
#include <limits>

namespace cost {

namespace ph = passive_haptics;

/// The numbers that are set at run time, in SI units.
struct settings {
  double damping = 0.03, loan = 0;
  double longest_tick = 1e-3, top_speed = 100, workspace = 2, watchdog = 1e-3;
  double stiffness = 1000;
  double mass = 0.1, hand_force = 5, force_limit = 9;
  double rate = 4, stale_after = 1e30, fade = 0.05;
  double quantum = 6e-5, friction = 0.2, presliding = 15e-6;
};

/// A triangle that the environment publishes.
struct surface {
  std::array<double, 3> a{}, b{}, c{};  ///< nodes [m]
  double stiffness = 1000;              ///< [N/m]
};

/// The result of a tick of either side.
template <class Scalar>
struct outcome {
  std::array<Scalar, 3> force{};
  Scalar depth{}, energy{};
  ph::event what{};
  bool limited{};
};

/// The types of the side written by hand, for float and for double.
template <class Scalar>
struct hand;
template <>
struct hand<float> {
  using wall = by_hand::in_float::wall_strict;
  using half_space = by_hand::in_float::half_space_reachable;
  using triangle = by_hand::in_float::triangle_thesis;
  using vector = by_hand::in_float::vec3;
  using loop = by_hand::in_float::loop;
};
template <>
struct hand<double> {
  using wall = by_hand::in_double::wall_strict;
  using half_space = by_hand::in_double::half_space_reachable;
  using triangle = by_hand::in_double::triangle_thesis;
  using vector = by_hand::in_double::vec3;
  using loop = by_hand::in_double::loop;
};

template <class Scalar>
[[nodiscard]] constexpr Scalar in(double x) {
  return static_cast<Scalar>(x);
}
/// A vector of either side, from three numbers.
template <class Vector, class Scalar>
[[nodiscard]] Vector three(const std::array<double, 3>& v) {
  return {in<Scalar>(v[0]), in<Scalar>(v[1]), in<Scalar>(v[2])};
}
template <class Scalar>
[[nodiscard]] auto triple(const std::array<double, 3>& v) {
  return three<typename hand<Scalar>::vector, Scalar>(v);
}
template <class Scalar>
[[nodiscard]] auto vector(const std::array<double, 3>& v) {
  return three<typename ph::space<Scalar, 3>::vector, Scalar>(v);
}

/// The ledger of all scenes.
[[nodiscard]] inline ph::reduced_energy observer(const settings& s) {
  return {.damping = s.damping, .loan = s.loan};
}
[[nodiscard]] inline ph::loop_limits limits(const settings& s) {
  return {.longest_tick = s.longest_tick,
          .top_speed = s.top_speed,
          .workspace = s.workspace,
          .watchdog = s.watchdog};
}
template <class Scalar>
[[nodiscard]] typename hand<Scalar>::loop loop(const settings& s) {
  return {in<Scalar>(s.longest_tick), in<Scalar>(s.top_speed), in<Scalar>(s.workspace),
          in<Scalar>(s.watchdog)};
}
/// The side written by hand checks no parameters: it is told whether they are good, and of a loan.
template <class State, class Model>
[[nodiscard]] State begun(State by_hand, const Model& composed, const settings& s) {
  by_hand.ledger.energy = in<typename Model::scalar>(s.loan);
  by_hand.device.sound = !composed.check();
  return by_hand;
}

template <class Scalar>
struct wall {
  using scalar = Scalar;
  using space = ph::space<Scalar, 1>;
  static constexpr const char* name = "1-DOF wall, strict bound";

  [[nodiscard]] static auto composed(const settings& s) {
    return ph::local_model{space{},
                           ph::fixed{ph::half_space<space>{0, 1, in<Scalar>(s.stiffness)}},
                           ph::turn_at_once{},
                           ph::spring{},
                           observer(s),
                           ph::strict_bound{},
                           limits(s)};
  }
  [[nodiscard]] static auto by_hand(const settings& s) {
    typename hand<Scalar>::wall w;
    wall_strict_start(&w, {0, 1, in<Scalar>(s.stiffness)}, in<Scalar>(s.damping), loop<Scalar>(s));
    return begun(w, composed(s), s);
  }
};

template <class Scalar>
struct half_space {
  using scalar = Scalar;
  using space = ph::space<Scalar, 3>;
  static constexpr const char* name = "3-DOF half-space, reachable bound";
  static constexpr std::array<double, 3> point{}, normal{0.1, -0.2, 1};

  [[nodiscard]] static auto composed(const settings& s) {
    return ph::local_model{
        space{},
        ph::fixed{ph::half_space<space>{vector<Scalar>(point), vector<Scalar>(normal),
                                        in<Scalar>(s.stiffness)}},
        ph::turn_at_once{},
        ph::damped_spring{.mass = s.mass, .force_limit = s.force_limit},
        observer(s),
        ph::reachable_bound{.mass = s.mass, .hand_force = s.hand_force},
        limits(s)};
  }
  [[nodiscard]] static auto by_hand(const settings& s) {
    typename hand<Scalar>::half_space w;
    const decltype(w.plane) plane{triple<Scalar>(point), triple<Scalar>(normal),
                                  in<Scalar>(s.stiffness)};
    half_space_reachable_start(&w, &plane, in<Scalar>(s.mass), in<Scalar>(s.force_limit),
                               in<Scalar>(s.damping),
                               {in<Scalar>(s.mass), in<Scalar>(s.hand_force), {}}, loop<Scalar>(s));
    return begun(w, composed(s), s);
  }
};

template <class Scalar>
struct triangle {
  using scalar = Scalar;
  using space = ph::space<Scalar, 3>;
  static constexpr const char* name = "3-DOF triangle, full thesis";

  [[nodiscard]] static auto composed(const settings& s) {
    return ph::local_model{
        space{},
        ph::followed<ph::triangle<space>>{{.stale_after = s.stale_after, .fade = s.fade}},
        ph::turn_limited{.rate = s.rate},
        ph::shaped{ph::spring{}, ph::thesis_rule{}},
        observer(s),
        ph::no_bound{},
        limits(s)};
  }
  [[nodiscard]] static auto by_hand(const settings& s) {
    typename hand<Scalar>::triangle w;
    triangle_thesis_start(&w, in<Scalar>(s.stale_after), in<Scalar>(s.fade), in<Scalar>(s.rate),
                          in<Scalar>(s.damping), loop<Scalar>(s));
    return begun(w, composed(s), s);
  }
};

/// A position for either side: State is a model, or a struct written by hand.
template <class Scene, class State>
[[nodiscard]] auto position_for(const std::array<double, 3>& x) {
  using S = typename Scene::scalar;
  if constexpr (requires { std::declval<typename State::pose>().orientation; }) {  // it turns, too
    using body = typename State::port_type;
    const auto way = vector<S>(x);
    return body::moved({}, body::join(way, way * S(3)));
  } else if constexpr (Scene::space::dof == 1) {
    return in<S>(x[0]);
  } else if constexpr (requires { typename State::port_type; }) {
    return vector<S>(x);
  } else {
    return triple<S>(x);
  }
}

/// A time for either side.
template <class Scene, class State>
[[nodiscard]] constexpr auto time_for(double dt) {
  const auto rounded = in<typename Scene::scalar>(dt);
  if constexpr (requires { typename State::port_type; }) {
    return ph::seconds{rounded};
  } else {
    return rounded;
  }
}

/// One tick of either side.
template <class State, class Position, class Time>
[[nodiscard, gnu::always_inline, gnu::flatten]] inline auto advance(State& state, const Position& x,
                                                                    Time dt) noexcept {
  if constexpr (requires { typename State::port_type; }) {
    return state.tick(x, dt);
  } else if constexpr (requires { wall_strict_tick(&state, x, dt); }) {
    return wall_strict_tick(&state, x, dt);
  } else if constexpr (requires { half_space_reachable_tick(&state, &x, dt); }) {
    return half_space_reachable_tick(&state, &x, dt);
  } else {
    return triangle_thesis_tick(&state, &x, dt);
  }
}

/// A new target for either side; a fixed scene has no use for it.
template <class State>
bool update_any(State& state, const surface& s) {
  if constexpr (requires { state.update(state.target()), state.target().c; }) {
    using S = typename State::scalar;
    return state.update({.a = vector<S>(s.a),
                         .b = vector<S>(s.b),
                         .c = vector<S>(s.c),
                         .stiffness = in<S>(s.stiffness)});
  } else if constexpr (requires { state.news; }) {
    using S = decltype(State::rate);
    const decltype(State::newest) next{triple<S>(s.a),
                                       triple<S>(s.b),
                                       triple<S>(s.c),
                                       in<S>(s.stiffness),
                                       std::numeric_limits<S>::max(),
                                       {}};
    return triangle_thesis_update(&state, &next);
  } else {
    return true;
  }
}

template <class Scalar, class Reading>
[[nodiscard]] outcome<Scalar> outcome_of(const Reading& r) {
  outcome<Scalar> o{.force = {},
                    .depth = r.depth,
                    .energy = r.energy,
                    .what = static_cast<ph::event>(r.what),
                    .limited = r.limited};
  if constexpr (requires { r.force.x; }) {
    o.force = {r.force.x, r.force.y, r.force.z};
  } else if constexpr (requires { r.force(0); }) {
    o.force = {r.force(0), r.force(1), r.force(2)};
  } else {
    o.force = {r.force};
  }
  return o;
}

}  // namespace cost
