// SPDX-License-Identifier: BSD-3-Clause
// A surface that heaves and tilts, published 30 times a second, felt 1000 times a second.
//
// Between two updates the local model stands still; at an update it may jump by millimetres and
// turn by degrees. turn_limited turns the normal smoothly, reachable_bound keeps what the next
// tick can give back within what the hand has paid, actuator_limit cuts what no motor can hold.

#include <passive_haptics/passive_haptics.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace ph = passive_haptics;
using scene = ph::space<double, 3>;
using vector = scene::vector;

/// The world at time t [s]: a plane through the z axis, heaving by 3 mm and tilting by 8°.
ph::half_space<scene> world(double t) {
  const double tilt = 0.14 * std::sin(5.0 * t);
  return {.point = {0.0, 0.0, 0.003 * std::sin(7.0 * t)},
          .normal = {std::sin(tilt), 0.0, std::cos(tilt)},
          .stiffness = 1500.0};
}

int main() {
  const double mass = 0.1, damping = 0.5, dt = 1e-3;  // of the device, kg and N·s/m; s
  // By hand: every part in its place, in the order of the table in docs/parts.md.
  ph::local_model touch{scene{},
                        ph::followed<ph::half_space<scene>>{},
                        ph::turn_limited{.rate = 2.0},  // rad/s
                        ph::damped_spring{.mass = mass},
                        ph::reduced_energy{.damping = damping},
                        ph::bound_chain{ph::reachable_bound{.mass = mass, .hand_force = 5.0},
                                        ph::actuator_limit{.most = 9.0}},
                        ph::loop_limits{.longest_tick = 1.1 * dt}};  // YOUR worst
  static_assert(decltype(touch)::passivity == ph::guarantee::conditional);

  vector x(0.0, 0.0, 0.008), v = vector::Zero(), normal = vector::UnitZ();
  double least_energy = 0.0, fastest_turn = 0.0;
  for (int tick = 1; tick <= 1000; ++tick) {
    if (tick % 33 == 1) touch.update(world(tick * dt));
    const auto out = touch.tick(x, ph::seconds{dt});
    // A hand presses with 2 N and steadies the device sideways; the device is a damped mass.
    const vector hand(-100.0 * x(0), -100.0 * x(1), -2.0);
    v += dt / mass * (hand + out.force - damping * v);
    x += dt * v;

    const vector turned = touch.local().normal;
    fastest_turn = std::max(fastest_turn, (turned - normal).norm() / dt);
    normal = turned;
    least_energy = std::min(least_energy, out.energy);
    if (tick % 100 == 0) {
      const vector goal = touch.target().normal;
      std::printf("t %.1f s  z %5.2f mm  depth %4.2f mm  force %4.2f N  normal x %6.3f of %6.3f\n",
                  tick * dt, x(2) * 1e3, out.depth * 1e3, out.force.norm(), normal(0), goal(0));
    }
  }
  std::printf("fastest turn of the normal %.2f rad/s, energy never below zero: %s\n", fastest_turn,
              least_energy < 0.0 ? "no" : "yes");
}
