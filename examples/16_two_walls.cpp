// SPDX-License-Identifier: BSD-3-Clause
// Walls that meet in a corner, on one device, in ONE passive port.
//
// A local model for each wall looks as good, and every type says `strict`. But each of them counts the
// whole damping of the device as its own and spends it, so the hand is paid for it two or three times.
// The rule is one port per device; several contacts are one source of it.

#include <passive_haptics/passive_haptics.hpp>

#include <cmath>
#include <cstdio>

namespace ph = passive_haptics;
using scene = ph::space<double, 3>;
using vector = scene::vector;

constexpr double damping = 0.5;  // of the device, N·s/m
constexpr double dt = 1e-3;      // s

/// Shakes the device in and out of the corner for 20 s; the least energy that the hand has paid [J].
double shaken(auto force_at) {
  double energy = 0, least = 0;
  vector x = vector::Constant(1e-3), force = vector::Zero();
  for (int n = 0; n < 20000; ++n) {
    const double phase = 0.13 * n * (1 + 0.3 * std::sin(0.001 * n));
    const vector step = vector::Constant(-2e-3 * std::sin(phase)) - x;
    energy += damping / dt * step.squaredNorm() - force.dot(step);
    least = std::min(least, energy);
    x += step;
    force = force_at(x);
  }
  return least;
}

/// A port for each wall, or one for all of them: the forces of all ports, added.
double shaken_with(auto... port) {
  return shaken(
      [&](const vector& x) -> vector { return (port.tick(x, ph::seconds{dt}).force + ...); });
}

int main() {
  const auto wall = [](const vector& normal) {
    return ph::local_contact{ph::fixed{ph::half_space<scene>{{0, 0, 0}, normal, 1e5}},  // N/m
                             ph::turn_at_once{}, ph::spring{}};
  };
  const auto floor = wall({0, 0, 1}), side = wall({1, 0, 0}), back = wall({0, 1, 0});
  const ph::reduced_energy ledger{.damping = damping};
  const ph::strict_bound bound;
  const ph::loop_limits limits{.longest_tick = dt};

  // By hand: the sum of two and of three local models, against a port each.
  const ph::passive_port edge{scene{}, ph::contacts{floor, side}, ledger, bound, limits};
  const ph::passive_port corner{scene{}, ph::contacts{floor, side, back}, ledger, bound, limits};
  const auto alone = [&](const auto& one) {
    return ph::passive_port{scene{}, one, ledger, bound, limits};
  };
  static_assert(decltype(alone(floor))::passivity == ph::guarantee::strict);  // and yet:
  std::printf("two walls:   one port %.2f J, a port each %6.2f J\n", shaken_with(edge),
              shaken_with(alone(floor), alone(side)));
  std::printf("three walls: one port %.2f J, a port each %6.2f J\n", shaken_with(corner),
              shaken_with(alone(floor), alone(side), alone(back)));
}
