// SPDX-License-Identifier: BSD-3-Clause
// One degree of freedom on a wall that never moves. Its object is searched for what it must not hold.
#include <passive_haptics/bounds/force_bounding.hpp>
#include <passive_haptics/contact.hpp>
#include <passive_haptics/geometry.hpp>
#include <passive_haptics/local_model.hpp>
#include <passive_haptics/normals.hpp>
#include <passive_haptics/observers.hpp>
#include <passive_haptics/supply.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

float wall_force(float position, float dt) {
  static ph::local_model wall{scene{},
                              ph::rigid{ph::half_space<scene>{0, 1, 1000}},
                              ph::snap<scene>{},
                              ph::spring<scene>{},
                              ph::reduced_energy<scene>{.damping = 0.3F},
                              ph::strict_bound<scene>{}};
  return wall.tick(position, dt).force;
}
