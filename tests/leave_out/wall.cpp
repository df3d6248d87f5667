// SPDX-License-Identifier: BSD-3-Clause
// One degree of freedom on a wall that never moves. Its object is searched for what it must not hold.
#include <passive_haptics/constraint_geometry/fixed.hpp>
#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/contact/spring.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/force_bound/strict_bound.hpp>
#include <passive_haptics/local_model.hpp>
#include <passive_haptics/normal_interpolation/turn_at_once.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

float wall_force(float position, float dt) {
  static ph::local_model wall{scene{},
                              ph::fixed{ph::half_space<scene>{0, 1, 1000}},
                              ph::turn_at_once{},
                              ph::spring{},
                              ph::reduced_energy{.damping = 0.3},
                              ph::strict_bound{},
                              ph::loop_limits{.longest_tick = 0.001}};
  return wall.tick(position, ph::seconds{dt}).force;
}
