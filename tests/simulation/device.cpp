// SPDX-License-Identifier: BSD-3-Clause
// The simulated device as a whole: no joule lost, no lemma broken.
#include "simulation/reference.hpp"
#include "support/catch.hpp"
#include "support/scripted_device.hpp"
#include <passive_haptics/simulation/adversary.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/prescribed_motion.hpp>

#include <array>
#include <cmath>
#include <limits>

namespace sim = ph::simulation;
using namespace simulated;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

template <class Space>
constexpr bool is_modelled = ph::haptic_device_for<sim::device<Space>, Space>&&
    ph::haptic_device_for<sim::device<Space, sim::impedance_hand<Space>>, Space>&&
        ph::haptic_device_for<sim::prescribed_motion<Space>, Space>&&
            ph::haptic_device_for<scripted_device<sim::device<Space>, 2>, Space>&& sim::hand_for<
                sim::no_hand<Space>, Space>&& sim::hand_for<sim::constant_hand<Space>, Space>&&
                sim::hand_for<sim::impedance_hand<Space>, Space>&&
                    sim::hand_for<sim::tapping_hand<Space>, Space>&&
                        sim::adversary_for<sim::nyquist_motion<Space>, Space>&&
                            sim::adversary_for<sim::random_walk<Space>, Space>&&
                                sim::adversary_for<sim::greedy_motion<Space>, Space>;
static_assert(is_modelled<ph::space<float, 1>> && is_modelled<line>);
static_assert(is_modelled<ph::space<float, 2>> && is_modelled<plane>);
static_assert(is_modelled<ph::space<float, 3>> && is_modelled<room>);
/// Devices as members, with their parameters in place: g++ 12 crashed on the first.
struct bench_of_devices {
  sim::device<d1> one{{.mass = 0.1}};
  sim::device<f3, sim::impedance_hand<f3>> with_hand{{.mass = 0.1, .lower = {-1, -1, -1}},
                                                     {.limit = 5.0}};
  sim::prescribed_motion<d3> moved{{.mass = 0.1}};
};

struct mute {};
static_assert(!ph::haptic_device_for<mute, line> && !sim::hand_for<mute, line> &&
              !sim::adversary_for<mute, line>);

struct worked {
  double residual, stops, friction, hand, kinetic, from_samples, port;
  bool saturated;
};

/// A wall and random jolts against a hand that strokes, with everything switched on.
template <class Space>
worked work(int ticks) {
  using hand = sim::impedance_hand<Space>;
  sim::device_parameters<Space> parameters{.friction = 0.1,
                                           .force_limit = 9.0,
                                           .quantum = 1e-5,
                                           .lower = sim::every_axis<Space>(-0.03),
                                           .upper = sim::every_axis<Space>(0.04),
                                           .load = sim::every_axis<Space>(-0.4),
                                           .start_velocity = sim::every_axis<Space>(0.2),
                                           .latency = 2};
  sim::device<Space, hand> device{parameters,
                                  hand{.stiffness = 400.0, .limit = 8.0, .own_mass = 0.05}};
  REQUIRE_FALSE(device.check());
  sim::random_source random{11};
  typename Space::vector force = Space::zero();
  ph::compensated_sum<double> sampled;
  bool saturated = false;
  for (int n = 0; n < ticks; ++n) {
    if (n % 500 == 0) {
      device.hand().aim(random.template direction<Space>() * random.uniform(0.0, 0.08),
                        sim::physical<Space>::zero(), device.time());
    }
    device.set_period(random.uniform(0.5e-3, 1.5e-3));
    const auto before = device.position();
    const ph::device_sample<Space> sample = device.exchange(force);
    const typename Space::vector held = sample.held;
    const typename sim::physical<Space>::vector moved = device.position() - before;
    sampled += -sim::physical<Space>::dot(sim::to_physical<Space>(held), moved);
    saturated = saturated || static_cast<double>(Space::norm(held)) > 9.0 * (1 - 1e-6);
    for (int i = 0; i < Space::dof; ++i) {
      const auto x = static_cast<double>(sim::component(sample.position, i));
      sim::component(force, i) =
          static_cast<typename Space::scalar>(x < 0.0 ? -2000.0 * x : random.uniform(-0.5, 0.5));
    }
  }
  const sim::energy_flows total = device.meter().total();
  sampled += total.damping;
  return {device.residual(), total.stops,     total.friction,         total.hand,
          device.kinetic(),  double(sampled), device.meter().value(), saturated};
}

}  // namespace

TEMPLATE_TEST_CASE("device loses no joule in 1e5 ticks with everything switched on",
                   "[simulation][device][law]", line, plane, room, (ph::space<float, 1>),
                   (ph::space<float, 3>)) {
  const worked run = work<TestType>(100000);
  CHECK(std::abs(run.residual) < 1e-12);
  CHECK_THAT(run.from_samples, WithinAbs(run.port, 1e-11));  // Δ of rounded positions
  CHECK(run.saturated);
  SECTION("control: every flow is there, and leaving one out would show") {
    CHECK(run.stops > 1e-3);
    CHECK(run.friction > 1e-3);
    CHECK(std::abs(run.hand) > 1e-3);
    CHECK(std::abs(run.residual - run.stops) > 1e-12);
    CHECK(std::abs(run.residual - run.friction) > 1e-12);
    CHECK(std::abs(run.residual + 1e-9 * run.hand) > 1e-12);
  }
}

TEST_CASE("a held spring on a lossless mass leaks K Δx²/2 per tick (lemma L2)",
          "[simulation][device][law]") {
  const double K = 2000.0;
  sim::device<line> device{{.damping = 0.0, .start = -0.005}};
  double force = 0.0, leak = 0.0, wrong_pairing = 0.0;
  double last = device.exchange(force).position;
  const double first = last;
  const double before = device.meter().value();
  for (int n = 0; n < 300; ++n) {
    force = -K * last;
    const double next = device.exchange(force).position;
    leak += K * (next - last) * (next - last) / 2;
    wrong_pairing += -K * next * (next - last);
    last = next;
    const double spring = K * (last * last - first * first) / 2;
    CHECK_THAT(device.meter().value() - before, WithinAbs(spring - leak, 1e-12 * (1 + spring)));
  }
  CHECK(leak > 1e-3);
  CHECK(device.meter().minimum() < -1e-3);
  // control: pairing the NEW force with the last displacement has the opposite sign
  CHECK(std::abs(-wrong_pairing - (device.meter().value() - before)) > 1e-3);
}

namespace {

/// Does the swing on a sampled, delayed spring grow?
bool grows(double K, double b, int latency) {
  sim::device<line> device{{.damping = b, .start = 0.01, .latency = latency}};
  double force = 0.0;
  const double first = K * 0.01 * 0.01 / 2;
  double energy = first;
  for (int n = 0; n < 400000 && energy < 1e8 * first && energy > 1e-8 * first; ++n) {
    const double x = device.exchange(force).position;
    force = -K * x;
    energy = device.kinetic() + K * x * x / 2;
  }
  return energy > first;
}

}  // namespace

TEST_CASE("device is stable 2 % below K = b/(T/2 + t_d), and not 2 % above",
          "[simulation][device][law]") {
  for (const int latency : {0, 2}) {
    const double b = 0.3, theory = b / (0.5e-3 + latency * 1e-3);
    CHECK_FALSE(grows(0.98 * theory, b, latency));
    CHECK(grows(1.02 * theory, b, latency));
  }
}

TEST_CASE("device without a hand does not depend on how often the hand is asked",
          "[simulation][device]") {
  using pressing = sim::device<line, sim::constant_hand<line>>;
  pressing coarse{{.substeps = 1}, {.push = -1.0}};
  pressing fine{{.substeps = 50}, {.push = -1.0}};
  for (int n = 0; n < 1000; ++n) {
    coarse.exchange(n % 3 == 0 ? 1.5 : 0.8);
    fine.exchange(n % 3 == 0 ? 1.5 : 0.8);
  }
  CHECK_THAT(coarse.position(), WithinRel(fine.position(), 1e-12));
  CHECK_THAT(coarse.meter().value(), WithinRel(fine.meter().value(), 1e-11));
}

TEST_CASE("a device is a member of a class, its parameters in place", "[simulation][device]") {
  bench_of_devices bench;
  CHECK(bench.one.exchange(1.0).valid);
  CHECK(bench.one.parameters().upper == std::numeric_limits<double>::infinity());
  CHECK(bench.with_hand.exchange({0, 0, 1}).valid);
  CHECK_FALSE(bench.with_hand.check());
  CHECK(bench.moved.exchange({0, 0, 1}).valid);
}

TEST_CASE("a device delivers what it holds times its gain, axis by axis, and reports what it holds",
          "[simulation][device]") {
  sim::device<d2> off({.damping = 0.0, .gain = {0.9, 1.1}});
  sim::device<d2> right({.damping = 0.0});
  const auto told = off.exchange({1.0, 1.0}).held;
  (void)right.exchange({1.0, 1.0});
  CHECK(told[0] == 1.0);
  CHECK(told[1] == 1.0);
  CHECK_THAT(off.velocity()[0], WithinRel(0.9 * right.velocity()[0], 1e-12));
  CHECK_THAT(off.velocity()[1], WithinRel(1.1 * right.velocity()[1], 1e-12));
  CHECK_THAT(off.residual(), WithinAbs(0.0, 1e-15));
}

TEST_CASE("device names its first bad parameter and then does not move", "[simulation][device]") {
  using parameters = sim::device_parameters<line>;
  CHECK_FALSE(parameters{}.check());
  const std::array bad{parameters{.mass = 0.0},          parameters{.damping = -1.0},
                       parameters{.friction = infinity}, parameters{.force_limit = not_a_number},
                       parameters{.quantum = -1.0},      parameters{.lower = 1.0, .upper = -1.0},
                       parameters{.load = not_a_number}, parameters{.period = 0.0},
                       parameters{.start = infinity},    parameters{.start_velocity = infinity},
                       parameters{.substeps = 0},        parameters{.latency = 9},
                       parameters{.upper = -1.0},        parameters{.latency = -1}};
  for (const parameters& p : bad) {
    sim::device<line> device{p};
    const auto fault = device.check();
    CHECK(fault);
    CAPTURE(fault.parameter);
    CHECK_FALSE(device.exchange(1.0).valid);
    CHECK(device.time() == 0.0);
  }
  sim::device<line, sim::impedance_hand<line>> lame{{}, {.stiffness = -1.0}};
  CHECK(lame.check());
  sim::device<line> jittery;
  CHECK_FALSE(jittery.set_period(0.0));
  CHECK_FALSE(jittery.set_period(not_a_number));
  CHECK(jittery.set_period(2e-3));
  CHECK(jittery.exchange(1.0).dt == 2e-3);
  CHECK(jittery.time() == 2e-3);
  const reference moved = solve(0.1, 0.03, 1.0, 0.0, 2e-3);  // and it really moves for that long
  CHECK_THAT(jittery.position(), WithinRel(double(moved.position), 1e-14));
}

TEMPLATE_TEST_CASE("a watchdog splits a period of the device in two, exactly", "[simulation]", d1,
                   f1) {
  using scalar = typename TestType::scalar;
  sim::device<TestType> whole{{.friction = 0.02, .start_velocity = 0.1, .watchdog = 1e-3}};
  sim::device<TestType> parts{{.friction = 0.02, .start_velocity = 0.1}};
  CHECK(whole.exchange(scalar(2)).held == scalar(2));
  parts.exchange(scalar(2));
  CHECK(whole.position() == parts.position());  // not yet
  for (const double T : {2e-3, 7e-3, 20e-3}) {
    whole.set_period(T);
    parts.set_period(1e-3);
    parts.exchange(scalar(-3));
    parts.set_period(T - 1e-3);
    parts.exchange(scalar(0));
    CHECK(whole.exchange(scalar(-3)).held == scalar(-3));
    CHECK_THAT(whole.position(), WithinAbs(parts.position(), 1e-9));
    CHECK_THAT(whole.velocity(), WithinAbs(parts.velocity(), 1e-7));
    CHECK_THAT(whole.meter().value(), WithinAbs(parts.meter().value(), 1e-9));
    CHECK(std::abs(whole.residual()) < 1e-14);
  }
  CHECK(whole.velocity() > 0.0);   // held to the end, −3 N would have turned it
  CHECK(whole.velocity() < 0.05);  // and dropped at once, not slowed it
}
