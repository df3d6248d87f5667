// SPDX-License-Identifier: BSD-3-Clause
#include "../common/set_of_one.hpp"
#include "compose_touch.hpp"

namespace experiments {

namespace {

/// A set of one contact under the reachable bound, and under the strict one.
template <class Friction>
void compose_sets(std::vector<composition>& all, const std::string& shape) {
  const auto add = [&](const std::string& limit, const auto& bound) {
    const set_of_one model{volume{},   ph::proxy_spring{.mass = 0.1},       ph::pursuit{},
                           Friction{}, ph::reduced_energy{.damping = 0.03}, bound,
                           loop};
    all.push_back({model.passivity, volume::dof, candidate_of(shape + ", " + limit, model),
                   [model](const touch_scene& scene, double rate) {
                     return run_touch(model, scene, 1.0 / rate, 1e-3);
                   }});
  };
  add("strict", ph::strict_bound{});
  add("reachable", ph::reachable_bound{.mass = 0.1, .hand_force = 5.0});
}

}  // namespace

void compose_planes(std::vector<composition>& all) {
  using plane = ph::half_space<volume>;
  compose_over<plane>(all, "plane, turn_at_once", ph::turn_at_once{});
  compose_over<plane>(all, "plane, turn_limited", ph::turn_limited{.rate = 3.0});
  compose_door<plane>(all, "plane");
  compose_sets<ph::frictionless>(all, "plane, contact_set");
  compose_sets<ph::stick_slip>(all, "plane, contact_set with stick_slip");
}

}  // namespace experiments
