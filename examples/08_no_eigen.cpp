// SPDX-License-Identifier: BSD-3-Clause
// One degree of freedom needs no vectors, so it needs no Eigen: include the parts, not the
// umbrella. CMake compiles this file without Eigen's directory. The whole scene is even a constant
// expression: the compiler presses the wall.

#include <passive_haptics/constraint_geometry/fixed.hpp>
#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/contact/spring.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/force_bound/strict_bound.hpp>
#include <passive_haptics/local_model.hpp>
#include <passive_haptics/normal_interpolation/turn_at_once.hpp>

#include <cstdio>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

// By hand: the smallest there is, as a constant expression.
constexpr ph::local_model knob{
    scene{},
    ph::fixed{ph::half_space<scene>{.point = 0.0F, .normal = 1.0F, .stiffness = 1000.0F}},
    ph::turn_at_once{},
    ph::spring{},
    ph::reduced_energy{.damping = 0.25},
    ph::strict_bound{},
    ph::loop_limits{.longest_tick = 1e-3}};

struct outcome {
  float largest_force = 0, least_energy = 0;
};

/// Presses the wall to 3 mm and comes out again, 0.5 mm a tick.
constexpr outcome press() {
  auto wall = knob;
  outcome result;
  for (int tick = -10; tick <= 10; ++tick) {
    const float depth = 3e-3F - 5e-4F * static_cast<float>(tick < 0 ? -tick : tick);
    const auto out = wall.tick(-depth, ph::seconds{1e-3F});
    if (out.force > result.largest_force) result.largest_force = out.force;
    if (out.energy < result.least_energy) result.least_energy = out.energy;
  }
  return result;
}

static_assert(!knob.check());
static_assert(press().largest_force > 1.0F);
static_assert(press().least_energy >= 0.0F);

int main() {
  const outcome result = press();  // the same at run time
  std::printf("largest force %.2f N, energy never below zero: %s\n",
              static_cast<double>(result.largest_force), result.least_energy < 0 ? "no" : "yes");
}
