// SPDX-License-Identifier: BSD-3-Clause
// reachable_bound on a device that its axes damp unequally: the damper across the force pushes, too.
#include "force_bound/attacks.hpp"
#include "support/catch.hpp"

#include <cmath>

namespace {

using axes = ph::diagonal_damping<2>;

/// One tick of a hand of 0.194 N along the force, on 0.1 kg that comes in across it at 0.43 m/s,
/// where the second axis takes most of that speed away: E1 after it, and the force that was granted.
struct crossed {
  double left;     ///< [J]
  double granted;  ///< [N]
};
crossed cross(const auto& bound) {
  const double m = 0.1, T = 1e-3, F = 0.194, angle = 2.056;
  const std::array<double, 2> b{0.01, 8.0};
  const d2::vector u(std::cos(angle), std::sin(angle));
  ph::passive_port port{d2{}, ph::given_force{},
                        ph::basic_reduced_energy<axes>{.damping = {{b[0], b[1]}}, .loan = 2.235e-3},
                        bound, ph::loop_limits{.longest_tick = T}};
  d2::vector x(0.0, 0.0), v(-0.01237, -0.42623);
  d2::vector f = port.tick(x, ph::seconds{T}, u * 2.0829).force;
  crossed out{};
  for (const double asked : {77.469, 0.0}) {
    for (int i = 0; i < 2; ++i) {  // exact for a constant force
      const auto axis = static_cast<std::size_t>(i);
      const double steady = (f(i) + F * u(i)) / b[axis], rest = v(i) - steady;
      x(i) += steady * T - rest * std::expm1(-b[axis] / m * T) * m / b[axis];
      v(i) = steady + rest * std::exp(-b[axis] / m * T);
    }
    const auto now = port.tick(x, ph::seconds{T}, d2::vector(u * asked));
    f = now.force;
    out.left = now.energy;
    if (asked > 0.0) out.granted = f.norm();
  }
  return out;
}

}  // namespace

TEST_CASE("reachable_bound counts on the damper of every axis, not on the one along the force",
          "[bound][passivity]") {
  const auto reachable = cross(ph::reachable_bound{.mass = 0.1, .hand_force = 0.194});
  CHECK(reachable.left >= 0.0);
  CHECK(reachable.granted > 30.0);
  // in joules, where the damper was always the whole one
  CHECK(cross(ph::reachable_work_bound<2>{.inertia = {{0.1, 0.1}}, .hand = 0.194 / std::sqrt(0.1)})
            .left >= 0.0);
  // the control: 42 N are too much for that tick, and a device that is told heavier gets them
  const auto fooled = cross(ph::reachable_bound{.mass = 0.12, .hand_force = 0.194});
  CHECK(fooled.granted > 42.0);
  CHECK(fooled.left < 0.0);
}

TEST_CASE(
    "reachable_bound never grants what reachable_work_bound would not, however unequal the axes",
    "[bound]") {
  sim::random_source random(31);
  int cut = 0;
  for (int i = 0; i < 20000; ++i) {
    const double mass = std::pow(10.0, random.uniform(-2.0, 0.5)), hand = random.uniform(0.0, 5.0);
    const auto one = at<d2>(ph::reachable_bound{.mass = mass, .hand_force = hand});
    const auto other = at<d2>(
        ph::reachable_work_bound<2>{.inertia = {{mass, mass}}, .hand = hand / std::sqrt(mass)});
    const axes b{
        {std::pow(10.0, random.uniform(-3.0, 1.0)), std::pow(10.0, random.uniform(-3.0, 1.0))}};
    const situation<d2, axes> now{
        .damping = at<d2>(b),
        .energy = std::pow(10.0, random.uniform(-8.0, -2.0)),
        .dt = random.uniform(0.5e-3, 1.5e-3),
        .held = d2::vector(random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0)),
        .travel = d2::vector(random.uniform(-5e-4, 5e-4), random.uniform(-5e-4, 5e-4))};
    const d2::vector desired(random.uniform(-20.0, 20.0), random.uniform(-20.0, 20.0));
    const d2::vector granted = allowed(one, desired, now);
    REQUIRE((allowed(other, granted, now) - granted).norm() <= granted.norm() * 1e-9);
    cut += granted.norm() < desired.norm() ? 1 : 0;
  }
  CHECK(cut > 1000);
}
