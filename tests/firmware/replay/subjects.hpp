// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Each scene twice, composed and by hand, behind one shape:
//   scene, author   names                             update(surface)    news from the environment
//   call            the tick, a plain function        argument(sample)   its position

#include "../by_hand/by_hand.h"
#include "../composed/scenes_with_vectors.hpp"
#include "parameters.hpp"
#include "recording.hpp"

namespace replay {

namespace ph = passive_haptics;
using given = parameters<real>;

inline real real_of(bits b) {
  return number<real>(b);
}

template <class Vector, int Dof>
[[nodiscard]] Vector vector_of(const bits (&b)[3]) {
  if constexpr (Dof == 1) {
    return real_of(b[0]);
  } else if constexpr (Dof == 2) {
    return {real_of(b[0]), real_of(b[1])};
  } else {
    return {real_of(b[0]), real_of(b[1]), real_of(b[2])};
  }
}

// ---------------------------------------------------------------------------------- composed

inline constexpr ph::loop_limits limits{.longest_tick = given::longest_tick,
                                        .top_speed = given::top_speed,
                                        .workspace = given::workspace,
                                        .watchdog = given::watchdog};
inline constexpr ph::reduced_energy ledger{.damping = given::damping};
inline constexpr ph::reachable_bound reach{.mass = given::mass, .hand_force = given::hand_force};
inline constexpr ph::turn_limited turning{.rate = given::rate};
inline constexpr ph::damped_spring soft{.mass = given::mass};
template <class Constraint>
[[nodiscard]] ph::followed<Constraint> followed() {
  return ph::followed<Constraint>{{.stale_after = given::stale_after, .fade = given::fade}};
}

template <class Model, class Function, Function* Tick>
struct composed_subject {
  using space = typename Model::space_type;
  using constraint = typename Model::constraint_type;
  static constexpr const char* author = "composed";
  static constexpr int dof = space::dof;
  static constexpr Function* call = Tick;
  using position = typename space::vector;

  Model model;

  bool update(const surface& s) {
    if constexpr (requires(Model m, constraint c) { m.update(c); }) {
      constraint c{};
      if constexpr (requires { c.thickness; }) {
        c.a = vector_of<position, dof>(s.a);
        c.b = vector_of<position, dof>(s.b);
        c.c = vector_of<position, dof>(s.c);
      } else {
        c.point = vector_of<position, dof>(s.a);
        c.normal = vector_of<position, dof>(s.b);
      }
      c.stiffness = real_of(s.stiffness);
      return model.update(c);
    } else {
      return false;
    }
  }
};

struct composed_wall_trusted
    : composed_subject<composed::wall_trusted, decltype(composed::wall_trusted_tick),
                       &composed::wall_trusted_tick> {
  static constexpr const char* scene = "wall_trusted";
  composed_wall_trusted()
      : composed_subject{{space{},
                          ph::fixed{ph::half_space<space>{0, 1, given::wall_stiffness}},
                          {},
                          {},
                          ledger,
                          {},
                          ph::trusted_loop_limits<>{.longest_tick = given::longest_tick}}} {}
};
struct composed_wall_strict
    : composed_subject<composed::wall_strict, decltype(composed::wall_strict_tick),
                       &composed::wall_strict_tick> {
  static constexpr const char* scene = "wall_strict";
  composed_wall_strict()
      : composed_subject{{space{},
                          ph::fixed{ph::half_space<space>{0, 1, given::wall_stiffness}},
                          {},
                          {},
                          ledger,
                          {},
                          limits}} {}
};
struct composed_wall_reachable
    : composed_subject<composed::wall_reachable, decltype(composed::wall_reachable_tick),
                       &composed::wall_reachable_tick> {
  static constexpr const char* scene = "wall_reachable";
  composed_wall_reachable()
      : composed_subject{{space{}, followed<constraint>(), {}, soft, ledger, reach, limits}} {}
};
struct composed_plane_strict
    : composed_subject<composed::plane_strict, decltype(composed::plane_strict_tick),
                       &composed::plane_strict_tick> {
  static constexpr const char* scene = "plane_strict";
  composed_plane_strict()
      : composed_subject{{space{}, followed<constraint>(), turning, {}, ledger, {}, limits}} {}
};
struct composed_plane_reachable
    : composed_subject<composed::plane_reachable, decltype(composed::plane_reachable_tick),
                       &composed::plane_reachable_tick> {
  static constexpr const char* scene = "plane_reachable";
  composed_plane_reachable()
      : composed_subject{{space{}, followed<constraint>(), turning, soft, ledger, reach, limits}} {}
};
struct composed_triangle_thesis
    : composed_subject<composed::triangle_thesis, decltype(composed::triangle_thesis_tick),
                       &composed::triangle_thesis_tick> {
  static constexpr const char* scene = "triangle_thesis";
  composed_triangle_thesis()
      : composed_subject{{space{}, followed<constraint>(), turning, {}, ledger, {}, limits}} {}
};

// ----------------------------------------------------------------------------------- by hand

inline constexpr ::loop by_hand_loop{given::longest_tick, given::top_speed, given::workspace,
                                     given::watchdog};
inline constexpr ::reach by_hand_reach{given::mass, given::hand_force, 0};

template <class State, int Dof, class Position, class Function, Function* Tick>
struct by_hand_subject {
  static constexpr const char* author = "by_hand";
  static constexpr int dof = Dof;
  static constexpr Function* call = Tick;
  using position = Position;

  State model;
};

template <class Plane, class Vector, int Dof>
[[nodiscard]] Plane plane_of(const surface& s) {
  return {vector_of<Vector, Dof>(s.a), vector_of<Vector, Dof>(s.b), real_of(s.stiffness)};
}

struct by_hand_wall_trusted
    : by_hand_subject<::wall_trusted, 1, real, decltype(by_hand_wall_trusted_tick),
                      &by_hand_wall_trusted_tick> {
  static constexpr const char* scene = "wall_trusted";
  by_hand_wall_trusted() {
    wall_trusted_start(&model, {0, 1, given::wall_stiffness}, given::damping, given::longest_tick);
  }
  bool update(const surface&) { return false; }
};
struct by_hand_wall_strict
    : by_hand_subject<::wall_strict, 1, real, decltype(by_hand_wall_strict_tick),
                      &by_hand_wall_strict_tick> {
  static constexpr const char* scene = "wall_strict";
  by_hand_wall_strict() {
    wall_strict_start(&model, {0, 1, given::wall_stiffness}, given::damping, by_hand_loop);
  }
  bool update(const surface&) { return false; }
};
struct by_hand_wall_reachable
    : by_hand_subject<::wall_reachable, 1, real, decltype(by_hand_wall_reachable_tick),
                      &by_hand_wall_reachable_tick> {
  static constexpr const char* scene = "wall_reachable";
  by_hand_wall_reachable() {
    wall_reachable_start(&model, given::stale_after, given::fade, given::damping, by_hand_reach,
                         by_hand_loop);
  }
  bool update(const surface& s) {
    return wall_reachable_update(&model, plane_of<plane1, real, 1>(s));
  }
};
struct by_hand_plane_strict
    : by_hand_subject<::plane_strict, 2, vec2, decltype(by_hand_plane_strict_tick),
                      &by_hand_plane_strict_tick> {
  static constexpr const char* scene = "plane_strict";
  by_hand_plane_strict() {
    plane_strict_start(&model, given::stale_after, given::fade, given::rate, given::damping,
                       by_hand_loop);
  }
  bool update(const surface& s) {
    const auto plane = plane_of<plane2, vec2, 2>(s);
    return plane_strict_update(&model, &plane);
  }
};
struct by_hand_plane_reachable
    : by_hand_subject<::plane_reachable, 3, vec3, decltype(by_hand_plane_reachable_tick),
                      &by_hand_plane_reachable_tick> {
  static constexpr const char* scene = "plane_reachable";
  by_hand_plane_reachable() {
    plane_reachable_start(&model, given::stale_after, given::fade, given::rate, given::damping,
                          by_hand_reach, by_hand_loop);
  }
  bool update(const surface& s) {
    const auto plane = plane_of<plane3, vec3, 3>(s);
    return plane_reachable_update(&model, &plane);
  }
};
struct by_hand_triangle_thesis
    : by_hand_subject<::triangle_thesis, 3, vec3, decltype(by_hand_triangle_thesis_tick),
                      &by_hand_triangle_thesis_tick> {
  static constexpr const char* scene = "triangle_thesis";
  by_hand_triangle_thesis() {
    triangle_thesis_start(&model, given::stale_after, given::fade, given::rate, given::damping,
                          by_hand_loop);
  }
  bool update(const surface& s) {
    const triangle3 next{vector_of<vec3, 3>(s.a),
                         vector_of<vec3, 3>(s.b),
                         vector_of<vec3, 3>(s.c),
                         real_of(s.stiffness),
                         real_max,
                         {}};
    return triangle_thesis_update(&model, &next);
  }
};

}  // namespace replay
