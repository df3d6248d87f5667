// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The common part of the simulation's tests: its spaces, and the motion of an axis by other means than the
// library's.
#include "support/scenes.hpp"

#include <cmath>
#include <limits>

namespace simulated {

using line = d1;
using plane = d2;
using room = d3;
inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

using real = long double;
struct reference {
  real position, velocity;
};

/// m v̇ + b v = F: the power series of the solution, or for b h/m > 1 its closed form, in long double.
inline reference solve(double mass, double damping, double force, double speed, double time) {
  const real r = real(damping) / real(mass), a = real(force) / real(mass);
  const real v0 = real(speed), h = real(time), z = r * h;
  if (z > 1) {
    const real final_speed = a / r, decay = std::exp(-z);
    return {final_speed * h + (v0 - final_speed) * (1 - decay) / r,
            final_speed + (v0 - final_speed) * decay};
  }
  real term = (a - r * v0) * h, velocity = v0, position = v0 * h;
  for (int n = 1; n < 60; ++n) {
    velocity += term;
    position += term * h / real(n + 1);
    term *= -z / real(n + 1);
  }
  return {position, velocity};
}

}  // namespace simulated
