// SPDX-License-Identifier: BSD-3-Clause
// A device that nobody holds rolls in a bowl without friction: its surface turns the force, and what is late turns it
// too late. (S2) leads the depth alone, so the push is led as well (contact/pursuit.hpp).
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/constraint_geometry/quadric.hpp>
#include <passive_haptics/simulation/quiet.hpp>

#include <algorithm>
#include <array>

namespace {

constexpr double T = 1e-3, mass = 0.1, damping = 0.03;
using bowl = ph::quadric<d3>;

struct rolled {
  double settling = 0.0;      ///< NaN: it is not quiet after three seconds [s]
  double speed = 0.0;         ///< then [m/s]
  double least_energy = 0.0;  ///< at the port [J]
};
/// Let go beside the middle of a bowl of that radius [m], under a load [N], `Late` ticks late; ζ as told.
template <int Late>
rolled roll(double radius, double load, double ratio) {
  ph::late_loop_limits<Late> limits{};
  limits.longest_tick = T;
  ph::passive_port port{d3{},
                        ph::contact_set{ph::proxy_spring{.mass = mass, .damping_ratio = ratio},
                                        ph::pursuit{}, ph::slots<bowl, 1>{}},
                        ph::reduced_energy{.damping = damping},
                        ph::reachable_bound{.mass = mass, .hand_force = 1.5 * load + 0.5}, limits};
  REQUIRE(port.source().update(0, bowl{.point = d3::zero(),
                                       .normal = d3::vector(0, 0, 1),
                                       .tangent = d3::vector(1, 0, 0),
                                       .curvature = -1.0 / radius,
                                       .cross_curvature = -0.8 / radius,
                                       .stiffness = 2000.0,
                                       .thickness = 0.03}));
  d3::vector x{0.1 * radius, 0.05 * radius, 0.01 + 0.01 * radius}, v = d3::zero();
  const d3::vector weight{0, 0, -load};
  std::array<d3::vector, Late + 1> due;
  due.fill(d3::zero());
  ph::simulation::quiet_judge<d3> judge;
  rolled result;
  double energy = 0.0;
  for (int n = 0; n < 3000 && x.norm() < 0.3; ++n) {
    due.back() = port.tick(x, ph::seconds{T}).force;
    judge.add(due.back(), v, T, {});
    constexpr int steps = 10;
    for (int i = 0; i < steps; ++i) {
      v += (due.front() + weight - damping * v) * (T / steps / mass);
      x += v * (T / steps);
      energy += damping * v.squaredNorm() * T / steps - due.front().dot(v) * T / steps;
    }
    result.least_energy = std::min(result.least_energy, energy);
    std::rotate(due.begin(), due.begin() + 1, due.end());
  }
  result.settling = judge.settling();
  result.speed = v.norm();
  return result;
}

}  // namespace

TEST_CASE("a device that nobody holds comes to rest in a bowl, however late its loop is") {
  for (const double radius : {0.06, 0.1}) {
    for (const double load : {1.0, 3.0}) {
      CAPTURE(radius, load);
      for (const rolled& r : {roll<0>(radius, load, 1.0), roll<1>(radius, load, 1.0),
                              roll<2>(radius, load, 1.0), roll<3>(radius, load, 1.0)}) {
        CHECK(r.settling < 2.0);
        CHECK(r.speed < 0.05);
        CHECK(r.least_energy >= -1e-6);
      }
    }
  }
  CHECK_FALSE(roll<0>(0.06, 3.0, 0.0).settling < 2.0);  // the control: nothing leads it
}
