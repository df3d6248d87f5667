// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include "support/scripted_device.hpp"
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/loop.hpp>
#include <passive_haptics/simulation/prescribed_motion.hpp>
#include <passive_haptics/simulation/schedule.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace sim = ph::simulation;
using Catch::Matchers::WithinRel;

namespace {

auto strict_wall() {
  return ph::local_model{d1{},         ph::fixed{wall<d1>(1e4)}, ph::turn_at_once{},
                         ph::spring{}, thesis_ledger(),          ph::strict_bound{},
                         thesis_loop};
}
using strict_wall_type = decltype(strict_wall());

static_assert(sim::simulated_device<sim::device<d3>>);
static_assert(sim::simulated_device<sim::prescribed_motion<f2>>);
static_assert(sim::simulated_device<scripted_device<sim::device<d1>, 1>>);
struct no_meter {
  using space_type = d1;
  ph::device_sample<d1> exchange(double force);
  double position() const;
  double time() const;
};
static_assert(!sim::simulated_device<no_meter>);

// It throws only what a step throws, and a port throws nothing.
constexpr auto quiet = [](const auto&) noexcept {};
constexpr auto loud = [](const auto& now) {
  if (now.tick == 3) throw std::runtime_error("enough");
};
using any_device = sim::prescribed_motion<d1>;
static_assert(noexcept(sim::run(std::declval<any_device&>(), std::declval<strict_wall_type&>(),
                                1)));
static_assert(noexcept(sim::run(std::declval<any_device&>(), std::declval<strict_wall_type&>(), 1,
                                quiet, quiet, quiet)));
static_assert(!noexcept(sim::run(std::declval<any_device&>(), std::declval<strict_wall_type&>(), 1,
                                 loud)));

}  // namespace

TEST_CASE("run is the loop that anyone would write, to the last bit", "[simulation][loop]") {
  const auto hand = [](sim::random_source& random, double x, double force) {
    return force != 0.0 ? x + force * 1e-3 / 0.06 : x + random.uniform(-1e-4, 3e-4);
  };
  auto model = strict_wall();
  sim::prescribed_motion<d1> device({.start = -1e-3});
  sim::random_source random(1);
  double largest = 0.0;
  auto sample = device.exchange(0.0);
  for (int n = 0; n < 2000; ++n) {
    if (random.chance(0.05)) sample = {};
    const double force = model.tick(sample).force;
    largest = std::max(largest, std::abs(force));
    device.move_to(hand(random, device.position(), force));
    sample = device.exchange(force);
  }
  auto again = strict_wall();
  sim::prescribed_motion<d1> twin({.start = -1e-3});
  sim::random_source same(1);
  const auto seen = sim::run(
      twin, again, 2000,
      [&](auto& now) {
        if (same.chance(0.05)) now.sample = {};
      },
      [&](const auto& now) { twin.move_to(hand(same, now.position, now.force)); });
  CHECK(seen.least_energy == device.meter().minimum());
  CHECK(seen.largest_force == largest);
  CHECK(seen.largest_force > 0.0);
  CHECK(seen.ticks == 2000);
  CHECK(seen.last.position == sample.position);
  CHECK(seen.last.held == sample.held);
  CHECK(twin.meter().value() == device.meter().value());
  CHECK(again.energy() == model.energy());
}

TEST_CASE(
    "in a tick come the world, the model, the hand, the device and the watcher, in that order",
    "[simulation][loop]") {
  sim::prescribed_motion<d1> device({.quantum = 0.25});
  std::string order;
  double shown = -1.0;
  const auto model = [&](const ph::device_sample<d1>& sample) {
    order += 'm';
    shown = sample.position;
    return 2.0;  // a force is answer enough
  };
  const auto world = [&](auto& now) {
    order += 'w';
    CHECK(now.position == now.tick);  // the truth, at the start of the tick
    CHECK_THAT(now.time, WithinRel((now.tick + 1) * 1e-3, 1e-12));
    CHECK(now.sample.position == now.tick);
    now.sample.position += 0.5;  // a sensor that is off
  };
  const auto hand = [&](const auto& now) {
    order += 'h';
    CHECK(shown == now.tick + 0.5);
    CHECK(now.force == 2.0);
    CHECK(now.out == 2.0);
    device.move_to(now.position + 1.0);
  };
  const auto watch = [&](const auto& now) {
    order += '.';
    CHECK(device.position() == now.tick + 1);
    CHECK(now.position == now.tick);             // still of the start
    CHECK(now.sample.position == now.tick + 1);  // and this of the end
    CHECK(now.sample.held == 2.0);
  };
  const auto seen = sim::run(device, model, 3, world, hand, watch);
  CHECK(order == "wmh.wmh.wmh.");
  CHECK(seen.last.position == 3.0);
  CHECK(seen.least_energy == device.meter().minimum());
}

TEST_CASE("a step that returns false ends the run where it stands", "[simulation][loop]") {
  for (const int who : {0, 1, 2}) {
    sim::prescribed_motion<d1> device;
    auto model = strict_wall();
    int ticked = 0;
    const auto counting = [&](const auto& sample) {
      ++ticked;
      return model.tick(sample);
    };
    const auto until = [who](int step) {
      return [who, step](const auto& now) { return who != step || now.tick < 5; };
    };
    const auto seen = sim::run(device, counting, 100, until(0), until(1), until(2));
    CAPTURE(who);
    CHECK(ticked == (who == 0 ? 5 : 6));
    CHECK(seen.ticks == (who == 2 ? 6 : 5));
    CHECK_THAT(device.time(), WithinRel((seen.ticks + 1) * 1e-3, 1e-12));
  }
}

TEST_CASE("a command that is no number ends the run, and proves nothing", "[simulation][loop]") {
  sim::prescribed_motion<d1> device;
  int acted = 0;
  auto bad = [n = 0](const auto&) mutable { return ++n == 4 ? std::nan("") : 0.0; };
  const auto seen = sim::run(device, bad, 100, sim::idle, [&](const auto&) { ++acted; });
  CHECK(std::isnan(seen.least_energy));
  CHECK_FALSE(seen.least_energy >= -1e-12);
  CHECK(seen.ticks == 3);
  CHECK(acted == 3);
}

TEST_CASE("what dry friction takes counts for the port", "[simulation][loop]") {
  const auto least = [](double friction) {
    sim::prescribed_motion<d1> device({.friction = friction});
    const auto pull = [](const auto&) { return 1.0; };  // with the motion: 1 N · 10 mm
    return sim::run(device, pull, 100, sim::idle,
                    [&](const auto& now) { device.move_to(now.position + 1e-4); })
        .least_energy;
  };
  CHECK_THAT(least(0.0), WithinRel(-(1.0 - 0.003) * 1e-2, 1e-9));
  CHECK_THAT(least(0.5), WithinRel(-(0.5 - 0.003) * 1e-2, 1e-9));
  CHECK(least(1.0) == 0.0);
}

TEST_CASE("a device whose samples go wrong runs as any other, judged by the truth",
          "[simulation][loop]") {
  auto model = strict_wall();
  scripted_device device(sim::prescribed_motion<d1>{},
                         std::array{scripted_fault{3, sample_fault::no_answer}});
  int refused = 0;
  const auto seen = sim::run(device, model, 10, sim::idle, [&](const auto& now) {
    refused += now.out.what == ph::event::rejected_sample ? 1 : 0;
    device.device().move_to(now.position + 1e-4);
  });
  CHECK(refused == 1);
  CHECK(seen.ticks == 10);
  CHECK_THAT(device.position(), WithinRel(1e-3, 1e-12));
  CHECK(&device.meter() == &device.device().meter());
}

TEST_CASE("what a step throws comes out of the run", "[simulation][loop]") {
  sim::prescribed_motion<d1> device;
  auto model = strict_wall();
  CHECK_THROWS_AS(sim::run(device, model, 100, loud), std::runtime_error);
  CHECK_THAT(device.time(), WithinRel(4e-3, 1e-12));
}
