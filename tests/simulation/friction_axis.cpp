// SPDX-License-Identifier: BSD-3-Clause
// A simulated device with elastic friction: no joule lost, and the motion that the models ask for.
#include "simulation/reference.hpp"
#include "support/catch.hpp"
#include <passive_haptics/design/frequency.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/friction.hpp>
#include <passive_haptics/simulation/prescribed_motion.hpp>
#include <passive_haptics/simulation/schedule.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace sim = ph::simulation;
using namespace simulated;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double c = 0.2;    // [N]
constexpr double p = 15e-6;  // [m]
const sim::slider_and_spring slider{.level = {c}, .presliding = {p}};

struct worked {
  double residual, damping, friction, stored, stops, hand;
};

/// A wall and random jolts against a hand that strokes, with everything switched on.
template <class Space>
worked work(sim::friction_kind kind, int ticks) {
  using hand = sim::impedance_hand<Space>;
  const sim::device_parameters<Space> parameters{.force_limit = 9.0,
                                                 .quantum = 1e-5,
                                                 .lower = sim::every_axis<Space>(-0.01),
                                                 .upper = sim::every_axis<Space>(0.012),
                                                 .load = sim::every_axis<Space>(-0.4),
                                                 .start_velocity = sim::every_axis<Space>(0.2),
                                                 .latency = 1,
                                                 .watchdog = 1.2e-3};
  sim::device<Space, hand, sim::friction_like> device{
      parameters, hand{.stiffness = 400.0, .limit = 8.0, .own_mass = 0.05}, {kind, 0.1, p, 0.5}};
  REQUIRE_FALSE(device.check());
  sim::random_source random{11};
  typename Space::vector force = Space::zero();
  for (int n = 0; n < ticks; ++n) {
    if (n % 500 == 0) {
      device.hand().aim(random.template direction<Space>() * random.uniform(0.0, 0.08),
                        sim::physical<Space>::zero(), device.time());
    }
    device.set_period(random.uniform(0.5e-3, 1.5e-3));
    const auto sample = device.exchange(force);
    for (int i = 0; i < Space::dof; ++i) {
      const auto x = static_cast<double>(sim::component(sample.position, i));
      sim::component(force, i) =
          static_cast<typename Space::scalar>(x < 0.0 ? -2000.0 * x : random.uniform(-0.5, 0.5));
    }
  }
  const auto total = device.meter().total();
  return {device.residual(), total.damping, total.friction, total.stored, total.stops, total.hand};
}

}  // namespace

TEMPLATE_TEST_CASE("a device with elastic friction loses no joule, whatever the friction",
                   "[simulation][friction][law]", line, room) {
  for (const auto kind : sim::all_friction_kinds) {
    CAPTURE(to_string(kind));
    const worked run = work<TestType>(kind, 1500);
    CHECK(std::abs(run.residual) < 1e-12);
    CHECK(run.friction > 1e-3);
    CHECK(run.stops > 1e-3);
    CHECK(run.damping > 1e-4);
    CHECK(std::abs(run.hand) > 1e-3);
    CHECK(std::abs(run.stored) > 1e-9);  // control: left out, it would show
    CHECK(std::abs(run.residual - run.stored) > 1e-12);
  }
}

TEST_CASE("a block on elastic friction goes as far as its energy says, and rings within p",
          "[simulation][friction]") {
  const double m = 0.1, v = 0.05;
  sim::device<line, sim::no_hand<line>, sim::slider_and_spring> device{
      {.mass = m, .damping = 0.0, .start_velocity = v}, {}, slider};
  double farthest = 0.0;
  for (int n = 0; n < 100; ++n) {
    device.exchange(0.0);
    farthest = std::max(farthest, device.position());
  }
  // ½ m v² = c (x − p) + ½ c p, with a sample a millisecond to see it
  const double wanted = p / 2 + m * v * v / (2 * c);
  CHECK(farthest < wanted * (1 + 1e-6));
  double least = infinity, most = 0.0;
  for (int n = 0; n < 2000; ++n) {
    device.exchange(0.0);
    least = std::min(least, device.position());
    most = std::max(most, device.position());
  }
  CHECK_THAT(most, WithinAbs(wanted, 1e-9));
  CHECK_THAT(least, WithinAbs(wanted - 2 * p, 1e-9));
  CHECK(std::abs(device.residual()) < 1e-15);

  SECTION("and rings at √(c/(p m)), slow by less than 1/3000") {
    const double omega = std::sqrt(c / (p * m));
    sim::device<line, sim::no_hand<line>, sim::slider_and_spring> rings{
        {.mass = m, .damping = 0.0, .start_velocity = 0.5 * omega * p}, {}, slider};
    double phase = 0.0, last = 0.0, crossed = 0.0;
    int crossings = 0;
    for (int n = 0; n < 4000; ++n) {
      const double x = rings.exchange(0.0).position;
      if (last < 0.0 && x >= 0.0) {
        crossed = rings.time() - 1e-3 * x / (x - last);
        ++crossings;
      }
      last = x;
    }
    phase = omega * crossed / (2 * ph::design::pi);
    CHECK(crossings > 200);
    CHECK_THAT(phase, WithinRel(double(crossings), 1.0 / 3000));
  }
}

TEST_CASE("as p goes to zero, elastic friction is the rigid one", "[simulation][friction]") {
  const auto end_of = [](auto device) {
    for (int n = 0; n < 300; ++n) device.exchange(0.5 * std::sin(0.02 * n));
    return device.position();
  };
  const sim::device_parameters<line> smooth{.damping = 20.0};  // or it rings, and breaks away early
  auto rigid = smooth;
  rigid.friction = c;
  const double wanted = end_of(sim::device<line>{rigid});
  double last = infinity;
  for (const double presliding : {100e-6, 10e-6, 1e-6}) {
    const double off =
        std::abs(end_of(sim::device<line, sim::no_hand<line>, sim::slider_and_spring>{
                     smooth, {}, {{c}, {presliding}}}) -
                 wanted);
    CHECK(off < last);
    CHECK(off < 5 * presliding);
    last = off;
  }
}

TEST_CASE("one step is many: elastic friction is of second order in its step",
          "[simulation][friction]") {
  const auto after = [](double period) {  // soft enough for a step to be a whole period
    sim::device<line, sim::no_hand<line>, sim::friction_like> device{
        {.mass = 1.0, .period = period, .start_velocity = 0.02},
        {},
        {sim::friction_kind::dupont, 0.2, 2e-3}};
    while (device.time() < 0.1 - period / 2) device.exchange(0.3);
    return device.position();
  };
  const double exact = after(0.1 / 4096);
  const double coarse = std::abs(after(0.1 / 32) - exact);
  const double fine = std::abs(after(0.1 / 128) - exact);
  CHECK(coarse > 1e-9);
  CHECK(fine < coarse / 10);  // 16, were there no corner at z_ba
}

TEST_CASE("under half the friction and a tremor, elasto-plastic stays and LuGre drifts away",
          "[simulation][friction][law]") {
  const auto drift = [](sim::friction_kind kind) {
    sim::device<line, sim::no_hand<line>, sim::friction_like> device{
        {.damping = 0.5, .load = 0.5 * c}, {}, {kind, c, p}};
    double settled = 0.0;
    for (int n = 0; n < 20000; ++n) {
      device.exchange(0.3 * c * std::sin(2 * ph::design::pi * 0.009 * n));
      if (n == 2000) settled = device.position();
    }
    return device.position() - settled;
  };
  for (const auto kind :
       {sim::friction_kind::one_spring, sim::friction_kind::three_springs,
        sim::friction_kind::dupont, sim::friction_kind::stribeck, sim::friction_kind::rippled}) {
    CAPTURE(to_string(kind));
    CHECK(std::abs(drift(kind)) < p);  // the tremor itself is some 0.3 p
  }
  CHECK(drift(sim::friction_kind::dahl) > 20 * p);
  CHECK(drift(sim::friction_kind::lugre) > 5 * p);
}

TEST_CASE("a device with elastic friction stops at its end stop, rests there and leaves",
          "[simulation][friction]") {
  for (const auto kind : sim::all_friction_kinds) {
    CAPTURE(to_string(kind));
    sim::device<line, sim::no_hand<line>, sim::friction_like> device{
        {.upper = 1e-3, .start_velocity = 0.3}, {}, {kind, c, p}};
    for (int n = 0; n < 20; ++n) device.exchange(1.0);
    CHECK(device.position() == 1e-3);
    CHECK(device.velocity() == 0.0);
    const double lost = device.meter().total().stops;
    const double arrived = 0.1 * 0.09 / 2 + (1.0 - 0.3) * 1e-3;
    CHECK(lost > 0.9 * arrived);
    CHECK(lost < 0.1 * 0.09 / 2 + 1.0 * 1e-3);
    for (int n = 0; n < 20; ++n) device.exchange(-1.0);
    CHECK(device.position() < 0.9e-3);
    CHECK(device.meter().total().stops == lost);
    CHECK(std::abs(device.residual()) < 1e-15);
  }
}

TEST_CASE("a prescribed motion books what elastic friction takes and what its spring holds",
          "[simulation][friction]") {
  sim::prescribed_motion<room, sim::slider_and_spring> motion{{.damping = 0.03}, slider};
  sim::random_source random{3};
  const auto model = slider;
  std::array<sim::slider_and_spring::state, 3> memory{};
  double wanted = 0.0;
  for (int n = 0; n < 1000; ++n) {
    const room::vector step = random.direction<room>() * random.uniform(0.0, 4 * p);
    const room::vector force = random.direction<room>() * random.uniform(0.0, 9.0);
    motion.move_to(motion.position() + step);
    motion.exchange(force);
    wanted += 0.03 * step.squaredNorm() / 1e-3 - force.dot(step);
    for (int i = 0; i < 3; ++i) {
      wanted += model.slide(memory[static_cast<std::size_t>(i)], 0.0, step(i), 1e-3).work;
    }
  }
  CHECK_THAT(motion.meter().with_friction(), WithinAbs(wanted, 1e-14));
  CHECK_THAT(motion.meter().residual(0.0), WithinAbs(0.0, 1e-14));
  CHECK(motion.meter().rubbed());

  SECTION("what a spring held at the start may be taken out: ½ c p") {
    sim::prescribed_motion<line, sim::slider_and_spring> loaded{{}, {{c}, {p}, 1.0}};
    loaded.set_period(1e3);  // slowly, so that the damper takes nothing
    loaded.move_to(-p);
    loaded.exchange(0.0);
    CHECK_THAT(loaded.meter().with_friction(), WithinRel(-c * p / 2, 1e-6));
  }
}

TEST_CASE("a device has one friction or the other, not both", "[simulation][friction]") {
  using elastic = sim::device<line, sim::no_hand<line>, sim::slider_and_spring>;
  CHECK_FALSE(elastic{{}, {}, slider}.check());
  CHECK(std::string(elastic{{.friction = 0.1}, {}, slider}.check().parameter) == "friction");
  CHECK_FALSE(elastic({.friction = 0.1}, {}, slider).exchange(0.0).valid);
  CHECK(elastic{}.check());  // no presliding displacement is stated
  CHECK(sim::prescribed_motion<line, sim::slider_and_spring>{{.friction = 0.1}, slider}.check());
  CHECK_FALSE(sim::prescribed_motion<line, sim::slider_and_spring>{{}, {}}.exchange(0.0).valid);
}
