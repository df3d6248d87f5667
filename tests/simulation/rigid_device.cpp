// SPDX-License-Identifier: BSD-3-Clause
// The simulated handle: what its integration is worth, before anything is judged by it.
#include "../bench/contacts/rigid_ports.hpp"
#include "support/catch.hpp"

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using namespace rigid;

namespace {

/// A second of a random hand's and motors' wrenches on a body whose centre is 30 mm off, spinning at first.
[[nodiscard]] sim::rigid_device shaken(int substeps) {
  sim::rigid_device device({.centre = {0.03, 0, 0}, .substeps = substeps}, {}, vec3(20, 30, -15));
  rigid_hand hand({}, 7);
  ph::laws::samples random(8);
  body::effort motors = body::zero();
  for (int n = 0; n < 1000; ++n) {
    if (n % 10 == 0) {
      const vec3 force = random.vector<d3>() * 5.0, torque = random.vector<d3>() * 0.1;
      motors = body::join(force, torque);
    }
    device.push(hand.push(device, motors, vec3(0, 0, 1)));
    static_cast<void>(device.exchange(motors));
  }
  return device;
}

}  // namespace

TEST_CASE("a simulated handle's energies close, 16 times better with half the step",
          "[rigid_device]") {
  const auto coarse = shaken(4), fine = shaken(8), finest = shaken(16);
  CHECK(std::fabs(fine.residual()) < 1e-9);
  CHECK(std::fabs(finest.residual()) < 1e-10);
  CHECK(std::fabs(fine.residual()) < std::fabs(coarse.residual()) / 8);
  CHECK_THAT(fine.energy(), WithinAbs(finest.energy(), 1e-8));
  CHECK_THAT(fine.energy(), !WithinAbs(0.0, 0.01));  // something happened
}

TEST_CASE("a simulated handle slows down, spins and swings as the formulas say", "[rigid_device]") {
  // Pushed in the middle, it is the linear device: v = f/b (1 − e^(−bt/m)).
  sim::rigid_device straight({.mass = 0.1, .linear_damping = {0.5, 0.5, 0.5}});
  const body::effort push = body::join({2, 0, 0}, {0, 0, 0});
  for (int n = 0; n < 100; ++n) static_cast<void>(straight.exchange(push));
  CHECK_THAT(straight.velocity()(0), WithinRel(4 * (1 - std::exp(-0.5)), 1e-10));
  CHECK(straight.rate().norm() == 0.0);

  // About a principal axis it stays, and loses ω by e^(−b_ω t/I); E is what it lost in kinetic energy.
  sim::rigid_device top({.moments = {1e-4, 3e-4, 1.5e-4}}, {}, vec3(0, 0, 30));
  for (int n = 0; n < 1000; ++n) static_cast<void>(top.exchange(body::zero()));
  const double left = 30 * std::exp(-1e-4 / 1.5e-4);
  CHECK_THAT(top.rate()(2), WithinRel(left, 1e-10));
  CHECK_THAT(top.energy(), WithinRel(1.5e-4 * (900 - left * left) / 2, 1e-9));

  // With its centre off, a torque about the handle point turns m c² too, and a push turns it at all.
  sim::rigid_device club({.mass = 0.2, .moments = {1e-4, 1e-4, 1e-4}, .centre = {0, 0.05, 0}});
  static_cast<void>(club.exchange(body::join({1, 0, 0}, {0, 0, 0})));
  CHECK_THAT(club.rate()(2), WithinRel(0.05 / 1e-4 * 1e-3, 0.05));
}

TEST_CASE("a simulated handle holds a wrench a tick later if told so, and says what it held",
          "[rigid_device]") {
  sim::rigid_device late({.latency = 1});
  const body::effort push = body::join({1, 0, 0}, {0, 0, 0});
  CHECK(body::effort(late.exchange(push).held) == body::zero());
  CHECK(late.at().position.values[0] == 0.0);
  CHECK(body::effort(late.exchange(body::zero()).held) == push);
  CHECK(late.at().position.values[0] > 0.0);
}
