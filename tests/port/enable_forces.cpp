// SPDX-License-Identifier: BSD-3-Clause
// Forces that the driver drops, and switches on again.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/compositions.hpp>
#include <passive_haptics/simulation/device.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace sim = ph::simulation;
using Catch::Matchers::WithinRel;
using ph::event;

namespace {

constexpr ph::exact_device device{.mass = 0.1, .damping = 0.1, .force_limit = 9.0};
constexpr ph::encoder_device encoders{.mass = 0.1,
                                      .damping = 0.1,
                                      .friction = 0.15,
                                      .presliding = 1e-5,
                                      .quantum = 3e-5,
                                      .force_limit = 9.0};
constexpr ph::known_hand hand{.force = 5.0};
constexpr ph::half_space<d1> floor_of_2000{0.0, 1.0, 2000.0};

/// A finger on a simulated device, whose motors may be off.
struct finger {
  sim::device<d1, sim::impedance_hand<d1>> of{{.mass = 0.1, .damping = 0.2, .start = 0.005},
                                              {.stiffness = 300, .damping = 1, .limit = 4}};
  ph::device_sample<d1> sample = of.exchange(0.0);
  event what{};
  double force = 0.0, energy = 0.0, largest_step = 0.0;

  void hold(auto& port, double target, int ticks, bool motors = true) {
    of.hand().target = target;
    for (int n = 0; n < ticks; ++n) {
      const auto out = port.tick(sample.position, 1ms);
      largest_step = std::max(largest_step, std::abs(out.force - force));
      what = out.what;
      force = out.force;
      energy = out.energy;
      sample = of.exchange(motors ? out.force : 0.0);
    }
  }
};

template <class Port>
void nothing_is_credited(Port port) {
  finger f;
  f.hold(port, -0.004, 1000);
  REQUIRE(f.force > 0.5);
  const double before = f.energy;
  port.enable_forces(false);
  f.hold(port, -0.004, 1, false);
  CHECK(f.what == event::forces_off);
  CHECK(f.force == 0.0);
  const double written_off = f.energy;
  CHECK(written_off < before);
  for (const double target : {-0.02, 0.02, -0.02, 0.005}) {
    f.hold(port, target, 200, false);
    CHECK(f.what == event::forces_off);
    CHECK(f.force == 0.0);
    CHECK(f.energy == written_off);
  }
  port.enable_forces(true);
  f.hold(port, 0.005, 1);
  CHECK(f.what == event::nominal);
  CHECK(f.energy <= written_off);
}

}  // namespace

TEST_CASE("while the forces are off the ledger waits, whatever moves", "[port]") {
  auto touch = ph::make_touch<d1>(device, hand);
  (void)touch.update(floor_of_2000);
  nothing_is_credited(touch);
  auto strict = ph::make_touch<d1>(device, ph::any_hand);
  (void)strict.update(floor_of_2000);
  nothing_is_credited(strict);
  auto on_steps = ph::make_touch<d1>(encoders, hand);
  (void)on_steps.update(floor_of_2000);
  nothing_is_credited(on_steps);
  auto set = ph::make_contacts<d1>(device, hand, ph::slots<ph::half_space<d1>, 2>{});
  set.source().update(0, floor_of_2000);
  nothing_is_credited(set);
}

TEST_CASE("a port that nobody tells credits what moves while the motors are off", "[port]") {
  auto touch = ph::make_touch<d1>(device, hand);  // the control
  (void)touch.update(floor_of_2000);
  finger f;
  f.hold(touch, -0.004, 1000);
  const double before = f.energy;
  f.hold(touch, -0.02, 200, false);
  CHECK(f.energy > before + 1e-3);
}

TEST_CASE("within a second after the forces are on a wall is felt as before, and did not step",
          "[port]") {
  const auto comes_back = [](auto port, double most_step) {
    finger f;
    f.hold(port, -0.004, 1000);
    const double before = f.force;
    port.enable_forces(false);
    f.hold(port, -0.004, 500, false);  // it falls through to its target
    CHECK(port.explain().stiffness == ph::softened_by::forces_off);
    port.enable_forces(true);
    f.largest_step = 0.0;
    f.force = 0.0;
    f.hold(port, -0.004, 1000);
    INFO(f.largest_step << " N, and " << f.energy << " J");
    CHECK_THAT(f.force, WithinRel(before, 0.02));
    CHECK(f.largest_step < most_step);
    CHECK(f.what == event::nominal);
    CHECK(f.of.meter().minimum() > -ph::amends_for(9.0));
  };
  auto touch = ph::make_touch<d1>(device, hand);
  (void)touch.update(floor_of_2000);
  comes_back(touch, 0.1);
  auto set = ph::make_contacts<d1>(device, hand, ph::slots<ph::half_space<d1>, 2>{});
  set.source().update(0, floor_of_2000);
  comes_back(set, 0.5);  // most of it is the finger's motion, 8 mm/s
}

TEST_CASE("a finger that moves when the forces are on again is no stranger, and is met softly",
          "[port]") {
  const auto falls_in = [](auto port, int on, int off) {
    finger f;
    f.of.hand() = {.stiffness = 400, .damping = 5, .limit = 5};
    f.hold(port, -0.008, on);
    port.enable_forces(false);
    f.hold(port, -0.008, off, false);
    port.enable_forces(true);
    f.largest_step = f.force = 0.0;
    bool is_stranger = false;
    for (int n = 0; n < 300; ++n) {
      f.hold(port, -0.008, 1);
      is_stranger = is_stranger || f.what == event::outside_force;
    }
    INFO(on << ", " << off << " ms: " << f.largest_step << " N, " << f.of.meter().minimum()
            << " J");
    CHECK_FALSE(is_stranger);
    CHECK(f.largest_step < 1.0);  // K v dt is 0.5 N
    CHECK(f.of.meter().minimum() >= -1e-12);
  };
  for (const int off : {5, 10, 20, 40}) {
    for (int on = 600; on < 728; ++on) {  // a test of its motion may go on just then
      auto touch = ph::make_touch<d1>(device, hand);
      (void)touch.update(floor_of_2000);
      falls_in(touch, on, off);
      if (on % 32 != 0) continue;
      auto set = ph::make_contacts<d1>(device, hand, ph::slots<ph::half_space<d1>, 2>{});
      set.source().update(0, floor_of_2000);
      falls_in(set, on, off);
    }
  }
}

TEST_CASE("forces that are off stay off until they are switched on", "[port]") {
  auto port = ph::make_guard<d1>(device, hand);
  CHECK(port.tick(0.0, 1ms, 0.0).what == event::nominal);
  port.enable_forces(true);  // they are
  CHECK(port.tick(0.0, 1ms, 0.0).what == event::nominal);
  port.enable_forces(false);
  CHECK_FALSE(port.set(ph::actuator_limit{.most = 5.0}));
  CHECK(port.tick(0.0, 1ms, 1.0).what == event::forces_off);
  port.reset();
  CHECK(port.tick(0.0, 1ms, 1.0).what == event::forces_off);
  auto nowhere = ph::device_sample<d1>{};
  nowhere.valid = false;
  CHECK(port.tick(nowhere, 1.0).what == event::rejected_sample);  // and force zero, as ever
  CHECK(port.tick(std::nan(""), 1ms, 1.0).force == 0.0);
  port.enable_forces(true);
  CHECK(port.tick(0.0, 1ms, 0.0).what == event::nominal);
}

TEST_CASE("to switch forces off and on mends nothing else", "[port]") {
  ph::force_guard<d1> unset;
  unset.enable_forces(false);
  CHECK(unset.tick(0.0, 1ms, 1.0).what == event::forces_off);
  unset.enable_forces(true);
  CHECK(unset.tick(0.0, 1ms, 1.0).what == event::rejected_parameters);

  auto touch = ph::make_touch<d1>(device, hand);
  (void)touch.update(floor_of_2000);
  finger f;
  f.of.hand().target = -0.01;
  for (int n = 0; n < 200; ++n) {  // its amplifier is turned round
    const auto out = touch.tick(f.sample);
    f.what = out.what;
    f.sample = f.of.exchange(-out.force);
  }
  REQUIRE(f.what == event::wrong_sign);
  touch.enable_forces(false);
  touch.enable_forces(true);
  CHECK(touch.tick(0.0, 1ms).what == event::wrong_sign);
}

namespace {

/// The least energy at the port of a finger that presses and rocks on a wall which heaves, while the motors go off and
/// on at random, each time by themselves, in the midst of a session. Nobody `tells`, or the port is told a tick later.
template <class Port>
double least_energy(Port port, bool tells, unsigned seed) {
  std::minstd_rand random(seed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  sim::device<d1, sim::impedance_hand<d1>> axis({.mass = 0.1, .damping = 0.1, .start = 0.01},
                                                {.stiffness = 600, .damping = 0.5, .limit = 5.0});
  auto sample = axis.exchange(0.0);
  bool on = true;
  for (int n = 0; n < 20000; ++n) {
    if (n % 33 == 0) (void)port.update({6e-3 * std::sin(3e-3 * n), 1.0, 3000.0});
    axis.hand().target = 8e-3 * std::sin(0.02 * n) - 2e-3;
    const bool was_on = on;
    if (share(random) < 0.02) on = !on;
    if (tells && (n > 0) && was_on != on && on) port.enable_forces(true);
    const double force = port.tick(sample.position, 1ms).force;
    if (!on && was_on) {  // it drops this force at once, and the port hears of it after the tick
      if (tells) port.enable_forces(false);
    }
    sample = axis.exchange(on ? force : 0.0);
  }
  return axis.meter().minimum();
}

}  // namespace

TEST_CASE("motors that go off by themselves create nothing, if they are told of within a tick",
          "[port]") {
  constexpr ph::exact_device light{.mass = 0.1, .damping = 0.1, .force_limit = 9.0};
  double untold = 0.0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    CHECK(least_energy(ph::make_touch<d1>(light, ph::any_hand), true, seed) > -1e-12);
    CHECK(least_energy(ph::make_touch<d1>(light, hand), true, seed) > -1e-12);
    untold = std::min(untold, least_energy(ph::make_touch<d1>(light, ph::any_hand), false, seed));
  }
  CHECK(untold < -1e-3);  // the control
}
