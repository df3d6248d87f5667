// SPDX-License-Identifier: BSD-3-Clause
// The compositions with a name, and models that are members of a class.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/compositions.hpp>
#include <passive_haptics/simulation/device.hpp>

using Catch::Matchers::WithinRel;
namespace sim = ph::simulation;

namespace {

constexpr ph::known_device falcon{
    .mass = 0.1, .damping = 0.03, .hand_force = 5.0, .force_limit = 9.0};

/// As a client writes it: the parameters come when the device is open.
class hand_loop {
 public:
  void open(double longest_tick) {
    touch_ = ph::make_touch<d3>(falcon, longest_tick);
    guard_ = ph::make_force_guard<d1>(falcon, longest_tick);
  }
  void surface(const ph::half_space<d3>& plane) { touch_.update(plane); }
  auto tick(const d3::vector& x) { return touch_.tick(x, 1ms); }
  auto guard(double x, double wanted) { return guard_.tick(x, 1ms, wanted); }

 private:
  ph::touch<d3> touch_;
  ph::force_guard<d1> guard_;
};

}  // namespace

TEST_CASE("a model that is a member ticks with force zero until one is assigned to it",
          "[local_model]") {
  hand_loop loop;
  loop.surface({d3::zero(), d3::vector(0, 0, 1), 1000});
  for (int n = 0; n < 5; ++n) {
    const auto out = loop.tick({0, 0, -1e-3});
    CHECK(out.what == ph::event::rejected_parameters);
    CHECK(out.force == d3::zero());
    const auto held = loop.guard(0.0, 1.0);
    CHECK(held.what == ph::event::rejected_parameters);
    CHECK(held.force == 0.0);
  }
  loop.open(1e-3);
  CHECK(loop.tick({0, 0, 0}).what == ph::event::no_target);  // as new
  loop.surface({d3::zero(), d3::vector(0, 0, 1), 1000});
  for (int n = 0; n <= 100; ++n) CHECK(loop.tick({0, 0, -1e-5 * n}).what == ph::event::nominal);
  CHECK_THAT(loop.tick({0, 0, -1e-3}).force(2), WithinRel(1.0, 1e-9));
  CHECK(loop.guard(0.0, 1.0).what == ph::event::nominal);
  CHECK(loop.guard(-0.001, 1.0).force > 0.0);
}

TEST_CASE("a composition by name is the one that is spelt out", "[local_model]") {
  using touch = ph::touch<d1>;
  using spelt = ph::local_model<d1, ph::followed<ph::half_space<d1>>, ph::turn_limited,
                                ph::eased<ph::damped_spring>, ph::forgiving<ph::reduced_energy>,
                                ph::bound_chain<ph::reachable_bound, ph::actuator_limit>>;
  static_assert(std::same_as<touch, spelt>);
  static_assert(touch::passivity == ph::guarantee::conditional);
  static_assert(ph::force_guard<d3>::passivity == ph::guarantee::conditional);
  static_assert(ph::strict_guard<d3>::passivity == ph::guarantee::strict);
  using of_joints = ph::strict_guard<ph::joint_space<double, 4>, ph::diagonal_damping<4>>;
  static_assert(of_joints::passivity == ph::guarantee::strict);
  CHECK_FALSE(ph::make_touch<d1>(falcon, 1e-3).check());
  CHECK_FALSE(ph::make_touch<d3, ph::triangle<d3>>(falcon, 1e-3).check());
  CHECK_FALSE(of_joints(ph::make_strict_guard<ph::joint_space<double, 4>, ph::diagonal_damping<4>>(
                            {{0.01, 0.02, 0.03, 0.04}}, 1e-3))
                  .check());
}

TEST_CASE("make_touch moves its surface smoothly towards the world's", "[local_model]") {
  const auto largest_step = [](auto touch) {
    double last = 0.0, step = 0.0;
    for (int n = 0; n < 5000; ++n) {
      if (n % 33 == 0) REQUIRE(touch.update({1e-3 * std::sin(6.9e-3 * n), 1.0, 2000.0}));
      const double x = std::max(-2e-3, 5e-3 - 1e-5 * n);
      const double force = touch.tick(x, 1ms).force;
      if (n > 1500) step = std::max(step, std::abs(force - last));
      last = force;
    }
    return step;
  };
  constexpr ph::known_device device{
      .mass = 0.1, .damping = 0.3, .hand_force = 5.0, .force_limit = 9.0};
  CHECK(largest_step(ph::make_touch<d1>(device, 1e-3)) < 0.02);
  CHECK(largest_step(ph::local_model{
            d1{}, ph::followed<ph::half_space<d1>>{}, ph::turn_limited{.rate = 2.0},
            ph::damped_spring{.mass = 0.1, .force_limit = 9.0}, ph::reduced_energy{.damping = 0.3},
            ph::bound_chain{ph::reachable_bound{.mass = 0.1, .hand_force = 5.0},
                            ph::actuator_limit{.most = 9.0}},
            ph::loop_limits{.longest_tick = 1e-3}}) > 0.4);  // the control
}

TEST_CASE("make_force_guard is as stiff as it is asked to be, rests and keeps to the motors",
          "[local_model]") {
  struct rest {
    double depth = 0.0, speed = 0.0, energy = 0.0;
  };
  const auto press = [](auto guard) {  // 2 N on 2 kN/m, a relaxed hand
    sim::device<d1, sim::impedance_hand<d1>> device(
        {.mass = 0.1, .damping = 0.06, .load = -2.0},
        {.stiffness = 100.0, .damping = 1.0, .limit = 4.0, .target = 0.0});
    auto sample = device.exchange(0.0);
    rest found;
    for (int n = 0; n < 1000; ++n) {
      sample = device.exchange(guard.tick(sample, std::max(0.0, -2000.0 * sample.position)).force);
      if (n > 900) found.speed = std::max(found.speed, std::abs(device.velocity()));
    }
    found.depth = -device.position();
    found.energy = device.meter().minimum();
    return found;
  };
  auto guard = ph::make_force_guard<d1>(falcon, 1e-3);
  const rest settled = press(guard);
  CHECK_THAT(settled.depth, WithinRel(2.0 / 2100.0, 0.01));
  CHECK(settled.speed < 1e-5);
  CHECK(settled.energy >= 0.0);
  CHECK(press(ph::make_strict_guard<d1>(0.03, 1e-3)).depth > 5.0 * settled.depth);  // soft
  auto rings = ph::passive_port{d1{}, ph::given_force{}, thesis_ledger(),
                                ph::reachable_bound{.mass = 0.1, .hand_force = 6.0}, thesis_loop};
  CHECK(press(rings).speed > 0.01);  // stiff, and never at rest
  for (int n = 0; n < 100; ++n) {
    CHECK(guard.tick(-1e-5 * n, 1ms, 50.0).force <= 9.0 * (1.0 + 1e-12));
  }
}

TEST_CASE("make_encoder_touch is as stiff as the device can pay for, and says so",
          "[local_model]") {
  constexpr ph::design::stated_device grip{.mass = 0.045,
                                           .damping = 0.05,
                                           .friction = 0.13,
                                           .presliding = 15e-6,
                                           .quantum = 55e-6,
                                           .force_limit = 3.3,
                                           .continuous_force = 0.88,
                                           .winding_time = 10.0};
  static_assert(ph::encoder_touch<f1>::passivity == ph::guarantee::conditional);
  constexpr auto in_float = ph::make_encoder_touch<f1>(grip, 5.0);
  static_assert(!in_float.check());
  class {
   public:
    ph::encoder_touch<d3> touch{};  // a member, as a client has it
  } loop;
  CHECK(loop.touch.check());
  loop.touch = ph::make_encoder_touch<d3>(grip, 5.0);
  CHECK_FALSE(loop.touch.check());
  loop.touch.update({d3::zero(), d3::vector(0, 0, 1), 1e4});
  (void)loop.touch.tick({0, 0, 1e-3}, 1ms);
  CHECK(loop.touch.law().is_capped());
  CHECK_THAT(loop.touch.law().stiffness(),
             WithinRel(ph::design::stiffness_budget(grip).stiffness, 1e-12));
  loop.touch.update({d3::zero(), d3::vector(0, 0, 1), 800.0});
  (void)loop.touch.tick({0, 0, 1e-3}, 1ms);
  CHECK_FALSE(loop.touch.law().is_capped());

  const auto refused = [](ph::design::stated_device device) {
    const auto fault = ph::make_encoder_touch<d1>(device, 5.0).check();
    return std::string(fault ? fault.parameter : "");
  };
  CHECK(refused(grip).empty());
  auto other = grip;
  other.friction = 0.0;  // no budget
  CHECK(refused(other) == "most");
  other = grip;
  other.presliding = ph::design::stated_device{}.presliding;  // not stated
  CHECK_FALSE(refused(other).empty());
  other = grip;
  other.winding_time = 0.0;
  CHECK_FALSE(refused(other).empty());
}

TEST_CASE("make_touch and make_force_guard refuse what cannot be, with its name", "[local_model]") {
  const auto refused = [](const ph::known_device& device, double T) {
    const auto fault = ph::make_touch<d1>(device, T).check();
    return std::string(fault ? fault.parameter : "");
  };
  CHECK(refused(falcon, 1e-3).empty());
  CHECK(refused(falcon, 0.0) == "longest_tick");
  CHECK(refused({.mass = 0.1, .hand_force = 5.0, .force_limit = 9.0}, 1e-3) == "damping");
  CHECK(refused({.damping = 0.03, .hand_force = 5.0, .force_limit = 9.0}, 1e-3) == "mass");
  const auto guard_refused = [](const ph::known_device& device, double T) {
    const auto fault = ph::make_force_guard<d1>(device, T).check();
    return std::string(fault ? fault.parameter : "");
  };
  CHECK(guard_refused(falcon, 1e-3).empty());
  CHECK(guard_refused(falcon, -1.0) == "longest_tick");
  CHECK(guard_refused({.mass = 0.1, .hand_force = 5.0, .force_limit = 9.0}, 1e-3) == "damping");
  CHECK(guard_refused({.damping = 0.03, .hand_force = 5.0, .force_limit = 9.0}, 1e-3) == "mass");
  CHECK(std::string(ph::make_strict_guard<d1>(0.0, 1e-3).check().parameter) == "damping");
  CHECK(std::string(ph::make_strict_guard<d1>(0.03, -1.0).check().parameter) == "longest_tick");
}
