// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/reference.hpp"
#include "support/catch.hpp"
#include <passive_haptics/simulation/device.hpp>

namespace sim = ph::simulation;
using namespace simulated;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

TEST_CASE("impedance_hand settles on its target and never exceeds its limit",
          "[simulation][hand]") {
  using hand = sim::impedance_hand<plane>;
  const hand strong{.stiffness = 300.0, .limit = 2.0, .target = {0.05, -0.02}};
  sim::device<plane, hand> device{{}, strong};
  for (int n = 0; n < 3000; ++n) {
    device.exchange(plane::zero());
    const auto push = device.hand().force(device.time(), device.position(), device.velocity());
    CHECK(push.norm() <= 2.0 * (1 + 1e-15));
  }
  CHECK((device.position() - plane::vector(0.05, -0.02)).norm() < 1e-9);
  CHECK(strong.force(0.0, plane::zero(), plane::zero()).norm() > 1.99);  // control: it does limit

  SECTION("its mass moves with the device") {
    sim::device<plane, hand> heavy{{.mass = 0.1},
                                   {.stiffness = 0.0, .damping = 0.0, .own_mass = 0.3}};
    heavy.exchange({1.0, 0.0});
    CHECK_THAT(heavy.velocity()(0), WithinRel(1e-3 / 0.4, 1e-3));
  }
  SECTION("a moving target is followed between the calls") {
    hand follows{.stiffness = 100.0, .damping = 0.0};
    follows.aim({0.0, 0.0}, {0.2, 0.0}, 1.0);
    CHECK_THAT(follows.force(1.5, plane::zero(), plane::zero())(0), WithinRel(10.0, 1e-14));
  }
}

TEST_CASE("tapping_hand presses outside and pulls inside", "[simulation][hand]") {
  const sim::tapping_hand<room> tapping{.surface = {0, 0, 0.01}, .normal = {0, 0, 1}, .limit = 5.0};
  CHECK_FALSE(tapping.check());
  CHECK(tapping.force(0.0, {1, 2, 0.02}, room::zero()) == room::vector(0, 0, -5));
  CHECK(tapping.force(0.0, {1, 2, 0.0}, room::zero()) == room::vector(0, 0, 5));
  CHECK(sim::tapping_hand<room>{.normal = {0, 0, 2}}.check());
}

TEST_CASE("stroke goes from start to end, and its velocity is its derivative",
          "[simulation][hand]") {
  const auto profile = GENERATE(sim::stroke_profile::even, sim::stroke_profile::minimum_jerk);
  const sim::stroke<line> stroke{
      .from = 0.1, .to = -0.3, .start = 0.5, .duration = 2.0, .profile = profile};
  CHECK(stroke.position(0.0) == 0.1);
  CHECK_THAT(stroke.position(3.0), WithinAbs(-0.3, 1e-15));
  CHECK_THAT(stroke.position(1.5), WithinAbs(-0.1, 1e-15));
  CHECK(stroke.velocity(0.4) == 0.0);
  CHECK(stroke.velocity(2.6) == 0.0);
  for (double t = 0.55; t < 2.45; t += 0.1) {
    const double slope = (stroke.position(t + 1e-6) - stroke.position(t - 1e-6)) / 2e-6;
    CHECK_THAT(stroke.velocity(t), WithinAbs(slope, 1e-8));
  }
}
