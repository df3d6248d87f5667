// SPDX-License-Identifier: BSD-3-Clause
// Energy tanks: the worst outflow, the predicted one, two layers; what they hold and what they lose.
#include "force_bound/attacks.hpp"
#include "force_bound/upkeep.hpp"
#include "published/tanks.hpp"
#include <passive_haptics/published/energy_tank.hpp>

using attacks::inf, attacks::least_of, attacks::model_of, attacks::tapped;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double T = 1e-3;
constexpr ph::two_layer_tank level_tank{.wanted = 0.015, .refill = 3000.0, .max_damping = 50.0};

/// H [J] of a copy: what it lets out over 1 m, or while it holds nothing, the drag that refills it.
double level_of(const ph::part_at<ph::two_layer_tank, d1>& tank) {
  auto parameters = tank.parameters();
  parameters.wanted = 0.0;
  parameters.refill = T;
  parameters.max_damping = ph::kernels::largest<double>();
  parameters.force_per_joule = inf;
  const situation<d1> now{.damping = at<d1>(ph::isotropic_damping{1e-300}), .travel = 1.0};
  const auto answer = [&](double desired) {
    auto copy = tank;
    copy.set(parameters);
    return allowed(copy, desired, now);
  };
  const double lack = answer(0.0);
  return lack < 0.0 ? lack : answer(1e6);
}

static_assert([] {
  auto tank = at<f1>(ph::energy_tank{});
  auto layers = at<f1>(ph::two_layer_tank{.wanted = 0.001, .refill = 10, .max_damping = 5});
  const situation<f1> now{.energy = 1e-5F, .held = -2.0F, .travel = -0.001F};
  return allowed(tank, -1.0F, now) > -1.0F && allowed(layers, -1.0F, now) > -1.0F;
}());

}  // namespace

TEMPLATE_TEST_CASE("a tank that counts the worst outflow is strict_bound to the bit",
                   "[time domain]", d1, f1, d3) {
  check_tank_is_strict<TestType>();
}

TEST_CASE("a tank that counts the worst outflow loses nothing in a quick run", "[time domain]") {
  for (const attacks::conditions& when :
       {attacks::conditions{}, attacks::conditions{.lost = 0.05, .late = 0.05}}) {
    CHECK(least_of<d1>(ph::energy_tank{}, when, 4) >= -1e-12);
    CHECK(least_of<d1>(ph::predicting_tank{}, when, 4) < -1e-3);  // the control
  }
}

TEST_CASE("a tank never spends its reserve", "[time domain]") {
  const auto least_after_filling = [](double reserve) {
    auto model = model_of<d1>(ph::energy_tank{.reserve = reserve});
    (void)model.update(wall<d1>(1e4));
    sim::prescribed_motion<d1> device;
    sim::greedy_motion<d1> motion;
    sim::random_source random(2);
    auto sample = device.exchange(0.0);
    double least = 1.0;
    for (int n = 0; n < 20000; ++n) {
      const auto out = model.tick(sample);
      if (n > 10000) least = std::min(least, device.meter().value());  // the ledger rounds down
      device.move_to(motion.next({device.position(), -1.0, device.position(), out.force}, random));
      sample = device.exchange(out.force);
    }
    return least;
  };
  CHECK(least_after_filling(1e-3) >= 1e-3);
  CHECK(least_after_filling(0.0) < 1e-3);
}

TEST_CASE("a tank that predicts its outflow passes all but what the last motion would take",
          "[time domain]") {
  const auto tank = at<d1>(ph::predicting_tank{.reserve = 1e-3});
  situation<d1> now{.energy = 3e-3, .travel = 1e-3};  // going in
  const auto force = [&](double desired) { return allowed(tank, desired, now); };
  CHECK(force(-100.0) == -100.0);
  now.travel = -1e-3;
  CHECK(force(-1.5) == -1.5);
  CHECK_THAT(force(-8.0), WithinRel(-2.0, 1e-12));
  now.longest_tick = 2e-3;
  CHECK_THAT(force(-8.0), WithinRel(-1.0, 1e-12));
  now.energy = 0.5e-3;
  CHECK(force(-8.0) == 0.0);
  now.motion_known = false;  // nothing to predict from: the worst case
  now.energy = 3e-3;
  CHECK_THAT(force(-80.0), WithinRel(-std::sqrt(4.0 * 2e-3 * 0.03 / 2e-3), 1e-12));
}

TEST_CASE("the share that a predicting tank leaves is between 0 and 1, of a level of any sign",
          "[time domain]") {
  const auto tank = at<d1>(ph::predicting_tank{.reserve = 1e-3});
  const auto share = [&](double force, double travel, double energy) {
    const situation<d1> now{.energy = energy, .travel = travel};
    return tank.limit(force, now.port()).factor;
  };
  for (const double energy : {-1.0, 1e-3, 3e-3}) {
    CHECK(share(-8.0, 0.0, energy) == 1.0);   // at rest nothing is predicted to go out
    CHECK(share(-0.1, 1e-3, energy) == 1.0);  // and on the way in it comes in, in debt, too
    CHECK(share(-8.0, 1e-3, energy) == 1.0);
  }
  CHECK(share(-1.5, -1e-3, 3e-3) == 1.0);
  CHECK(share(-4.0, -1e-3, 3e-3) == 0.5);
  CHECK(share(-4.0, -1e-3, 1e-3) == 0.0);
  CHECK(share(-4.0, -1e-3, -1.0) == 0.0);
}

TEST_CASE("a tank that predicts its outflow feeds a hand of 5 N, one that does not, does not",
          "[time domain]") {
  CHECK(tapped(model_of<d1>(ph::predicting_tank{})) < -1e-3);
  CHECK(tapped(model_of<d1>(ph::energy_tank{})) >= -1e-12);
}

TEST_CASE("the two-layer tank lets out at most what it holds and takes all that comes in",
          "[time domain]") {
  ph::two_layer_tank parameters{.loan = 2e-3};
  auto tank = at<d1>(parameters);
  situation<d1> now;
  const auto force = [&](double desired) { return allowed(tank, desired, now); };
  const auto start_with = [&](double level) {
    parameters.loan = level;
    tank = at<d1>(parameters);
  };
  SECTION("on the way out T f·v ≤ H") {
    now.travel = -1e-3;  // 0.03 mJ of damping is credited
    CHECK_THAT(force(-8.0), WithinRel(-2.03, 1e-12));
    CHECK(force(-1.0) == -1.0);
  }
  SECTION("on the way in anything") {
    now.travel = 1e-3;
    CHECK(force(-8.0) == -8.0);
    start_with(0.0);
    CHECK(force(-8.0) == -8.0);
  }
  SECTION("the map holds on the way out") {
    parameters.force_per_joule = 100.0;
    start_with(2e-3);
    now.travel = -1e-6;
    CHECK_THAT(force(-8.0), WithinRel(-0.2, 1e-6));
    now.travel = 1e-6;
    CHECK(force(-8.0) == -8.0);
    now.travel = 0.0;
    CHECK(force(-8.0) == -8.0);
  }
  SECTION("the next tick may be longer than the last") {
    now.dt = 0.5e-3;
    now.travel = -1e-3;  // 0.06 mJ of damping is credited
    CHECK_THAT(force(-8.0), WithinRel(-1.03, 1e-12));
  }
  SECTION("the level controller drags until the level is there") {
    parameters = {.wanted = 3e-3, .refill = 1e4, .max_damping = 50.0};
    start_with(2e-3);
    now.travel = 1e-4;  // H = 2.0003 mJ: d = 9.997 N·s/m
    CHECK_THAT(force(0.0), WithinRel(-9.997 * 0.1, 1e-12));
    parameters.refill = 1e6;
    tank.set(parameters);
    CHECK_THAT(force(0.0), WithinRel(-50.0 * 0.1, 1e-12));
    start_with(3e-3);
    CHECK(force(0.0) == 0.0);
  }
  SECTION("the ledger: held force, damping, cap, lost and late ticks") {
    parameters.cap = 4e-3;
    tank.set(parameters);
    now.held = -1.0;
    now.travel = 1e-3;
    static_cast<void>(force(0.0));
    CHECK_THAT(level_of(tank), WithinRel(3.03e-3, 1e-12));
    static_cast<void>(force(0.0));
    CHECK_THAT(level_of(tank), WithinRel(4e-3, 1e-12));
    now.dt = 2e-3;
    static_cast<void>(force(0.0));
    CHECK_THAT(level_of(tank), WithinAbs(0.0, 1e-17));
    now = {.held = -1.0, .travel = 1e-3};
    static_cast<void>(force(0.0));
    CHECK_THAT(level_of(tank), WithinRel(1.03e-3, 1e-12));
    now.motion_known = false;
    CHECK(force(-1.0) == 0.0);
    CHECK_THAT(level_of(tank), WithinAbs(0.0, 1e-17));
  }
  SECTION("its first tick keeps the loan") {
    now.motion_known = false;
    static_cast<void>(force(0.0));
    CHECK_THAT(level_of(tank), WithinRel(2e-3, 1e-12));
  }
}

TEST_CASE("the two-layer tank reproduces the swing of S0 (docs/design/mathematics.md § 5)",
          "[time domain]") {
  CHECK_THAT(attacks::drop(model_of<d1>(level_tank)).swing, WithinRel(47.7e-3, 0.1));
}

TEST_CASE("the two-layer tank is not passive, with strict_bound behind it it is", "[time domain]") {
  const auto alone = model_of<d1>(level_tank);
  CHECK(tapped(alone) < -1e-4);
  CHECK(attacks::worst_of<d1>(alone, {}).least < -1e-3);
  const auto chain = model_of<d1>(ph::bound_chain{level_tank, ph::strict_bound{}});
  static_assert(decltype(chain)::passivity == ph::guarantee::strict);
  CHECK(tapped(chain) >= -1e-12);
  CHECK(attacks::worst_of<d1>(chain, {}).least >= -1e-12);
}

TEST_CASE("the two-layer tank takes new parameters, refuses bad ones and starts anew",
          "[time domain]") {
  CHECK(ph::two_layer_tank{.max_damping = -1.0}.check());
  CHECK_FALSE(ph::two_layer_tank{.wanted = 0.015, .cap = 0.015}.check());
  const ph::two_layer_tank weak{.wanted = 0.015, .refill = 10.0, .max_damping = 5.0},
      bad{.cap = -1};
  check_upkeep(following_half_space<d1>(ph::spring{}, thesis_ledger(), level_tank), level_tank,
               weak, bad);
}
