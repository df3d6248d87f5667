// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "two_port/sides.hpp"
#include <passive_haptics/simulation/loop.hpp>
#include <passive_haptics/simulation/prescribed_motion.hpp>

using namespace two_ends;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

TEST_CASE("impedance_side survives actuator latency with a bound that knows it (§ 3)",
          "[two_port][passivity]") {
  // 10 mJ have come over the channel; the hand gives way as it pays best, two ticks late.
  const auto least = [](auto limits) {
    const double b = 0.03, T = 1e-3;
    auto master = side_of({.damping = b}, ph::strict_bound{}, limits);
    sim::prescribed_motion<d1> device({.damping = b, .latency = 2});
    master.receive({0.01, 1, 10.0});
    const auto give_way = [&](const auto& now) {
      device.move_to(now.position + device.upcoming(now.force) * T / (2 * b));
    };
    return sim::run(device, master, 100, sim::idle, give_way).least_energy;
  };
  const ph::late_loop_limits<2> late{.longest_tick = 1e-3, .top_speed = 100.0, .watchdog = 1e-3};
  CHECK(least(late) >= -0.01 - 1e-12);
  CHECK(least(late) < -0.009);        // it was there to be spent
  CHECK(least(thesis_loop) < -0.02);  // the control
}

TEST_CASE("impedance_side displays the newest force, up to what the ledger covers", "[two_port]") {
  auto master = side_of({.damping = 0.03, .loan = 1.0});
  static_assert(decltype(master)::passivity == ph::guarantee::strict);
  static_assert(std::is_trivially_copyable_v<decltype(master)>);
  CHECK(master.packet().number == 0);  // no position to send yet
  CHECK(master.tick(0.0, 1ms).what == ph::event::no_target);
  master.receive({0.0, 7, 2.0});
  master.receive({0.0, 3, 5.0});           // late
  master.receive({0.0, 8, std::nan("")});  // broken
  const auto free = master.tick(0.0, 1ms);
  CHECK(free.force == 2.0);
  CHECK(!free.limited);
  CHECK(free.what == ph::event::rejected_target);
  CHECK(master.tick(0.0, 1ms).what == ph::event::nominal);
  master.receive({0.0, 9, 200.0});
  const auto limited = master.tick(0.0, 1ms);
  CHECK_THAT(limited.force, WithinRel(std::sqrt(4 * 30 * 1.0), 1e-12));
  CHECK(limited.limited);
  CHECK(master.packet().number == 1);
}

TEST_CASE("a tick that is late, lost or impossible promises nothing to the other side",
          "[two_port]") {
  auto master = side_of({.damping = 0.03, .loan = 1.0});
  master.receive({0.0, 1, 2.0});
  const double cost = 2.0 * 2.0 / (4 * 30);
  (void)master.tick(0.0, 1ms);
  (void)master.tick(-1e-3, 1ms);  // the control: a good one does
  CHECK_THAT(master.packet().energy, WithinAbs(2e-3, 1e-15));
  const double before = master.energy();

  CHECK(master.tick(-2e-3, 5ms).what == ph::event::late_tick);
  CHECK_THAT(master.energy(), WithinAbs(before - cost, 1e-15));
  CHECK(master.tick(std::nan(""), 1ms).what == ph::event::rejected_sample);
  CHECK_THAT(master.energy(), WithinAbs(before - 2 * cost, 1e-15));
  CHECK(master.tick(-4e-3, 1ms).what == ph::event::nominal);  // motion unknown, force was zero
  CHECK_THAT(master.energy(), WithinAbs(before - 2 * cost, 1e-15));
  CHECK(master.tick(1e3, 1ms).what == ph::event::rejected_sample);
  CHECK_THAT(master.packet().energy, WithinAbs(2e-3, 1e-15));

  // With latency a command outlives the tick that was refused.
  auto slow =
      side_of({.damping = 0.03, .loan = 1.0}, ph::strict_bound{},
              ph::late_loop_limits<1>{.longest_tick = 1e-3, .top_speed = 100.0, .watchdog = 1e-3});
  slow.receive({0.0, 1, 2.0});
  (void)slow.tick(0.0, 1ms);                                             // commands 2 N
  (void)slow.tick(std::nan(""), 1ms);                                    // while 0 N were held
  CHECK_THAT(slow.tick(0.0, 1ms).energy, WithinAbs(1.0 - cost, 1e-14));  // while the 2 N were
}
