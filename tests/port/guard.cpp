// SPDX-License-Identifier: BSD-3-Clause
// What a port believes, and what bad input does to it. For every bound and constraint: full/faults.cpp.
#include "support/bad_input.hpp"
#include <passive_haptics/two_port/energy.hpp>

namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using late = ph::guard<d1, 2>;

/// Nothing is too far away, and nothing goes faster than 5 m/s.
template <class Space>
constexpr ph::loop_limits::on<Space> slow({.longest_tick = 1e-3,
                                           .top_speed = 5.0,
                                           .workspace = ph::loop_limits::never});

}  // namespace

TEST_CASE("the guard believes a first sample wherever it is, if it is finite", "[guard]") {
  const ph::guard<d1, 0> guard;
  const double nan = std::nan("");
  CHECK_FALSE(guard.has_seen());
  CHECK_FALSE(guard.knows_motion());
  CHECK(guard.believes(1e300, 1e300, 1e-3, slow<d1>));
  for (const double bad : {nan, HUGE_VAL, -HUGE_VAL}) {
    CHECK_FALSE(guard.believes(bad, bad, 1e-3, slow<d1>));
  }
  for (const double dt : {0.0, -1e-3, nan, HUGE_VAL}) {
    CHECK_FALSE(guard.believes(0.0, 0.0, dt, slow<d1>));
  }
}

TEST_CASE("the guard believes nothing outside the workspace, and joints wherever they are",
          "[guard]") {
  constexpr ph::loop_limits::on<d3> desk({.longest_tick = 1e-3, .workspace = 0.5});
  ph::guard<d3, 0> guard;
  const auto believes = [&](const d3::vector& x) { return guard.believes(x, x, 1.0, desk); };
  for (const bool seen : {false, true}) {
    if (seen) guard.see_again();
    CHECK(believes({0.0, 0.3, 0.4}));
    CHECK_FALSE(believes({0.0, 0.3, 0.41}));
    CHECK_FALSE(believes({0.0, 0.0, std::nan("")}));
  }
  using arm = ph::joint_space<double, 3>;
  constexpr ph::loop_limits::on<arm> turning({.longest_tick = 1e-3, .workspace = 0.5});
  const arm::pose far(60.0, 0.0, 0.0);
  CHECK(ph::guard<arm, 0>().believes(far, far, 1.0, turning));
}

TEST_CASE("the guard believes no motion that is faster than the device", "[guard]") {
  ph::guard<d2, 0> guard;
  guard.move_to({1, 2});
  guard.see_again();
  CHECK(guard.has_seen());
  CHECK(guard.knows_motion());
  CHECK(guard.last() == d2::vector(1, 2));
  const auto believes = [&guard](const d2::vector& travel, double dt) {
    return guard.believes(guard.last() + travel, travel, dt, slow<d2>);
  };
  CHECK(believes({0.003, 0.0039}, 1e-3));  // 4.9 m/s
  CHECK_FALSE(believes({0.003, 0.0041}, 1e-3));
  CHECK(believes({0.003, 0.0041}, 1.1e-3));
  CHECK_FALSE(believes({std::nan(""), 0}, 1e-3));
  CHECK_FALSE(believes({0, HUGE_VAL}, 1e-3));
  CHECK_FALSE(believes({0, 0}, std::nan("")));

  guard.lose_sight(0.01);  // it may have gone on meanwhile
  CHECK_FALSE(guard.knows_motion());
  CHECK(believes({0.003, 0.0041}, 1e-3));
  CHECK(believes({0.054, 0}, 1e-3));
  CHECK_FALSE(believes({0.056, 0}, 1e-3));
  guard.see_again();  // which is over with the next good sample
  CHECK(guard.knows_motion());
  CHECK_FALSE(believes({0.003, 0.0041}, 1e-3));
  guard.lose_sight(0.01);
  guard.reset();
  CHECK_FALSE(guard.has_seen());
  CHECK(guard.last() == d2::zero());
  guard.see_again();
  CHECK(guard.knows_motion());
}

TEST_CASE("the guard hands a command over to the tick that holds it", "[guard]") {
  late guard;
  for (int n = 1; n <= 10; ++n) {
    const auto& held = guard.commanded();
    CHECK(held[2] == std::max(0.0, n - 3.0));  // commanded three ticks ago
    CHECK(held[0] == n - 1.0);
    guard.command(n);
  }
  guard.reset();
  CHECK(guard.commanded() == late::commands{});
}

TEST_CASE("the watch counts four jumps from a standstill, each faster than a mass starts",
          "[guard][watch]") {
  ph::sensor_watch<d1, true> watch;
  const double fast = 5.0 * 1e-3 / 25;  // [m]
  const auto repeats = [&watch](double travel) { return watch.repeats(travel, 1e-3, 5.0); };
  CHECK_FALSE(repeats(1.1 * fast));  // the first motion of all is no jump
  for (int jumps = 1; jumps <= 6; ++jumps) {
    CHECK_FALSE(repeats(0.0));
    CHECK(repeats(jumps % 2 == 0 ? 1.1 * fast : -1.1 * fast) == (jumps >= 4));
    CHECK_FALSE(repeats(1.1 * fast));  // it goes on
  }
  CHECK_FALSE(repeats(0.0));
  CHECK_FALSE(repeats(0.9 * fast));  // a mass may start like that
  watch.reset();
  CHECK_FALSE(repeats(1.1 * fast));
  for (int jumps = 1; jumps <= 3; ++jumps) {
    CHECK_FALSE(repeats(0.0));
    CHECK_FALSE(repeats(1.1 * fast));
  }
}

TEST_CASE("bad input is survived by a model of each kind", "[guard][fault]") {
  const ph::spring spring;
  const ph::damped_spring damped{.mass = 0.1};
  const ph::bound_chain chain{ph::reachable_bound{.mass = 0.1, .hand_force = 5.0},
                              ph::actuator_limit{.most = 9.0}};
  using bad_input::over;
  const std::vector<any_model> models{
      over<ph::half_space<d1>>(
          spring, ph::strict_bound{},
          ph::late_loop_limits<2>{.longest_tick = 1e-3, .top_speed = 100.0, .watchdog = 1e-3}),
      over<ph::segment<f2>>(ph::shaped{damped, ph::force_rate_limit{.rate = 100.0}}, chain),
      over<ph::triangle<d3>>(ph::shaped{spring, ph::thesis_rule{}}, ph::no_bound{})};
  for (const any_model& model : models) {
    bad_input::samples(model);
    bad_input::targets(model);
    bad_input::stiffness(model);
  }
  bad_input::all_parameters<f1>();
  bad_input::first_samples<f1>();
}

TEST_CASE("a tick whose energy is no number is refused, and the ledger stays one", "[fault]") {
  const auto check = [](const auto& ledger) {
    for (const double dt : {1e-3, 3e-3}) {  // in time, and late
      auto model = following_half_space<d1>(ph::spring{}, ledger, ph::strict_bound{});
      model.update(wall<d1>(500));
      CHECK(model.tick(0.0, 1ms).what == ph::event::nominal);
      CHECK(model.tick(1e-4, 1ms).what == ph::event::nominal);  // the control: 1e303 J
      const auto beyond = model.tick(0.09, ph::seconds{dt});
      CHECK(beyond.what == ph::event::rejected_sample);
      CHECK(beyond.force == 0.0);
      CHECK(ph::kernels::is_finite(model.energy()));
    }
  };
  check(ph::reduced_energy{.damping = 1e308});
  check(ph::capped_energy{.damping = 1e308});
  check(ph::quantised_energy{.damping = 1e308, .quantum = 1e-7});
  check(ph::two_port_energy{.damping = 1e308});
}

TEST_CASE("a late tick is reported, and costs what it cost, since its force was held to the end",
          "[fault]") {
  const ph::loop_limits limits{.longest_tick = 1.2e-3, .top_speed = 100.0};
  auto bare = following_half_space<d1>(ph::spring{}, thesis_ledger(), ph::no_bound{}, limits);
  bare.update(wall<d1>(500));
  (void)bare.tick(0.0, 1ms);
  const double before = bare.tick(1e-3, 1200us).energy;
  const auto late = bare.tick(1.5e-3, 3ms);  // 0.5 N inwards, 0.5 mm, 3 ms
  CHECK(late.what == ph::event::late_tick);
  CHECK_THAT(late.energy - before, WithinAbs(0.03 * 0.25e-6 / 3e-3 + 0.5 * 0.5e-3, 1e-15));
  CHECK(late.energy > before);
  CHECK(late.force < 0.0);
  CHECK(bare.tick(-0.019, 3ms).energy < -5e-3);  // 0.75 N have worked for 20 mm: a debt
}

TEST_CASE("a late tick costs what it may have cost, if a watchdog may have dropped the force",
          "[fault]") {
  const ph::loop_limits limits{.longest_tick = 1.2e-3, .top_speed = 100.0, .watchdog = 1.2e-3};
  auto model = following_half_space<d1>(ph::spring{}, thesis_ledger(), ph::strict_bound{}, limits);
  model.update(wall<d1>(500));
  (void)model.tick(0.0, 1ms);
  CHECK(model.tick(1e-3, 1200us).what == ph::event::nominal);
  const double before = model.energy();
  const auto late = model.tick(1.5e-3, 3ms);
  CHECK(late.what == ph::event::late_tick);
  CHECK(before > 0.0);
  CHECK_THAT(late.energy, WithinAbs(0.0, 1e-15));  // the bound had spent it all

  auto bare = following_half_space<d1>(ph::spring{}, thesis_ledger(), ph::no_bound{}, limits);
  bare.update(wall<d1>(500));
  (void)bare.tick(0.0, 1ms);
  CHECK(bare.tick(1e-3, 1ms).energy > 0.0);
  CHECK(bare.tick(-0.019, 3ms).energy < -5e-3);  // it did not bark: 0.5 N have worked for 20 mm
}

TEST_CASE("a tick shorter than the watchdog waits is booked as it was, however late", "[fault]") {
  const auto after = [](double watchdog) {
    auto model = following_half_space<d1>(
        ph::spring{}, thesis_ledger(), ph::strict_bound{},
        ph::loop_limits{.longest_tick = 1.2e-3, .top_speed = 100.0, .watchdog = watchdog});
    model.update(wall<d1>(500));
    (void)model.tick(0.0, 1ms);
    (void)model.tick(1e-3, 1ms);
    return model.tick(1.5e-3, 3ms).energy;
  };
  CHECK(after(4e-3) == after(ph::loop_limits::never));
  CHECK(after(2e-3) < after(4e-3));
}

TEST_CASE("a watchdog makes an encoder's ledger forget what only one of two stories covers",
          "[fault]") {
  // F pushes all the time. In a late tick it does its worst, is dropped, and the device comes back to
  // where the step shown is 25 µm farther but the device is behind it; in the next tick the device
  // crosses that step unseen.
  constexpr double T = 1e-3, b = 5.0, F = 0.5, q = 10e-6, loan = 1.0;
  constexpr double shown = 26.5e-6;  // a little more costly than the worst: the ledger's story
  constexpr double out = F * T / (2 * b);   // 50 µm, the worst while the force lasts
  constexpr double back = shown - q - out;  // then free, in four ticks
  ph::passive_port port{d1{}, ph::given_force{},
                        ph::quantised_energy{.damping = b, .quantum = q, .loan = loan},
                        ph::no_bound{}, ph::loop_limits{.longest_tick = T, .watchdog = T}};
  double position = 0.0, truth = loan;
  (void)port.tick(position, ph::seconds{T}, F);
  for (int n = 0; n < 200; ++n) {
    position += shown;
    const auto late = port.tick(position, ph::seconds{5 * T}, F);
    REQUIRE(late.what == ph::event::late_tick);
    truth += b * out * out / T - F * out + b * back * back / (4 * T);
    const auto even = port.tick(position, ph::seconds{T}, F);
    truth += b * q * q / T - F * q;
    if (even.energy > truth) FAIL("tick " << n << ": overstated by " << even.energy - truth);
  }
  CHECK(truth < loan - 2e-3);
}

TEST_CASE("a sample that is lost in a late tick costs all the time that its force was held",
          "[fault]") {
  const auto left = [](double dt, double watchdog) {
    ph::passive_port port{d1{}, ph::given_force{}, ph::reduced_energy{.damping = 0.03, .loan = 1.0},
                          ph::no_bound{},
                          ph::loop_limits{.longest_tick = 1e-3, .watchdog = watchdog}};
    (void)port.tick(0.0, 1ms, 0.5);
    const double before = port.energy();
    (void)port.tick(std::nan(""), ph::seconds{dt}, 0.0);
    return before - port.energy();
  };
  const double worst = 1e-3 * 0.25 / (4 * 0.03);  // T f²/(4b)
  const double never = ph::loop_limits::never;
  CHECK_THAT(left(1e-3, never), WithinRel(worst, 1e-9));
  CHECK_THAT(left(1e-4, never), WithinRel(worst, 1e-9));  // who says that its dt is true?
  CHECK_THAT(left(std::nan(""), never), WithinRel(worst, 1e-9));
  CHECK_THAT(left(7e-3, never), WithinRel(7 * worst, 1e-9));
  CHECK_THAT(left(7e-3, 3e-3), WithinRel(3 * worst, 1e-9));
}

TEST_CASE("a position outside the workspace is an event, as millimetres for metres are",
          "[fault]") {
  auto model = following_half_space<d3>(ph::spring{}, thesis_ledger(), ph::strict_bound{},
                                        ph::loop_limits{.longest_tick = 1e-3});
  model.update({{0, 0, 0}, {0, 0, 1}, 1000});
  const auto inside = model.tick({0, 0, -1.9}, 1ms);
  CHECK(inside.what == ph::event::started_inside);  // and believed
  for (int n = 0; n < 1000; ++n) {                  // 40 mm deep, and says 40 m
    const auto out = model.tick({0, 0, -40.0}, 1ms);
    if (out.what < ph::event::outside_workspace || out.force.norm() != 0.0) FAIL("tick " << n);
  }
  model.reset();
  CHECK(model.tick({0, 0, -40.0}, 1ms).what == ph::event::outside_workspace);
  model.reset();
  REQUIRE_FALSE(model.set(ph::loop_limits{.longest_tick = 1e-3, .workspace = 50.0}));
  model.update({{0, 0, 0}, {0, 0, 1}, 1000});
  CHECK(model.tick({0, 0, -40.0}, 1ms).what == ph::event::started_inside);

  using arm = ph::joint_space<double, 3>;  // joints may turn as often as they like
  ph::passive_port turning{
      arm{}, ph::given_force{},
      ph::basic_reduced_energy<ph::diagonal_damping<3>>{.damping = {{0.03, 0.03, 0.03}}},
      ph::strict_bound{}, ph::loop_limits{.longest_tick = 1e-3}};
  const arm::effort none = arm::zero();
  CHECK(turning.tick(arm::pose(60.0, 0.0, 0.0), 1ms, none).what == ph::event::nominal);
}

TEST_CASE("a debt is an event, and events say what they are", "[fault]") {
  auto model = following_half_space<d1>(ph::spring{}, thesis_ledger(), ph::no_bound{});
  model.update(wall<d1>(1e4));
  (void)model.tick(0.0, 1ms);
  CHECK(model.tick(1e-3, 1ms).what == ph::event::nominal);
  CHECK(model.tick(0.0, 1ms).what == ph::event::debt);
  for (int e = 0; e <= static_cast<int>(ph::event::rejected_parameters); ++e) {
    CHECK(std::string(ph::to_string(static_cast<ph::event>(e))) != "unknown event");
  }
  CHECK(std::string(ph::to_string(static_cast<ph::event>(200))) == "unknown event");
}

TEST_CASE("the guard believes up to the largest number and the top speed themselves", "[guard]") {
  const double most = ph::kernels::largest<double>();
  ph::guard<d1, 0> guard;
  CHECK(guard.believes(0.0, 0.0, most, slow<d1>));
  guard.see_again();
  constexpr ph::loop_limits::on<d1> loose({.longest_tick = 1.0, .top_speed = 1e-200});
  CHECK(guard.believes(0.0, 0.0, most, loose));
  constexpr ph::loop_limits::on<d1> exact({.longest_tick = 1.0, .top_speed = 4.0});
  CHECK(guard.believes(1.0, 1.0, 0.25, exact));
  CHECK_FALSE(guard.believes(1.0, 1.0001, 0.25, exact));
  guard.lose_sight(0.25);
  CHECK(guard.blind() == 0.25);
  CHECK_FALSE(guard.knows_motion());
  CHECK(guard.believes(1.0, -2.0, 0.25, exact));
  CHECK_FALSE(guard.believes(1.0, -2.0001, 0.25, exact));
  CHECK(guard.believes(2.0, 0.0, 0.25, exact));  // the default workspace ends at 2 m
  CHECK_FALSE(guard.believes(2.0001, 0.0, 0.25, exact));
  guard.see_again();
  CHECK(guard.blind() == 0.0);
  guard.move_to(1.0);
  guard.command(3.0);
  guard.reset();
  CHECK(guard.last() == 0.0);
  CHECK(guard.commanded()[0] == 0.0);
  CHECK_FALSE(guard.has_seen());
}
