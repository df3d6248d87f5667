// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The three scenes whose cost is measured, composed from the library and written by hand.
//
//   wall         1 DOF: rigid half-space, snap, spring, reduced energy, strict bound
//   half_space   3 DOF: rigid half-space, snap, damped spring, reduced energy, reachable bound
//   triangle     3 DOF: following triangle, rotate_limited, spring, reduced energy, thesis bound
//
// Both sides of a scene are plain values that tick, take a new target and can be copied.

#include "by_hand/by_hand.hpp"
#include <passive_haptics/passive_haptics.hpp>

#include <array>
#include <limits>

namespace cost {

namespace ph = passive_haptics;

/// What can be set at run time, in double; SI units.
struct settings {
  double damping = 0.03, cap = 1e30, reset_after = 1e30, loan = 0;
  double longest_tick = 1e-3, top_speed = 100;
  double stiffness = 1000;
  double mass = 0.1, hand_force = 5, force_limit = 9;
  double rate = 4, stale_after = 1e30, fade = 0.05;
};

/// A triangle that the environment publishes.
struct surface {
  std::array<double, 3> a{}, b{}, c{};  ///< nodes [m]
  double stiffness = 1000;              ///< [N/m]
};

/// What a tick returns, whichever side it is from.
template <class Scalar>
struct outcome {
  std::array<Scalar, 3> force{};
  Scalar depth{}, energy{};
  ph::event what{};
  bool limited{};
};

/// The types of the hand-written side for float and double.
template <class Scalar>
struct hand;
template <>
struct hand<float> {
  using wall = by_hand::in_float::wall;
  using half_space = by_hand::in_float::half_space;
  using triangle = by_hand::in_float::triangle;
  using triple = by_hand::in_float::triple;
};
template <>
struct hand<double> {
  using wall = by_hand::in_double::wall;
  using half_space = by_hand::in_double::half_space;
  using triangle = by_hand::in_double::triangle;
  using triple = by_hand::in_double::triple;
};

template <class Scalar>
[[nodiscard]] constexpr Scalar in(double x) {
  return static_cast<Scalar>(x);
}
template <class Scalar>
[[nodiscard]] typename hand<Scalar>::triple triple(const std::array<double, 3>& v) {
  return {in<Scalar>(v[0]), in<Scalar>(v[1]), in<Scalar>(v[2])};
}
template <class Scalar>
[[nodiscard]] typename ph::space<Scalar, 3>::vector vector(const std::array<double, 3>& v) {
  return {in<Scalar>(v[0]), in<Scalar>(v[1]), in<Scalar>(v[2])};
}

/// What both sides share of a scene's parameters.
template <class Space>
[[nodiscard]] auto observer(const settings& s) {
  using S = typename Space::scalar;
  ph::reduced_energy<Space> o{
      .damping = in<S>(s.damping), .cap = in<S>(s.cap), .reset_after = in<S>(s.reset_after)};
  o.energy = in<S>(s.loan);
  return o;
}
template <class Space>
[[nodiscard]] ph::loop_limits<Space> limits(const settings& s) {
  using S = typename Space::scalar;
  return {.longest_tick = in<S>(s.longest_tick), .top_speed = in<S>(s.top_speed)};
}
template <class Ledger>
[[nodiscard]] Ledger ledger(const settings& s, bool sound) {
  using S = decltype(Ledger::damping);
  return {.damping = in<S>(s.damping),
          .cap = in<S>(s.cap),
          .reset_after = in<S>(s.reset_after),
          .longest_tick = in<S>(s.longest_tick),
          .top_speed = in<S>(s.top_speed),
          .energy = in<S>(s.loan),
          .idle = 0,
          .blind = 0,
          .sound = sound,
          .seen = false};
}

template <class Scalar>
struct wall {
  using scalar = Scalar;
  using space = ph::space<Scalar, 1>;
  static constexpr const char* name = "1-DOF wall, strict bound";

  [[nodiscard]] static auto composed(const settings& s) {
    return ph::local_model{space{},
                           ph::rigid{ph::half_space<space>{0, 1, in<Scalar>(s.stiffness)}},
                           ph::snap<space>{},
                           ph::spring<space>{},
                           observer<space>(s),
                           ph::strict_bound<space>{},
                           limits<space>(s)};
  }
  [[nodiscard]] static auto by_hand(const settings& s) {
    using energy = decltype(hand<Scalar>::wall::energy);
    return typename hand<Scalar>::wall{.energy = ledger<energy>(s, !composed(s).check()),
                                       .surface = 0,
                                       .outward = 1,
                                       .stiffness = in<Scalar>(s.stiffness),
                                       .position = 0,
                                       .held = 0};
  }
};

template <class Scalar>
struct half_space {
  using scalar = Scalar;
  using space = ph::space<Scalar, 3>;
  static constexpr const char* name = "3-DOF half-space, reachable bound";

  [[nodiscard]] static auto composed(const settings& s) {
    return ph::local_model{
        space{},
        ph::rigid{ph::half_space<space>{vector<Scalar>({}), vector<Scalar>({0.1, -0.2, 1}),
                                        in<Scalar>(s.stiffness)}},
        ph::snap<space>{},
        ph::damped_spring<space>{.mass = in<Scalar>(s.mass),
                                 .force_limit = in<Scalar>(s.force_limit)},
        observer<space>(s),
        ph::reachable_bound<space>{.mass = in<Scalar>(s.mass),
                                   .hand_force = in<Scalar>(s.hand_force)},
        limits<space>(s)};
  }
  [[nodiscard]] static auto by_hand(const settings& s) {
    using energy = decltype(hand<Scalar>::half_space::energy);
    const auto model = composed(s);
    const auto n = model.target().normal;
    return typename hand<Scalar>::half_space{.energy = ledger<energy>(s, !model.check()),
                                             .surface = {0, 0, 0},
                                             .outward = {n[0], n[1], n[2]},
                                             .stiffness = model.contact().stiffness,
                                             .resistance = model.contact().damping,
                                             .damping_ratio = model.contact().damping_ratio,
                                             .force_limit = in<Scalar>(s.force_limit),
                                             .contact_mass = in<Scalar>(s.mass),
                                             .mass = in<Scalar>(s.mass),
                                             .hand_force = in<Scalar>(s.hand_force),
                                             .position = {0, 0, 0},
                                             .held = {0, 0, 0}};
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
        ph::following<ph::triangle<space>>{
            {.stale_after = in<Scalar>(s.stale_after), .fade = in<Scalar>(s.fade)}},
        ph::rotate_limited<space>{.rate = in<Scalar>(s.rate)},
        ph::spring<space>{},
        observer<space>(s),
        ph::thesis_bound<space>{},
        limits<space>(s)};
  }
  [[nodiscard]] static auto by_hand(const settings& s) {
    using energy = decltype(hand<Scalar>::triangle::energy);
    typename hand<Scalar>::triangle w{};
    w.energy = ledger<energy>(s, !composed(s).check());
    w.rate = in<Scalar>(s.rate);
    w.stale_after = in<Scalar>(s.stale_after);
    w.fade = in<Scalar>(s.fade);
    w.together = true;
    return w;
  }
};

/// A position for either side: State is a model, or a struct written by hand.
template <class Scene, class State>
[[nodiscard]] auto position_for(const std::array<double, 3>& x) {
  using S = typename Scene::scalar;
  if constexpr (Scene::space::dof == 1) {
    return in<S>(x[0]);
  } else if constexpr (requires(State s) { s.target().depth(vector<S>(x)); }) {
    return vector<S>(x);
  } else {
    return triple<S>(x);
  }
}

/// One tick of either side.
template <class State, class Position, class Scalar>
[[nodiscard]] auto advance(State& state, const Position& x, Scalar dt) noexcept {
  if constexpr (requires { state.tick(x, dt); }) {
    return state.tick(x, dt);
  } else {
    return tick(state, x, dt);
  }
}

/// A new target for either side; a rigid scene has no use for it.
template <class State>
bool retarget_any(State& state, const surface& s) {
  if constexpr (requires { state.retarget(state.target()), state.target().c; }) {
    using S = typename State::scalar;
    return state.retarget({.a = vector<S>(s.a),
                           .b = vector<S>(s.b),
                           .c = vector<S>(s.c),
                           .stiffness = in<S>(s.stiffness)});
  } else if constexpr (requires { state.published; }) {
    using S = decltype(State::rate);
    return retarget(state, {.a = triple<S>(s.a),
                            .b = triple<S>(s.b),
                            .c = triple<S>(s.c),
                            .stiffness = in<S>(s.stiffness),
                            .thickness = std::numeric_limits<S>::max(),
                            .normal = {}});
  } else {
    return true;
  }
}

template <class Scalar, class Reading>
[[nodiscard]] outcome<Scalar> outcome_of(const Reading& r) {
  outcome<Scalar> o{
      .force = {}, .depth = r.depth, .energy = r.energy, .what = r.what, .limited = r.limited};
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
