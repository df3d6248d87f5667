// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What each part of a scene costs, and what one that the scene has no use for does not: the same wall
// with one part more each time, in one dimension (float) and in three (double), through the same
// workload. Everything else about these scenes is as in scenes.hpp.

#include "scenes.hpp"

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

}  // namespace cost
