// SPDX-License-Identifier: BSD-3-Clause
// What a port believes, and what bad input does to it. For every bound and constraint: full/faults.cpp.
#include "support/bad_input.hpp"

namespace {

using late = ph::guard<d1, 2>;

}  // namespace

TEST_CASE("the guard believes a first sample wherever it is, if it is finite", "[guard]") {
  const ph::guard<d1, 0> guard;
  const double nan = std::nan("");
  CHECK_FALSE(guard.has_seen());
  CHECK_FALSE(guard.knows_motion());
  CHECK(guard.believes(1e300, 1e300, 1e-3, 5.0));
  for (const double bad : {nan, HUGE_VAL, -HUGE_VAL}) {
    CHECK_FALSE(guard.believes(bad, bad, 1e-3, 5.0));
  }
  for (const double dt : {0.0, -1e-3, nan, HUGE_VAL}) {
    CHECK_FALSE(guard.believes(0.0, 0.0, dt, 5.0));
  }
}

TEST_CASE("the guard believes no motion that is faster than the device", "[guard]") {
  ph::guard<d2, 0> guard;
  guard.move_to({1, 2});
  guard.see_again();
  CHECK(guard.has_seen());
  CHECK(guard.knows_motion());
  CHECK(guard.last() == d2::vector(1, 2));
  const auto believes = [&guard](const d2::vector& travel, double dt) {
    return guard.believes(guard.last() + travel, travel, dt, 5.0);
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
  guard.reset();
  CHECK_FALSE(guard.has_seen());
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

TEST_CASE("bad input is survived by a model of each kind", "[guard][fault]") {
  const ph::spring spring;
  const ph::damped_spring damped{.mass = 0.1};
  const ph::bound_chain chain{ph::reachable_bound{.mass = 0.1, .hand_force = 5.0},
                              ph::actuator_limit{.most = 9.0}};
  using bad_input::over;
  const std::vector<any_model> models{
      over<ph::half_space<d1>>(spring, ph::strict_bound{},
                               ph::late_loop_limits<2>{.longest_tick = 1e-3, .top_speed = 100.0}),
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
  const ph::reduced_energy ledger{.damping = 1e308};
  auto model = following_half_space<d1>(ph::spring{}, ledger, ph::strict_bound{});
  model.update(wall<d1>(500));
  CHECK(model.tick(0.0, 1e-3).what == ph::event::nominal);
  CHECK(model.tick(1e-4, 1e-3).what == ph::event::nominal);  // the control: 1e303 J
  const auto beyond = model.tick(0.09, 1e-3);
  CHECK(beyond.what == ph::event::rejected_sample);
  CHECK(beyond.force == 0.0);
  CHECK(ph::kernels::is_finite(model.energy()));
}

TEST_CASE("a late tick is reported, and costs what it may have cost with or without a watchdog",
          "[fault]") {
  auto model =
      following_half_space<d1>(ph::spring{}, thesis_ledger(), ph::strict_bound{},
                               ph::loop_limits{.longest_tick = 1.2e-3, .top_speed = 100.0});
  model.update(wall<d1>(500));
  (void)model.tick(0.0, 1e-3);
  CHECK(model.tick(1e-3, 1.2e-3).what == ph::event::nominal);
  const double before = model.energy();
  const auto late = model.tick(1.5e-3, 3e-3);
  CHECK(late.what == ph::event::late_tick);
  CHECK(before > 0.0);
  CHECK_THAT(late.energy, Catch::Matchers::WithinAbs(0.0, 1e-15));  // the bound had spent it all

  auto bare = following_half_space<d1>(ph::spring{}, thesis_ledger(), ph::no_bound{},
                                       ph::loop_limits{.longest_tick = 1.2e-3, .top_speed = 100.0});
  bare.update(wall<d1>(500));
  (void)bare.tick(0.0, 1e-3);
  CHECK(bare.tick(1e-3, 1e-3).energy > 0.0);
  CHECK(bare.tick(-0.019, 3e-3).energy < -5e-3);  // no watchdog: 0.5 N have worked for 20 mm
}

TEST_CASE("a debt is an event, and events say what they are", "[fault]") {
  auto model = following_half_space<d1>(ph::spring{}, thesis_ledger(), ph::no_bound{});
  model.update(wall<d1>(1e4));
  (void)model.tick(0.0, 1e-3);
  CHECK(model.tick(1e-3, 1e-3).what == ph::event::nominal);
  CHECK(model.tick(0.0, 1e-3).what == ph::event::debt);
  for (int e = 0; e <= static_cast<int>(ph::event::rejected_parameters); ++e) {
    CHECK(std::string(ph::to_string(static_cast<ph::event>(e))) != "unknown event");
  }
  CHECK(std::string(ph::to_string(static_cast<ph::event>(200))) == "unknown event");
}
