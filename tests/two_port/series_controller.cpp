// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "two_port/sides.hpp"
#include <passive_haptics/simulation/prescribed_motion.hpp>

using namespace two_ends;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// The published series controller, same-sample pairing.
template <class Space>
struct published_master : bare_master<Space> {
  ph::two_port_series_controller<Space> controller{};
  bool seen = false;

  void receive(const packet_of<Space>& p) {
    controller.receive(p.energy);
    bare_master<Space>::receive(p);
  }
  ph::port_result<Space> tick(const ph::device_sample<Space>& sample) {
    const vector_of<Space> last = this->position, now = sample.position;
    this->position = sample.position;
    const vector_of<Space> moved = seen ? vector_of<Space>(now - last) : Space::zero();
    seen = true;
    return {controller.force({.desired = this->desired, .displacement = moved, .dt = sample.dt}), 0,
            ph::event::nominal, false};
  }
  packet_of<Space> packet() { return {controller.in(), ++this->number, this->position}; }
};

}  // namespace

TEST_CASE("two_port_series_controller repays the excess of the sample in the sample (§ 2(d))",
          "[two_port]") {
  ph::two_port_series_controller<d1> controller;
  controller.receive(1e-3);
  // 2 N along 1 mm: 2 mJ out, 1 mJ received. α = 1e-3/(1e-3 · 1²) = 1 N·s/m.
  CHECK_THAT(controller.force({.desired = 2.0, .displacement = 1e-3, .dt = 1e-3}),
             WithinAbs(1.0, 1e-12));
  CHECK_THAT(controller.out(), WithinAbs(1e-3, 1e-15));
  CHECK(controller.force({.desired = 2.0, .displacement = -1e-3, .dt = 1e-3}) == 2.0);
  CHECK_THAT(controller.in(), WithinAbs(2e-3, 1e-15));
  CHECK(controller.force({.desired = 2.0, .displacement = 5e-7, .dt = 1e-3}) ==
        2.0);  // too slow: carried on
  CHECK_FALSE(controller.set({.max_gain = 0.25}));
  CHECK_THAT(controller.force({.desired = 2.0, .displacement = 1e-3, .dt = 1e-3}),
             WithinAbs(1.75, 1e-12));
  CHECK(controller.set({.max_gain = -1.0}));  // and stays as it was
  CHECK_THAT(controller.force({.desired = 2.0, .displacement = 1e-3, .dt = 1e-3}),
             WithinAbs(1.75, 1e-12));
}

TEST_CASE("the published same-sample series form loses on a stiff wall, impedance_side does not",
          "[two_port][passivity]") {
  // No delay at all: the wall answers x(n) with f(n) before the tick is over.
  const double K = 1e4, loan = 0.01;
  const auto least_of = [&](auto master) {
    ph::admittance_side<d1> remote({.stiffness = K, .loan = loan});
    moving_wall<d1> world{.stiffness = K, .restless = 0.0};
    world.normal = -1.0;
    sim::random_source random(1);
    sim::prescribed_motion<d1> device({.damping = 0.03});
    double at_environment = 0.0, least = 0.0, force = 0.0;
    for (std::uint64_t n = 1; n <= 2000; ++n) {
      device.move_to(n % 2 == 0 ? 0.0 : 1e-3);  // in and out
      const auto sample = device.exchange(force);
      remote.receive({master.packet().energy, n, sample.position});
      const double work = world.move(remote.step(world.force(), 1ms).displacement, 1e-3, random);
      remote.settle(work);
      at_environment += work;
      master.receive(remote.packet(world.force()));
      force = master.tick(sample).force;
      least = std::min(least, device.meter().value() + at_environment);
    }
    return least;
  };
  // (K − 2B) δ² in each of 1000 cycles, what no controller at all would lose (A5): it never acts.
  CHECK_THAT(least_of(published_master<d1>{}), WithinRel(-1000 * (K - 2 * 30) * 1e-6, 1e-3));
  CHECK(least_of(side_of({.damping = 0.03})) >= -loan - 1e-12);
}
