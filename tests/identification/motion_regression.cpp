// SPDX-License-Identifier: BSD-3-Clause
// Mass, damping, friction, load and latency from positions with steps: against the simulated truth, and
// what must not count.
#include "support/catch.hpp"
#include <passive_haptics/device/space.hpp>
#include <passive_haptics/identification/motion_regression.hpp>
#include <passive_haptics/identification/relay_motion.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/schedule.hpp>

namespace ph = passive_haptics;
namespace sim = ph::simulation;
using namespace ph::identification;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using d1 = ph::space<double, 1>;

namespace {

struct shaking {
  double jitter = 0.0;     // share of a period
  int lose_every = 0;      // samples; 0: none
  double half_late = 0.0;  // share of the force that comes a tick later still
};

/// Four seconds of a relay on a device, as the regression sees them.
motion_found shaken(const sim::device_parameters<d1>& truth, const shaking& how = {}) {
  sim::device<d1> device(truth);
  sim::random_source random(3);
  motion_regression regression;
  relay_motion relay;
  double force = 0.0, before = 0.0, x = 0.0, v = 0.0;
  for (int n = 0; n < 4000; ++n) {
    if (how.jitter > 0.0) (void)device.set_period(1e-3 * (1.0 - how.jitter * random.uniform()));
    const auto sample = device.exchange((1.0 - how.half_late) * force + how.half_late * before);
    before = force;
    if (how.lose_every > 0 && n % how.lose_every == 0) {
      regression.interrupt();
      continue;
    }
    v += ((sample.position - x) / sample.dt - v) / 3.0;
    x = sample.position;
    regression.sample(x, sample.dt);
    (void)regression.book(24, n / 340, 0.03, truth.quantum, relay.turned_at());
    force = relay.tick(x, v, 2.0, 8e-3, 1.5 * truth.quantum + 20e-6);
    regression.commanded(force);
  }
  return regression.conclude();
}

}  // namespace

TEST_CASE("the regression finds mass, damping, friction, load and latency of a device with steps",
          "[identification]") {
  for (const int latency : {0, 2}) {
    const auto found = shaken({.mass = 0.2,
                               .damping = 0.4,
                               .friction = 0.1,
                               .quantum = 20e-6,
                               .load = 0.3,
                               .latency = latency});
    CAPTURE(latency);
    CHECK(found.windows > 500);
    CHECK(found.latency == latency);
    CHECK_THAT(found.exactly.value, WithinAbs(latency, 0.05));
    CHECK_THAT(found.mass.value, WithinRel(0.2, 0.005));
    CHECK_THAT(found.damping[0].value, WithinRel(0.4, 0.1));
    CHECK_THAT(found.damping[1].value, WithinRel(0.4, 0.1));
    CHECK_THAT(found.friction.value, WithinRel(0.1, 0.1));
    CHECK_THAT(found.load.value, WithinAbs(0.3, 0.01));
    CHECK(found.explained > 0.999);
    // and says how sure it is, neither too little nor too much
    CHECK(std::abs(found.mass.value - 0.2) < 5.0 * found.mass.deviation);
    CHECK(std::abs(found.friction.value - 0.1) < 5.0 * found.friction.deviation);
    CHECK(found.friction.deviation < 0.01);
  }
}

TEST_CASE("the regression takes ticks as long as they are, and no window across a lost sample",
          "[identification]") {
  const sim::device_parameters<d1> truth{.mass = 0.2, .damping = 0.4, .quantum = 5e-6};
  const auto even = shaken(truth);
  const auto uneven = shaken(truth, {.jitter = 0.4});
  CHECK_THAT(uneven.mass.value, WithinRel(0.2, 0.005));
  CHECK_THAT(uneven.damping[0].value, WithinRel(0.4, 0.1));
  const auto gaps = shaken(truth, {.lose_every = 60});
  CHECK(gaps.windows > 200);
  CHECK(gaps.windows < even.windows);
  CHECK_THAT(gaps.mass.value, WithinRel(0.2, 0.01));
  CHECK(shaken(truth, {.lose_every = 20}).windows == 0);
}

TEST_CASE("the regression sees a force that changes in mid-tick", "[identification]") {
  const sim::device_parameters<d1> truth{.mass = 0.2, .damping = 0.4, .quantum = 5e-6};
  const auto half = shaken(truth, {.half_late = 0.4});
  CHECK(std::abs(half.exactly.value - half.latency) > 0.3);
  CHECK(std::abs(shaken(truth).exactly.value) < 0.05);  // the control
}

TEST_CASE("the regression counts no window of a device that stands, creeps, or turns",
          "[identification]") {
  const auto booked = [](auto way) {
    motion_regression regression;
    for (int n = 0; n < 60; ++n) {
      regression.sample(way(n * 1e-3), 1e-3);
      regression.commanded(0.0);
    }
    return regression.book(24, 0, 0.03, 1e-6, -1.0);
  };
  CHECK(booked([](double t) { return 0.1 * t; }));  // the control
  CHECK(booked([](double t) { return -0.1 * t; }));
  CHECK_FALSE(booked([](double) { return 0.0; }));
  CHECK_FALSE(booked([](double t) { return 0.02 * t; }));
  CHECK_FALSE(booked([](double t) { return 2.0 * (t - 0.048) * (t - 0.048); }));
  CHECK(motion_regression().conclude().windows == 0);
}
