// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The cost of each part of a scene, and that a part which the scene does not use costs nothing: the same wall
// with one part more each time, in one dimension (float) and in three (double), through the same workload. All
// else in these scenes is as in scenes.hpp.

#include "corners.hpp"
#include "scenes.hpp"
#include <passive_haptics/base/samples.hpp>
#include <passive_haptics/contact/rigid_tool.hpp>
#include <passive_haptics/device/rigid_damping.hpp>
#include <passive_haptics/force_bound/rigid_reachable_bound.hpp>

namespace cost {

/// A wall of Dof dimensions for good, or (Moves) one that the environment could move and does not.
template <class Scalar, int Dof, bool Moves = false>
struct part_base {
  using scalar = Scalar;
  using space = ph::space<Scalar, Dof>;

  [[nodiscard]] static auto supply(const settings& s) {
    const auto wall = [&s] {
      const Scalar K = in<Scalar>(s.stiffness);
      if constexpr (Dof == 1) {
        return ph::half_space<space>{Scalar(0), Scalar(1), K};
      } else {
        return ph::half_space<space>{vector<Scalar>({}), vector<Scalar>({0, 0, 1}), K};
      }
    }();
    if constexpr (Moves) {
      return ph::followed{wall};
    } else {
      return ph::fixed{wall};
    }
  }
  template <class Normals, class Observer, class Bound>
  [[nodiscard]] static auto model(const settings& s, const Normals& normals, const Observer& o,
                                  const Bound& bound) {
    return ph::local_model{space{}, supply(s), normals, ph::spring{}, o, bound, limits(s)};
  }
};

template <class Scalar, int Dof>
struct part_bare : part_base<Scalar, Dof> {
  static constexpr const char* name = "fixed, turn_at_once, spring, no_observer, no_bound";
  [[nodiscard]] static auto composed(const settings& s) {
    return part_bare::model(s, ph::turn_at_once{}, ph::no_observer{}, ph::no_bound{});
  }
};

template <class Scalar, int Dof>
struct part_turning : part_base<Scalar, Dof> {
  static constexpr const char* name = "... turn_limited for turn_at_once: nothing turns here";
  [[nodiscard]] static auto composed(const settings& s) {
    return part_turning::model(s, ph::turn_limited{.rate = s.rate}, ph::no_observer{},
                               ph::no_bound{});
  }
};

template <class Scalar, int Dof>
struct part_counting : part_base<Scalar, Dof> {
  static constexpr const char* name = "... + reduced_energy";
  [[nodiscard]] static auto composed(const settings& s) {
    return part_counting::model(s, ph::turn_at_once{}, observer(s), ph::no_bound{});
  }
};

template <class Scalar, int Dof>
struct part_strict : part_base<Scalar, Dof> {
  static constexpr const char* name = "... + reduced_energy, strict_bound";
  [[nodiscard]] static auto composed(const settings& s) {
    return part_strict::model(s, ph::turn_at_once{}, observer(s), ph::strict_bound{});
  }
};

template <class Scalar, int Dof>
struct part_limited : part_base<Scalar, Dof> {
  static constexpr const char* name = "... + reduced_energy, strict_bound, actuator_limit";
  [[nodiscard]] static auto composed(const settings& s) {
    return part_limited::model(
        s, ph::turn_at_once{}, observer(s),
        ph::bound_chain{ph::strict_bound{}, ph::actuator_limit{.most = s.force_limit}});
  }
};

template <class Scalar, int Dof>
struct part_following : part_base<Scalar, Dof, true> {
  static constexpr const char* name = "... + reduced_energy, strict_bound, followed for fixed";
  [[nodiscard]] static auto composed(const settings& s) {
    return part_following::model(s, ph::turn_at_once{}, observer(s), ph::strict_bound{});
  }
};

/// On encoders with steps: a settling wall, an estimator, a ledger that is sure.
template <class Scalar, int Dof, bool Rubs>
struct part_encoder : part_base<Scalar, Dof> {
  [[nodiscard]] static auto composed(const settings& s) {
    const auto ledger = [&s] {
      if constexpr (Rubs) {
        return ph::dual_ledger{.damping = {s.damping, s.friction, s.presliding},
                               .quantum = s.quantum};
      } else {
        return ph::quantised_energy{.damping = s.damping, .quantum = s.quantum};
      }
    }();
    return ph::local_model{
        typename part_encoder::space{},
        part_encoder::supply(s),
        ph::turn_at_once{},
        ph::damped_spring{.mass = s.mass, .force_limit = s.force_limit},
        ledger,
        ph::bound_chain{ph::reachable_bound{.mass = s.mass, .hand_force = s.hand_force},
                        ph::actuator_limit{.most = s.force_limit}},
        limits(s),
        ph::mass_observer{.mass = s.mass, .quantum = s.quantum}};
  }
};
template <class Scalar, int Dof>
struct part_stepped : part_encoder<Scalar, Dof, false> {
  static constexpr const char* name =
      "encoders: damped_spring, mass_observer, quantised_energy, "
      "reachable_bound, actuator_limit";
};
template <class Scalar, int Dof>
struct part_rubbing : part_encoder<Scalar, Dof, true> {
  static constexpr const char* name = "... dual_ledger for quantised_energy: friction is credited";
};

/// The reference of the four below: one contact of a settling wall.
template <class Scalar, int Dof>
struct part_reachable : part_base<Scalar, Dof> {
  static constexpr const char* name = "fixed, damped_spring, reduced_energy, reachable_bound";
  [[nodiscard]] static auto composed(const settings& s) {
    return ph::local_model{typename part_reachable::space{},
                           part_reachable::supply(s),
                           ph::turn_at_once{},
                           ph::damped_spring{.mass = s.mass},
                           observer(s),
                           ph::reachable_bound{.mass = s.mass, .hand_force = s.hand_force},
                           limits(s)};
  }
};

/// The first of them along the normal of the wall, so that the workload takes the same paths.
template <class Space>
[[nodiscard]] typename Space::vector normal_of(int i) {
  if constexpr (Space::dof == 1) {
    return i % 2 == 0 ? typename Space::scalar(1) : typename Space::scalar(-1);
  } else {
    ph::laws::samples random(static_cast<std::uint64_t>(i));
    if (i < 3) return Space::vector::Unit((i + 2) % 3);
    return random.template direction<Space>();
  }
}

/// A set of planes, of which plane_of(i) is the i-th.
template <class Space, int Planes, class Friction = ph::frictionless>
[[nodiscard]] auto set_of(const settings& s, auto plane_of) {
  ph::passive_port port{Space{},
                        ph::contact_set{ph::proxy_spring{.mass = s.mass}, ph::pursuit{}, Friction{},
                                        ph::slots<ph::half_space<Space>, Planes>{}},
                        observer(s),
                        ph::reachable_bound{.mass = s.mass, .hand_force = s.hand_force}, limits(s)};
  for (int i = 0; i < Planes; ++i) port.source().update(i, plane_of(i));
  return port;
}

/// The first `Near` planes go through the origin; the others are half a metre away.
template <class Scalar, int Dof, int Planes, class Friction = ph::frictionless, int Near = Planes>
struct part_set : part_base<Scalar, Dof> {
  [[nodiscard]] static auto composed(const settings& s) {
    using space = typename part_set::space;
    return set_of<space, Planes, Friction>(s, [&s](int i) {
      const typename space::vector n = normal_of<space>(i), at = n * Scalar(i < Near ? 0.0 : -0.5);
      return ph::half_space<space>{at, n, in<Scalar>(s.stiffness)};
    });
  }
};
template <class Scalar, int Dof>
struct part_plane : part_set<Scalar, Dof, 1> {
  static constexpr const char* name = "contact_set of a plane";
};
template <class Scalar, int Dof>
struct part_rough : part_set<Scalar, Dof, 1, ph::stick_slip> {
  static constexpr const char* name = "contact_set of a plane with stick_slip";
};
template <class Scalar, int Dof>
struct part_corner : part_set<Scalar, Dof, 3> {
  static constexpr const char* name = "contact_set of three planes";
};
template <class Scalar, int Dof>
struct part_six : part_set<Scalar, Dof, 6> {
  static constexpr const char* name = "contact_set of six planes";
};
template <class Scalar, int Dof>
struct part_sixteen : part_set<Scalar, Dof, 16> {
  static constexpr const char* name = "contact_set of sixteen planes";
};

template <class Scalar, int Dof>
struct part_crowd : part_set<Scalar, Dof, 64, ph::frictionless, 3> {
  static constexpr const char* name = "contact_set of 64 planes, three of them near";
};

/// A corner in three dimensions, whatever Dof says, before the hardest tick that was found.
template <class Scalar, int Planes>
struct part_hardest {
  using scalar = Scalar;
  using space = ph::space<Scalar, 3>;
  static constexpr const corner<Planes>& data = hardest<Planes>;

  [[nodiscard]] static std::array<double, 3> place(const std::array<int, 3>& micrometres) {
    return {1e-6 * micrometres[0], 1e-6 * micrometres[1], 1e-6 * micrometres[2]};
  }
  [[nodiscard]] static auto composed(const settings& s) {
    auto port = set_of<space, Planes>(s, [&s](int i) {
      const auto& [x, y, z, along] = data.planes[static_cast<std::size_t>(i)];
      const typename space::vector n = vector<Scalar>({1.0 * x, 1.0 * y, 1.0 * z}).normalized(),
                                   at = n * in<Scalar>(1e-6 * along);
      return ph::half_space<space>{at, n, in<Scalar>(s.stiffness)};
    });
    const ph::seconds dt{in<Scalar>(1e-3)};
    for (const auto& x : {std::array{0.0, 0.0, 0.03}, place(data.before)}) {
      static_cast<void>(port.tick(vector<Scalar>(x), dt));
    }
    return port;
  }
};
template <class Scalar, int Dof>
struct part_hardest_three : part_hardest<Scalar, 3> {
  static constexpr const char* name =
      "... of three planes, in 3-DOF float, too: the hardest tick found";
};
template <class Scalar, int Dof>
struct part_hardest_six : part_hardest<Scalar, 6> {
  static constexpr const char* name = "... of six planes, the hardest tick found";
};
template <class Scalar, int Dof>
struct part_hardest_sixteen : part_hardest<Scalar, 16> {
  static constexpr const char* name = "... of sixteen planes, the hardest tick found";
};

/// A tool of six degrees of freedom, whatever Dof says.
template <class Scalar, int Points>
struct part_tool_of {
  using scalar = Scalar;
  using space = ph::space<Scalar, 3>;
  [[nodiscard]] static auto composed(const settings& s) {
    using plane = ph::half_space<space>;
    ph::passive_port port{
        ph::rigid_body<Scalar>{},
        ph::rigid_tool{ph::tool_spring{.mass = s.mass, .least_inertia = 1e-4}, ph::pursuit{},
                       ph::slots<plane, Points>{}},
        ph::basic_reduced_energy<ph::rigid_damping>{.damping = {s.damping, 1e-3}},
        ph::rigid_reachable_bound{.inertia = {.mass = s.mass, .least = 1e-4, .spread = 1e-4},
                                  .hand_force = s.hand_force,
                                  .hand_torque = 0.2,
                                  .linear_damping_most = 2.0 * s.damping,
                                  .angular_damping_most = 2e-3},
        limits(s)};
    for (int i = 0; i < Points; ++i) {
      ph::laws::samples random(static_cast<std::uint64_t>(i));
      const typename space::vector point = random.template vector<space>() * Scalar(0.02);
      port.source().update(i, point, plane{point, normal_of<space>(i), in<Scalar>(s.stiffness)});
    }
    return port;
  }
};
template <class Scalar, int Dof>
struct part_tool : part_tool_of<Scalar, 1> {
  static constexpr const char* name = "rigid_tool with a contact, rigid_reachable_bound";
};
template <class Scalar, int Dof>
struct part_tool_sixteen : part_tool_of<Scalar, 16> {
  static constexpr const char* name = "rigid_tool with sixteen contacts";
};

}  // namespace cost
