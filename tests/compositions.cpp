// SPDX-License-Identifier: BSD-3-Clause
// The compositions with a name, and models that are members of a class.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/compositions.hpp>

using Catch::Matchers::WithinRel;

namespace {

constexpr ph::known_device falcon{
    .mass = 0.1, .damping = 0.03, .hand_force = 5.0, .force_limit = 9.0};

/// As a client writes it: the parameters come when the device is open.
class hand_loop {
 public:
  void open(double longest_tick) {
    touch_ = ph::make_touch<d3>(falcon, longest_tick);
    guard_ = ph::make_force_guard<d1>(0.03, longest_tick);
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
  using spelt =
      ph::local_model<d1, ph::followed<ph::half_space<d1>>, ph::turn_limited, ph::damped_spring,
                      ph::reduced_energy, ph::bound_chain<ph::reachable_bound, ph::actuator_limit>>;
  static_assert(std::same_as<touch, spelt>);
  static_assert(touch::passivity == ph::guarantee::conditional);
  static_assert(ph::force_guard<d3>::passivity == ph::guarantee::strict);
  using of_joints = ph::force_guard<ph::joint_space<double, 4>, ph::diagonal_damping<4>>;
  static_assert(of_joints::passivity == ph::guarantee::strict);
  CHECK_FALSE(ph::make_touch<d1>(falcon, 1e-3).check());
  CHECK_FALSE(ph::make_touch<d3, ph::triangle<d3>>(falcon, 1e-3).check());
  CHECK_FALSE(of_joints(ph::make_force_guard<ph::joint_space<double, 4>, ph::diagonal_damping<4>>(
                            {{0.01, 0.02, 0.03, 0.04}}, 1e-3))
                  .check());
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
  CHECK(std::string(ph::make_force_guard<d1>(0.0, 1e-3).check().parameter) == "damping");
  CHECK(std::string(ph::make_force_guard<d1>(0.03, -1.0).check().parameter) == "longest_tick");
}
