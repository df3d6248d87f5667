// SPDX-License-Identifier: BSD-3-Clause
// The parallel passivity controller, for a device that is told a velocity: its formula and its books,
// judged by the true energy of a springy hand.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/published/parallel_passivity_controller.hpp>
#include <passive_haptics/simulation/schedule.hpp>

#include <algorithm>

namespace sim = ph::simulation;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double T = 1e-3;

using parallel = ph::parallel_passivity_controller<d1>;
using parameters = ph::parallel_controller_parameters;

static_assert([] {
  ph::parallel_passivity_controller<f1> leak({.max_mobility = 1.0});
  (void)leak.velocity(1.0F, 0.0F, 0.001F);
  return leak.velocity(1.0F, -1.0F, 0.001F) < 1.0F;
}());

/// A hand on a device that goes at the velocity it is told: a spring to the origin and a damper,
/// both passive. Held velocity, so the force falls linearly within a tick.
struct springy_hand {
  double stiffness = 2000.0, damping = 0.2;  ///< [N/m], [N·s/m]
  double x = 0.0;                            ///< [m]
  double energy = 0.0;                       ///< true, of the port [J]
  double first = 0.0, last = 0.0;            ///< force at the start and end of the tick [N]

  /// Goes at v for one tick; the mean force on the device over it.
  double move(double v) {
    first = -stiffness * x - damping * v;
    x += v * T;
    last = -stiffness * x - damping * v;
    energy += T * v * (first + last) / 2.0;
    return (first + last) / 2.0;
  }
};

/// A virtual mass of 50 g, displayed by velocity: the dual of a stiff wall.
struct virtual_mass {
  double mass = 0.05;  ///< [kg]
  double velocity(double held, double force) const { return held + T * force / mass; }
};

struct outcome {
  double energy = 0.0;  ///< least true port energy [J]
  double swing = 0.0;   ///< farthest from the origin in the last tenth [m]
  bool acted = false;
};
template <class Display>
outcome hold_a_virtual_mass(Display display) {
  springy_hand hand{.x = 1e-3};
  outcome result;
  double v = 0.0;
  for (int n = 0; n < 1000; ++n) {
    const double force = hand.move(v);
    const double wish = virtual_mass{}.velocity(v, force);
    v = display(wish, force);
    result.acted = result.acted || v != wish;
    result.energy = std::min(result.energy, hand.energy);
    if (n >= 900) result.swing = std::max(result.swing, std::abs(hand.x));
  }
  return result;
}

}  // namespace

TEST_CASE("the parallel controller leaks velocity along the force", "[time domain]") {
  const auto after_a_push = [](const parameters& p) {
    parallel controller(p);
    CHECK(controller.velocity(0.2, 3.0, T) == 0.2);  // 3 N that follows gives energy
    return controller;
  };
  parallel controller = after_a_push({.max_mobility = 0.1});
  SECTION("β = −(E + T v f)/(T f²), the predicted loss included") {
    // E = T 0.2 (−4) = −0.8 mJ; v* = 0.1: W = −1.2 mJ, β = 0.075
    CHECK_THAT(controller.velocity(0.1, -4.0, T), WithinRel(0.1 - 0.075 * 4.0, 1e-12));
    CHECK_THAT(controller.energy(), WithinRel(-0.8e-3, 1e-12));
    (void)controller.velocity(0.0, 1.0, T);  // −0.2 m/s were held
    CHECK_THAT(controller.energy(), WithinRel(-0.8e-3 - 0.2e-3, 1e-12));
  }
  SECTION("capped, and the rest is carried") {
    controller = after_a_push({.max_mobility = 0.01});
    CHECK_THAT(controller.velocity(0.1, -4.0, T), WithinRel(0.1 - 0.04, 1e-12));
    // E = −0.8 mJ − 0.24 mJ, nothing desired
    CHECK_THAT(controller.velocity(0.0, -4.0, T), WithinRel(-0.04, 1e-12));
    CHECK_THAT(controller.energy(), WithinRel(-1.04e-3, 1e-12));
  }
  SECTION("no action below the noise of the sensor") {
    controller = after_a_push({.max_mobility = 0.1, .least_force = 5.0});
    CHECK(controller.velocity(0.1, -4.0, T) == 0.1);
    CHECK(controller.velocity(0.1, 0.0, T) == 0.1);
  }
  SECTION("just the least force is enough, and a loan is there from the start") {
    controller = after_a_push({.max_mobility = 0.1, .least_force = 4.0});
    CHECK(controller.velocity(0.1, -4.0, T) < 0.1);
    CHECK(parallel({.max_mobility = 0.1, .loan = 1.0}).energy() == 1.0);
  }
  SECTION("after a bad sample nothing is held") {
    CHECK(controller.velocity(0.1, std::nan(""), T) == 0.0);
    CHECK(controller.velocity(0.2, 3.0, T) == 0.2);
    CHECK(controller.energy() == 0.0);
  }
  SECTION("the velocity really held counts") {
    static_cast<void>(controller.velocity(0.0, -4.0, T, 0.05));
    CHECK_THAT(controller.energy(), WithinRel(-0.2e-3, 1e-12));
  }
  SECTION("a bad sample stops the device and voids credit, not debt") {
    const double nan = std::nan("");
    controller = parallel({.max_mobility = 0.1, .loan = 1.0});
    CHECK(controller.velocity(0.1, nan, T) == 0.0);
    CHECK(controller.energy() == 0.0);
    controller = parallel({.max_mobility = 0.1});
    (void)controller.velocity(0.0, -1.0, 1.0, 1.0);
    REQUIRE(controller.energy() == -1.0);
    CHECK(controller.velocity(nan, 1.0, T) == 0.0);
    CHECK(controller.velocity(0.1, 1.0, 0.0) == 0.0);
    CHECK(controller.velocity(0.1, 1e300, T) == 0.0);
    CHECK(controller.energy() == -1.0);
  }
  SECTION("in three dimensions, along the force") {
    ph::parallel_passivity_controller<f3> wide({.max_mobility = 0.01});
    static_cast<void>(wide.velocity(f3::vector(1, 0, 0), f3::vector(0, 0, 0), 1e-3F));
    const f3::vector v = wide.velocity(f3::zero(), f3::vector(-1, 2, 0), 1e-3F);
    CHECK((v - f3::vector(-0.01F, 0.02F, 0)).norm() < 1e-7F);
  }
}

TEST_CASE("reset() of the parallel controller leads back to its loan and to rest",
          "[time domain]") {
  parallel controller({.max_mobility = 0.1, .loan = 1e-3});
  (void)controller.velocity(0.2, -4.0, T);
  (void)controller.velocity(0.2, -4.0, T);
  REQUIRE(controller.energy() < 1e-3);
  controller.reset();
  CHECK(controller.energy() == 1e-3);
  (void)controller.velocity(0.0, 5.0, T);  // nothing was held
  CHECK(controller.energy() == 1e-3);
  CHECK_FALSE(controller.check());
  CHECK(parallel({.max_mobility = -1.0}).check());
}

TEST_CASE("velocity held and mean force are the port energy; the end sample understates it",
          "[time domain]") {
  springy_hand hand{.stiffness = 2000.0, .damping = 0.2, .x = 1e-3};
  parallel controller({.max_mobility = 1e-9});
  sim::random_source random(5);
  double from_end = 0.0, from_start = 0.0, spring = 0.0, v = 0.0;
  for (int n = 0; n < 1000; ++n) {
    const double force = hand.move(v);
    from_end += T * v * hand.last;
    from_start += T * v * hand.first;
    spring += hand.stiffness * v * v * T * T / 2.0;
    v = controller.velocity(random.uniform(-0.1, 0.1), force, T);
  }
  CHECK_THAT(controller.energy(), WithinRel(hand.energy, 1e-10));
  CHECK_THAT(from_end, WithinRel(hand.energy - spring, 1e-10));
  CHECK_THAT(from_start, WithinRel(hand.energy + spring, 1e-10));
}

TEST_CASE("the parallel controller calms a virtual mass that feeds a stiff hand", "[time domain]") {
  const outcome bare = hold_a_virtual_mass([](double wish, double) { return wish; });
  CHECK(bare.energy < -1.0);
  CHECK(bare.swing > 0.1);

  parallel controller({.max_mobility = 1.0});
  const outcome calm = hold_a_virtual_mass(
      [&](double wish, double force) { return controller.velocity(wish, force, T); });
  CHECK(calm.swing < 1e-3);
  CHECK(calm.energy > -1e-3);

  double energy = 0.0;  // the published pairing: the new velocity with the last force
  const outcome blind = hold_a_virtual_mass([&](double wish, double force) {
    const double would_be = energy + T * wish * force;
    const double mobility = would_be < 0.0 ? -would_be / (T * force * force) : 0.0;
    energy += T * (wish + mobility * force) * force;
    return wish + mobility * force;
  });
  CHECK_FALSE(blind.acted);
  CHECK(blind.energy < -1.0);
}

TEST_CASE("the parallel controller loses only what the force changes in a tick", "[time domain]") {
  parallel controller({.max_mobility = 1e12});
  sim::random_source random(7);
  double energy = 0.0, last = 0.0, v = 0.0;
  for (int n = 0; n < 20000; ++n) {
    const double force = random.chance(0.2) ? random.uniform(-5.0, 5.0) : last;
    energy += T * v * force;
    if (n > 0) REQUIRE(energy >= T * v * (force - last) - 1e-12);
    v = controller.velocity(random.uniform(-0.2, 0.2), force, T);
    last = force;
  }
}

TEST_CASE("the parallel controller is not passive: a force that turns round each tick is fed",
          "[time domain]") {
  parallel controller({.max_mobility = 0.05});
  double energy = 0.0, v = 0.0;
  for (int n = 0; n < 1000; ++n) {
    const double force = n % 2 == 0 ? 5.0 : -5.0;
    energy += T * v * force;
    v = controller.velocity(virtual_mass{}.velocity(v, force), force, T);
  }
  CHECK(energy < -0.1);
}
