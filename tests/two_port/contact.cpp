// SPDX-License-Identifier: BSD-3-Clause
// A hand, a channel and a wall: what a two-port is for.
#include "support/catch.hpp"
#include "two_port/sides.hpp"
#include <passive_haptics/simulation/channel.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/loop.hpp>

using namespace two_ends;

namespace {

/// A hand that presses 2 cm into a remote spring for a second and lets go, over 25 ms each way.
struct contact {
  double farthest = 0.0;  ///< tool or hand from the surface [m]
  double swing = 0.0;     ///< peak to peak of the hand over the last half second of the press [m]
  double force = 0.0;     ///< mean of the force on the hand over the same time [N]
  double pressed = 0.0;   ///< mean force of the tool on the environment over the same time [N]
  double least = 0.0;     ///< of the sum of both ports [J]
  double drift = 0.0;     ///< hand less tool at the end, in free space [m]
};

template <class Master, class Remote>
contact press(Master master, Remote remote, double K, double damping, double delay = 0.025) {
  sim::device<d1, sim::impedance_hand<d1>> device({.damping = damping, .start = -0.01},
                                                  {.stiffness = 500.0, .damping = 5.0});
  sim::channel<packet_of<d1>> up({.delay = delay}, 1), down({.delay = delay}, 2);
  sim::random_source random(1);
  moving_wall<d1> wall{.stiffness = K, .restless = 0.0};
  wall.normal = -1.0;
  wall.tool = -0.01;
  contact result;
  double at_environment = 0.0, low = 1.0, high = -1.0, tool = -0.01;
  const auto world = [&](const auto& now) {
    const auto goal = now.time < 1.5 ? 0.02 * std::min(now.time / 0.3, 1.0) : -0.03;
    device.hand().aim(goal, 0.0, now.time);
    while (const auto* packet = up.take(now.time)) master.receive(*packet);
  };
  const auto environment = [&](const auto& now) {
    down.send(master.packet(), now.time);
    while (const auto* packet = down.take(now.time)) remote.receive(*packet);
    const auto step = remote.step(wall.force(), 1ms);
    const double work = wall.move(step.displacement, 1e-3, random);
    remote.settle(work);
    at_environment += work;
    tool += step.displacement;
    up.send(remote.packet(wall.force()), now.time);
  };
  const auto watch = [&](const auto& now) {
    const double x = device.position();
    result.farthest = std::max({result.farthest, std::abs(x), std::abs(tool)});
    result.least = std::min(result.least, device.meter().value() + at_environment);
    result.drift = x - tool;
    if (now.time >= 1.0 && now.time < 1.5) {
      low = std::min(low, x);
      high = std::max(high, x);
      result.force -= now.force / 500.0;
      result.pressed -= wall.force() / 500.0;
    }
  };
  sim::run(device, master, 3000, world, environment, watch);
  result.swing = high - low;
  return result;
}

/// Both sides as they are meant to be used: half of the energy kept, drift made up for.
auto press_controlled(double share, double drift_rate, double K, double loan) {
  const auto master = side_of({.damping = 1.0, .share = share});
  const ph::admittance_side<d1> remote(
      {.stiffness = loan > 0.0 ? K : 0.0, .drift_rate = drift_rate, .loan = loan}, -0.01);
  return press(master, remote, K, 1.0);
}

contact press_bare(double K) {
  return press(bare_master<d1>{.position = -0.01}, bare_remote<d1>{-0.01, -0.01}, K, 1.0);
}

}  // namespace

TEST_CASE("the two-port keeps a hand-held contact with a stiff spring 50 ms away bounded",
          "[two_port][passivity]") {
  for (const double K : {500.0, 2000.0, 10000.0}) {
    const contact held = press_controlled(0.5, 20.0, K, 1e-3);
    CHECK(held.farthest < 0.05);  // the hand pulls back to 0.03
    CHECK(held.swing < 1e-6);     // it settles,
    CHECK(held.force > 3.0);      // and the hand feels it
    CHECK(held.pressed > 3.0);
    CHECK(held.least >= -1e-3 - 1e-12);  // no more than the loan
    CHECK(std::abs(held.drift) < 1e-6);
    const contact bare = press_bare(K);
    CHECK(bare.swing > 0.02);
    CHECK(bare.least < -1.0);
    if (K > 1000.0) CHECK(bare.farthest > 0.2);
  }
}

TEST_CASE("what the admittance side cut is missing for good, or made up for with drift_rate",
          "[two_port]") {
  for (const double K : {500.0, 2000.0, 10000.0}) {
    CHECK(std::abs(press_controlled(0.5, 0.0, K, 1e-3).drift) > 0.02);
    CHECK(std::abs(press_controlled(0.5, 20.0, K, 1e-3).drift) < 1e-6);
    CHECK(std::abs(press_controlled(1.0, 0.0, K, 0.0).drift) > 0.01);
    CHECK(std::abs(press_controlled(1.0, 20.0, K, 0.0).drift) < 1e-6);
  }
}

TEST_CASE("an environment that moves by itself cannot set a resting device in motion",
          "[two_port][passivity]") {
  const auto energy_given = [](auto master, auto remote) {
    sim::device<d1> device;
    moving_wall<d1> wall{.stiffness = 5e3, .restless = 0.05};
    wall.normal = -1.0;
    sim::random_source random(3);
    sim::run(device, master, 2000, sim::idle, [&](const auto&) {
      remote.receive(master.packet());
      wall.move(remote.step(wall.force(), 1ms).displacement, 1e-3, random);
      master.receive(remote.packet(wall.force()));
    });
    return device.meter().total().actuator;
  };
  CHECK(energy_given(side_of({.damping = 0.03}), ph::admittance_side<d1>{}) <= 0.0);
  CHECK(energy_given(bare_master<d1>{}, bare_remote<d1>{}) > 1e-4);
}
