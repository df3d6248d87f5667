// SPDX-License-Identifier: BSD-3-Clause
// New parameters while a port works: set().
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/compositions.hpp>

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

const d3::vector up(0, 0, 1);
const d3::vector here(0, 0, -0.002);

/// A touch that has pressed 2 mm deep into 1 kN/m, and banked what that brought.
auto pressed() {
  auto touch = ph::make_touch<d3>(
      {.mass = 0.1, .damping = 0.03, .force_limit = 9.0, .longest_tick = 1e-3}, {.force = 5.0});
  touch.update({d3::zero(), up, 1000});
  for (int n = 0; n <= 200; ++n) (void)touch.tick({0, 0, -1e-5 * n}, 1ms);
  (void)touch.tick(here, 1ms);
  return touch;
}

}  // namespace

TEST_CASE("a stiffness that the environment changes is felt without a step, and the ledger kept",
          "[port][set]") {
  auto touch = pressed();
  const double banked = touch.energy();
  CHECK_THAT(touch.tick(here, 1ms).force(2), WithinRel(2.0, 1e-12));
  touch.update({d3::zero(), up, 1500});
  auto out = touch.tick(here, 1ms);
  CHECK_THAT(out.force(2), WithinRel(2.0, 1e-12));
  for (int n = 0; n < 300; ++n) out = touch.tick(here, 1ms);
  CHECK_THAT(out.force(2), WithinRel(3.0, 1e-12));
  CHECK(out.energy == banked);
}

TEST_CASE("a force limit changes while it is pressed, and the ledger is kept", "[port][set]") {
  auto touch = pressed();
  const double banked = touch.energy();
  for (const double most : {1.5, 0.0, 0.25, 9.0}) {
    REQUIRE_FALSE(touch.set(ph::actuator_limit{.most = most}));
    CHECK(touch.energy() == banked);
    CHECK_THAT(touch.tick(here, 1ms).force(2), WithinRel(std::min(most, 2.0), 1e-12));
  }
}

TEST_CASE(
    "what was commanded before the motors were said to be weaker is believed where it is reported",
    "[port][set]") {
  auto touch = pressed();
  const d3::vector held = touch.tick(here, 1ms).force;
  REQUIRE(held(2) > 1.0);
  REQUIRE_FALSE(touch.set(ph::actuator_limit{.most = 0.25}));
  auto other = touch;  // the control: another force as large cannot have been held
  const auto out = touch.tick(ph::device_sample<d3>{here, held, 1e-3, true});
  CHECK(out.what == ph::event::nominal);
  CHECK_THAT(out.force(2), WithinRel(0.25, 1e-12));
  const auto refused = other.tick(ph::device_sample<d3>{here, held * 1.01, 1e-3, true});
  CHECK(refused.what == ph::event::rejected_sample);
}

TEST_CASE("a hand that is said to be stronger is given less, and the ledger is kept",
          "[port][set]") {
  auto touch = pressed();
  const double banked = touch.energy();
  touch.update({d3::zero(), up, 4000});
  const auto allowed = [&](double hand_force) {
    REQUIRE_FALSE(touch.set(ph::reachable_bound{.mass = 0.1, .hand_force = hand_force}));
    CHECK(touch.energy() == banked);
    auto twin = touch;
    return twin.tick(here, 1ms).force.norm();
  };
  const double weak = allowed(0.0), strong = allowed(1000.0);
  CHECK_THAT(weak, WithinRel(8.0, 1e-12));
  CHECK(strong < 0.9 * weak);
  CHECK(allowed(0.0) == weak);
}

TEST_CASE(
    "a normal turns at the new rate from the next tick on, and faster where little is pressed",
    "[port][set]") {
  auto touch = pressed();
  const d3::vector tilted(0.6, 0, 0.8);
  touch.update({d3::zero(), tilted, 1000});
  for (const double rate : {20.0, 50.0, 10.0}) {
    REQUIRE_FALSE(touch.set(ph::turn_limited{.rate = rate}));
    const d3::vector before = touch.local().normal;
    (void)touch.tick(here, 1ms);
    const d3::vector after = touch.local().normal;
    CHECK_THAT(std::acos(before.dot(after)), WithinAbs(rate * 1e-3, 2e-5));
  }
  REQUIRE_FALSE(touch.set(ph::turn_limited{.rate = 0.5}));
  const d3::vector before = touch.local().normal;
  const double pressed_with = touch.tick(here, 1ms).force.norm();
  const d3::vector after = touch.local().normal;
  const double angle = std::acos(before.dot(after));
  CHECK(angle > 2e-3);
  CHECK(angle * pressed_with < 0.011);  // half of usual_force_rate in a tick [N]
}

TEST_CASE("the stale-data rule changes while the environment is silent", "[port][set]") {
  auto touch = pressed();  // for ever, by default
  REQUIRE_FALSE(touch.set(ph::freshness{.stale_after = 0.05, .fade = 0.1}));
  CHECK(touch.tick(here, 1ms).what == ph::event::stale_target);  // it is 0.2 s old
  REQUIRE_FALSE(touch.set(ph::freshness{.stale_after = 0.5, .fade = 0.1}));
  CHECK(touch.tick(here, 1ms).what == ph::event::nominal);
  REQUIRE_FALSE(touch.set(ph::freshness{}));
  for (int n = 0; n < 1000; ++n) CHECK(touch.tick(here, 1ms).what == ph::event::nominal);
}

TEST_CASE("loop limits change with the ledger kept, and the law with them", "[port][set]") {
  auto touch = pressed();
  const double banked = touch.energy();
  touch.update({d3::zero(), up, 1e9});
  (void)touch.tick(here, 1ms);
  CHECK_THAT(touch.law().stiffness(), WithinRel(1e4, 1e-12));  // κ m/T²
  auto control = touch;
  CHECK(control.tick(here, 1500us).what == ph::event::late_tick);
  REQUIRE_FALSE(touch.set(ph::loop_limits{.longest_tick = 2e-3}));
  CHECK(touch.energy() == banked);
  CHECK_THAT(touch.law().stiffness(), WithinRel(2500.0, 1e-12));
  CHECK(touch.tick(here, 1500us).what == ph::event::nominal);

  REQUIRE_FALSE(touch.set(ph::loop_limits{.longest_tick = 2e-3}));  // no motion is known now
  control = touch;
  const d3::vector farther(0.006, 0, -0.002);
  CHECK(control.tick(farther, 1500us).what == ph::event::nominal);
  REQUIRE_FALSE(touch.set(ph::loop_limits{.longest_tick = 2e-3, .top_speed = 3.0}));
  CHECK(touch.tick(farther, 1500us).what == ph::event::rejected_sample);  // 4 m/s
}

TEST_CASE("law, shaper, observer and given force take new parameters, too", "[port][set]") {
  ph::local_model model{d1{},
                        ph::followed{wall<d1>(1e6)},
                        ph::turn_at_once{},
                        ph::shaped{ph::damped_spring{.mass = 0.1}, ph::force_rate_limit{.rate = 1}},
                        ph::reduced_energy{.damping = 0.03, .loan = 1.0},
                        ph::strict_bound{},
                        thesis_loop};
  const auto step = [&model] {
    const double before = model.tick(1e-3, 1ms).force;
    return before - model.tick(1e-3, 1ms).force;
  };
  CHECK_THAT(step(), WithinRel(1e-3, 1e-6));  // 1 N/s
  REQUIRE_FALSE(model.set(ph::force_rate_limit{.rate = 1000}));
  CHECK_THAT(step(), WithinRel(1.0, 1e-6));
  REQUIRE_FALSE(model.set(ph::damped_spring{.mass = 0.2}));
  CHECK_THAT(model.law().stiffness(), WithinRel(2e4, 1e-12));
  REQUIRE_FALSE(model.set(ph::reduced_energy{.damping = 0.06, .loan = 5.0}));
  CHECK(model.energy() == 1.0);  // a loan is made at the start
  CHECK_THAT(model.observer().damping().along_axis(0), WithinRel(0.06, 1e-15));

  ph::passive_port guard{d1{}, ph::given_force{}, thesis_ledger(), ph::no_bound{}, thesis_loop};
  (void)guard.tick(0.0, 1ms, 1.0);
  REQUIRE_FALSE(guard.set(ph::given_force{.stale_after = 0.0, .fade = 0.01}));
  CHECK_THAT(guard.tick(0.0, 1ms).force, WithinRel(0.9, 1e-12));
}

TEST_CASE("a motion estimator takes new parameters, too", "[port][set]") {
  const auto with = [](const ph::mass_observer& estimator) {
    return ph::local_model{d1{},
                           ph::fixed{wall<d1>(1000)},
                           ph::turn_at_once{},
                           ph::spring{},
                           ph::quantised_energy{.damping = 0.03, .quantum = 6e-5, .loan = 1.0},
                           ph::strict_bound{},
                           thesis_loop,
                           estimator};
  };
  const auto pressed = [](auto model) {
    double sum = 0.0;
    for (int n = 0; n < 200; ++n) sum += model.tick(6e-5 * std::floor(n / 7.0), 1ms).force;
    return sum;
  };
  const ph::mass_observer one{.mass = 0.1, .quantum = 6e-5}, other{.mass = 0.4, .quantum = 6e-5};
  auto model = with(one);
  CHECK(pressed(model) != pressed(with(other)));
  REQUIRE_FALSE(model.set(other));
  CHECK(pressed(model) == pressed(with(other)));
}

TEST_CASE("a fault in new parameters is returned, and changes nothing", "[port][set]") {
  auto touch = pressed();
  touch.update({d3::zero(), d3::vector(0.6, 0, 0.8), 1000});
  auto untouched = touch;
  const double nan = std::nan("");
  const auto refused = [&touch](const auto& parameters) {
    const auto fault = touch.set(parameters);
    REQUIRE(fault);
    CHECK_FALSE(std::string(fault.remedy).empty());
    return std::string(fault.parameter);
  };
  CHECK(refused(ph::actuator_limit{.most = -1}) == "most");
  CHECK(refused(ph::reachable_bound{.mass = 0.0, .hand_force = 5.0}) == "mass");
  CHECK(refused(ph::reachable_bound{.mass = 0.1, .hand_force = nan}) == "hand_force");
  CHECK(refused(ph::turn_limited{.rate = nan}) == "rate");
  CHECK(refused(ph::freshness{.stale_after = 0.1, .fade = 0.0}) == "fade");
  CHECK(refused(ph::loop_limits{}) == "longest_tick");
  CHECK(refused(ph::loop_limits{.longest_tick = 1e-3, .top_speed = -1}) == "top_speed");
  CHECK(refused(ph::damped_spring{}) == "mass");
  CHECK(refused(ph::reduced_energy{}) == "damping");
  CHECK_FALSE(touch.check());
  for (int n = 0; n < 50; ++n) {
    const d3::vector x(1e-5 * n, 0, -0.002 - 1e-5 * n);
    const auto out = touch.tick(x, 1ms), same = untouched.tick(x, 1ms);
    REQUIRE(out.force == same.force);
    REQUIRE(out.energy == same.energy);
    REQUIRE(out.what == same.what);
  }
}

TEST_CASE("a port of bad parameters works as soon as they are good", "[port][set]") {
  ph::strict_guard<d1, ph::actuator_limit> guard;  // no damping, no longest tick
  CHECK(guard.tick(0.0, 1ms, 1.0).what == ph::event::rejected_parameters);
  REQUIRE_FALSE(guard.set(ph::reduced_energy{.damping = 0.03, .loan = 1.0}));
  CHECK(guard.tick(0.0, 1ms, 1.0).what == ph::event::rejected_parameters);
  REQUIRE_FALSE(guard.set(thesis_loop));
  REQUIRE_FALSE(guard.set(ph::actuator_limit{.most = 9.0}));
  CHECK_FALSE(guard.check());
  CHECK(guard.tick(0.0, 1ms, 1.0).what == ph::event::nominal);
  guard.reset();  // which makes the loan
  CHECK(guard.tick(0.0, 1ms, 1.0).force == 1.0);
}
