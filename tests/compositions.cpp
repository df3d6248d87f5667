// SPDX-License-Identifier: BSD-3-Clause
// The compositions with a name, and models that are members of a class.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/compositions.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/friction_bristle.hpp>
#include <passive_haptics/simulation/friction_elastic.hpp>

#include <random>
#include <string>

using Catch::Matchers::WithinRel;
namespace sim = ph::simulation;

namespace {

constexpr ph::exact_device falcon{.mass = 0.1, .damping = 0.03, .force_limit = 9.0};
constexpr ph::known_hand hand{.force = 5.0};

constexpr ph::encoder_device grip{.mass = 0.045,
                                  .damping = 0.05,
                                  .friction = 0.13,
                                  .presliding = 15e-6,
                                  .quantum = 55e-6,
                                  .force_limit = 3.3,
                                  .continuous_force = 0.88,
                                  .winding_time = 10.0};
constexpr ph::slots<ph::half_space<d1>, 2> room;
constexpr ph::slots<ph::half_space<d3>, 3> space_room;

/// As a client writes it: the parameters come when the device is open.
class hand_loop {
 public:
  void open(double longest_tick) {
    auto device = falcon;
    device.longest_tick = longest_tick;
    touch_ = ph::make_touch<d3>(device, hand);
    guard_ = ph::make_guard<d1>(device, hand);
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

TEST_CASE("make_touch lets go of a device that does the opposite, and says so", "[local_model]") {
  auto touch = ph::make_touch<d1>({.mass = 0.1, .damping = 0.1, .force_limit = 9}, {.force = 5});
  (void)touch.update({.point = 0, .normal = 1, .stiffness = 2000});
  sim::device<d1, sim::impedance_hand<d1>> device(
      {.mass = 0.1, .damping = 0.2, .start = 0.005},
      {.stiffness = 300, .damping = 1, .limit = 4, .target = -0.01});
  auto s = device.exchange(0);
  ph::event what{};
  for (int n = 0; n < 70; ++n) {  // 16 ms until it touches
    const auto out = touch.tick(s);
    what = out.what;
    s = device.exchange(-out.force);
  }
  CHECK(what == ph::event::wrong_sign);
  CHECK(device.meter().minimum() > -5e-3);
}

TEST_CASE("a composition by name is the one that is spelt out", "[local_model]") {
  using touch = ph::touch<d1>;
  using spelt =
      ph::local_model<d1, ph::followed<ph::half_space<d1>>, ph::turn_limited,
                      ph::eased<ph::damped_spring>, ph::forgiving<ph::reduced_energy>,
                      ph::bound_chain<ph::watched<ph::reachable_bound>, ph::actuator_limit>>;
  static_assert(std::same_as<touch, spelt>);
  static_assert(touch::passivity == ph::guarantee::conditional);
  static_assert(ph::force_guard<d3>::passivity == ph::guarantee::conditional);
  static_assert(ph::strict_guard<d3, ph::actuator_limit>::passivity == ph::guarantee::strict);
  using joints = ph::joint_space<double, 4>;
  using of_joints = ph::strict_guard<joints, ph::motor_limits<4>, ph::diagonal_damping<4>>;
  static_assert(of_joints::passivity == ph::guarantee::strict);
  CHECK_FALSE(ph::make_touch<d1>(falcon, hand).check());
  CHECK_FALSE(ph::make_touch<d3, ph::triangle<d3>>(falcon, hand).check());
  CHECK_FALSE(of_joints(ph::make_strict_guard<joints, ph::diagonal_damping<4>>(
                            {{0.01, 0.02, 0.03, 0.04}}, ph::motor_limits<4>{{1, 1, 1, 1}}, 1e-3))
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
  constexpr ph::exact_device device{.mass = 0.1, .damping = 0.3, .force_limit = 9.0};
  CHECK(largest_step(ph::make_touch<d1>(device, hand)) < 0.02);
  CHECK(largest_step(ph::local_model{
            d1{}, ph::followed<ph::half_space<d1>>{}, ph::turn_limited{.rate = 2.0},
            ph::damped_spring{.mass = 0.1, .force_limit = 9.0}, ph::reduced_energy{.damping = 0.3},
            ph::bound_chain{ph::reachable_bound{.mass = 0.1, .hand_force = 5.0},
                            ph::actuator_limit{.most = 9.0}},
            ph::loop_limits{.longest_tick = 1e-3}}) > 0.4);  // the control
}

TEST_CASE("make_guard is as stiff as it is asked to be, rests and keeps to the motors",
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
  auto guard = ph::make_guard<d1>(falcon, hand);
  const rest settled = press(guard);
  CHECK_THAT(settled.depth, WithinRel(2.0 / 2100.0, 0.01));
  CHECK(settled.speed < 1e-5);
  CHECK(settled.energy >= 0.0);
  CHECK(press(ph::make_guard<d1>(falcon, ph::any_hand)).depth > 5.0 * settled.depth);  // soft
  auto rings = ph::passive_port{d1{}, ph::given_force{}, thesis_ledger(),
                                ph::reachable_bound{.mass = 0.1, .hand_force = 6.0}, thesis_loop};
  CHECK(press(rings).speed > 0.01);  // stiff, and never at rest
  for (int n = 0; n < 100; ++n) {
    CHECK(guard.tick(-1e-5 * n, 1ms, 50.0).force <= 9.0 * (1.0 + 1e-12));
  }
}

TEST_CASE("a composition says what settles in it, and a spring on encoders what it steps by",
          "[local_model]") {
  constexpr auto guard = ph::make_guard<d1>(falcon, hand);
  constexpr double most = ph::settled_force{.mass = falcon.mass}.most_stiffness(1e-3);
  static_assert(guard.source().settles(most) && !guard.source().settles(1.01 * most));
  static_assert(guard.source().settles(most / 4.0, 3) && !guard.source().settles(most / 2.0, 3));
  constexpr ph::exact_device late_falcon{
      .mass = 0.1, .damping = 0.03, .force_limit = 9.0, .latency = 1};
  constexpr auto late = ph::make_guard<d1, ph::late_loop_limits<1>>(late_falcon, hand);
  static_assert(late.source().settles(0.29 * most) && !late.source().settles(0.31 * most));
  static_assert(!ph::settled_force{.mass = 0.1, .lead = 2.0}.settles(100.0, 1e-3, 2));

  ph::local_model wall{d1{},
                       ph::fixed{ph::half_space<d1>{0.0, 1.0, 2000.0}},
                       ph::turn_at_once{},
                       ph::spring{},
                       ph::quantised_energy{.damping = {0.03}, .quantum = 60e-6},
                       ph::strict_bound{},
                       ph::loop_limits{.longest_tick = 1e-3}};
  const double step =
      wall.source().law().force(1060e-6, 0.0) - wall.source().law().force(1e-3, 0.0);
  CHECK_THAT(wall.force_step(2000.0), WithinRel(step, 1e-9));
  CHECK_THAT(step, WithinRel(0.12, 1e-9));
}

TEST_CASE("make_touch on encoders is as stiff as the device can pay for, and says so",
          "[local_model]") {
  static_assert(ph::encoder_touch<f1>::passivity == ph::guarantee::conditional);
  constexpr auto in_float = ph::make_touch<f1>(grip, hand);
  static_assert(!in_float.check());
  class {
   public:
    ph::encoder_touch<d3> touch{};  // a member, as a client has it
  } loop;
  CHECK(loop.touch.check());
  loop.touch = ph::make_touch<d3>(grip, hand);
  CHECK_FALSE(loop.touch.check());
  loop.touch.update({d3::zero(), d3::vector(0, 0, 1), 1e4});
  (void)loop.touch.tick({0, 0, 1e-3}, 1ms);
  CHECK(loop.touch.law().is_capped());
  CHECK_THAT(loop.touch.law().stiffness(),
             WithinRel(ph::design::stiffness_budget(grip).stiffness, 1e-12));
  loop.touch.update({d3::zero(), d3::vector(0, 0, 1), 800.0});
  (void)loop.touch.tick({0, 0, 1e-3}, 1ms);
  CHECK_FALSE(loop.touch.law().is_capped());

  constexpr float one_step = in_float.force_step(500.0F);  // the floor under which nothing is quiet
  CHECK_THAT(one_step, WithinRel(500.0F * 55e-6F, 1e-5F));
  CHECK_THAT(
      loop.touch.force_step(1e4),
      WithinRel(ph::design::stiffness_budget(grip).stiffness * 55e-6 * std::sqrt(3.0), 1e-9));
  CHECK(ph::make_touch<d1>(falcon, hand).force_step(1e4) == 0.0);

  const auto refused = [](const ph::encoder_device& device) {
    const auto fault = ph::make_touch<d1>(device, hand).check();
    return std::string(fault ? fault.parameter : "");
  };
  CHECK(refused(grip).empty());
  auto other = grip;
  other.friction = 0.0;  // no budget, and no distance over which it would be elastic
  other.presliding = ph::encoder_device{}.presliding;
  CHECK(refused(other) == "most");
  other = grip;
  other.presliding = ph::encoder_device{}.presliding;  // not stated
  CHECK_FALSE(refused(other).empty());
  other = grip;
  other.winding_time = 0.0;
  CHECK_FALSE(refused(other).empty());
}

TEST_CASE("a composition refuses a device or a hand that cannot be, with the name of what is wrong",
          "[local_model]") {
  const auto refused = [](const auto& made) {
    const auto fault = made.check();
    return std::string(fault ? fault.parameter : "");
  };
  const auto every = [&](const auto& device, const auto& person, const std::string& parameter) {
    CAPTURE(parameter);
    CHECK(refused(ph::make_touch<d1>(device, person)) == parameter);
    CHECK(refused(ph::make_guard<d1>(device, person)) == parameter);
    CHECK(refused(ph::make_contacts<d1>(device, person, room)) == parameter);
  };
  const auto without = [](double ph::exact_device::*member) {
    auto device = falcon;
    device.*member = 0.0;
    return device;
  };
  every(falcon, hand, "");
  every(falcon, ph::any_hand, "");
  every(without(&ph::exact_device::longest_tick), hand, "longest_tick");
  every(without(&ph::exact_device::damping), hand, "damping");
  every(without(&ph::exact_device::mass), hand, "mass");
  CHECK(refused(ph::make_touch<d1>(falcon, ph::known_hand{})) == "hand_force");
  CHECK(refused(ph::make_guard<d1>(falcon, ph::known_hand{})) == "hand_force");
  CHECK(ph::make_touch<d1>(falcon, ph::known_hand{.force = -5.0}).check().value == -5.0);
  const auto none = [](const auto& port) {  // the value is named, and that more is asked for
    return port.check().value == 0.0 && std::string(port.check().remedy) == "stated, finite, > 0 N";
  };
  CHECK(none(ph::make_touch<d1>(falcon, ph::known_hand{.force = 0.0})));
  CHECK(none(ph::make_guard<d1>(falcon, ph::trusted_hand{})));
  CHECK(none(ph::make_touch<ph::space<float, 1>>(falcon, ph::known_hand{})));
  CHECK_FALSE(refused(ph::make_touch<d1>(without(&ph::exact_device::force_limit), hand)).empty());
  CHECK_FALSE(
      refused(ph::make_guard<d1>(without(&ph::exact_device::force_limit), ph::any_hand)).empty());
  auto late = falcon;  // a device that is later than the limits of the loop say
  late.latency = 1;
  every(late, hand, "longest_tick");
  CHECK(refused(ph::make_guard<d1, ph::late_loop_limits<1>>(late, hand)).empty());
  CHECK(refused(ph::make_guard<d1, ph::late_loop_limits<1>>(falcon, hand)) == "longest_tick");
  CHECK(refused(ph::make_strict_guard<d1>(0.0, ph::actuator_limit{9.0}, 1e-3)) == "damping");
  CHECK(refused(ph::make_strict_guard<d1>(0.03, ph::actuator_limit{-9.0}, 1e-3)) == "most");
}

TEST_CASE("what is composed for any hand is strict, for one that is known conditional",
          "[local_model]") {
  const auto promise = [](const auto& port) { return std::decay_t<decltype(port)>::passivity; };
  const auto both = [&](const auto& device) {
    CHECK(promise(ph::make_touch<d3>(device, ph::any_hand)) == ph::guarantee::strict);
    CHECK(promise(ph::make_guard<d3>(device, ph::any_hand)) == ph::guarantee::strict);
    CHECK(promise(ph::make_contacts<d3>(device, ph::any_hand, space_room)) ==
          ph::guarantee::strict);
    CHECK(promise(ph::make_touch<d3>(device, hand)) == ph::guarantee::conditional);
    CHECK(promise(ph::make_guard<d3>(device, hand)) == ph::guarantee::conditional);
    CHECK(promise(ph::make_contacts<d3>(device, hand, space_room)) == ph::guarantee::conditional);
  };
  both(falcon);
  both(grip);
  CHECK(promise(ph::make_contacts<d3>(falcon, hand, ph::stick_slip{}, space_room)) ==
        ph::guarantee::conditional);
}

TEST_CASE("every composition keeps to the motors' limit, whatever it is asked", "[local_model]") {
  const auto most = [](auto port) {
    double force = 0.0;
    for (int n = 0; n < 300; ++n) {
      if constexpr (requires { port.source().slot(0); }) {
        if (n % 50 == 0) port.source().update(0, {0.0, 1.0, 5e4});
        force = std::max(force, port.tick(1e-3 - 2e-5 * n, 1ms).force);
      } else if constexpr (requires { port.update({0.0, 1.0, 5e4}); }) {
        if (n % 50 == 0) CHECK(port.update({0.0, 1.0, 5e4}));
        force = std::max(force, port.tick(1e-3 - 2e-5 * n, 1ms).force);
      } else {
        force = std::max(force, port.tick(1e-3 - 2e-5 * n, 1ms, 100.0).force);
      }
    }
    return force;
  };
  const auto all = [&](const auto& device, const auto& person) {
    for (const double force :
         {most(ph::make_touch<d1>(device, person)), most(ph::make_guard<d1>(device, person)),
          most(ph::make_contacts<d1>(device, person, room))}) {
      CHECK(force > 0.2 * device.force_limit);
      CHECK(force <= device.force_limit * (1.0 + 1e-12));
    }
  };
  all(falcon, hand);
  all(grip, hand);
  auto damped = falcon;  // what a strict bound is stiff for
  damped.damping = 3.0;
  all(damped, ph::any_hand);
}

TEST_CASE("a corner on encoders comes to rest at what its friction pays for", "[local_model]") {
  const double q = grip.quantum, K = 2000.0;
  auto corner = ph::make_contacts<d1>(grip, hand, room);
  const auto taken = corner.source().update(0, {0.0, 1.0, 1e4});
  sim::device<d1, sim::impedance_hand<d1>, sim::slider_and_spring> device(
      {.mass = 0.045, .damping = 0.1, .force_limit = 3.3, .quantum = q, .start = 5e-3},
      {.stiffness = 300.0, .damping = 1.0, .limit = 4.0, .target = -6e-3},
      {.level = {0.26}, .presliding = {grip.presliding}});
  auto sample = device.exchange(0.0);
  double last = 0.0, step = 0.0;
  for (int n = 0; n < 3000; ++n) {
    const double force = corner.tick(sample).force;
    if (n > 2000) step = std::max(step, std::abs(force - last));
    sample = device.exchange(last = force);
  }
  const auto said = corner.explain();
  CHECK(said.asked == 1e4);
  CHECK(said.shown < 1.1 * K);
  CHECK(taken.stiffness == said.shown);
  CHECK_FALSE(corner.source().update(0, {0.0, 0.0, 1e4}));
  CHECK(said.stiffness != ph::softened_by::nothing);
  CHECK(last > 0.5);
  CHECK(step <= said.shown * q);
  CHECK(device.meter().with_friction() >= 0.0);
}

TEST_CASE("a guard on coarse encoders calls no honest device a debtor", "[compositions]") {
  std::mt19937_64 random(8);
  const auto between = [&random](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  int doubtful = 0;
  for (int scene = 0; scene < 72; ++scene) {
    const bool noisy = scene >= 12;  // positions that are off by any part of ±q/2
    const ph::encoder_device made{.mass = between(0.05, 0.5),
                                  .damping = between(0.1, 2.0),
                                  .friction = between(0.2, 0.8),
                                  .presliding = 3e-5,
                                  .quantum = between(2e-4, 2e-3),
                                  .force_limit = 9.0};
    auto guard = ph::make_guard<d1>(made, ph::known_hand{.force = 5.0});
    sim::device<d1, sim::impedance_hand<d1>, sim::dahl_friction> device(
        {.mass = made.mass,
         .damping = made.damping,
         .quantum = noisy ? 0.0 : made.quantum,
         .start = 2e-3},
        {.stiffness = between(100.0, 1000.0), .damping = between(0.0, 8.0), .limit = 5.0},
        {made.friction, made.presliding});
    const double K = between(1000.0, 4000.0), turns = between(1.0, 40.0);
    double least = 0.0, force = 0.0;
    for (int n = 0; n < 4000; ++n) {
      device.hand().target = -3e-3 + 3e-3 * std::sin(turns * 1e-3 * n);
      auto sample = device.exchange(force);
      if (noisy) sample.position += made.quantum * between(-0.5, 0.5);
      const auto out = guard.tick(sample, sample.position < 0.0 ? -K * sample.position : 0.0);
      CAPTURE(scene, n, guard.energy());
      REQUIRE(out.what != ph::event::debt);
      REQUIRE(out.what != ph::event::wall_lost);
      force = out.force;
      least = std::min(least, guard.energy());
    }
    doubtful += least < -9.0 * 2.5e-3 / 64.0;
    CHECK(device.meter().with_friction() >= 0.0);
  }
  CHECK(doubtful > 2);
}

TEST_CASE("a knob turns faster than a step a tick, and as often as it likes", "[local_model]") {
  constexpr double pi = 3.14159265358979, T = 5e-4;
  ph::encoder_device knob{.mass = 5e-5,
                          .damping = 1e-3,
                          .friction = 2e-3,
                          .presliding = 2e-3,
                          .quantum = 2.0 * pi / 2000.0,
                          .force_limit = 0.2,
                          .longest_tick = T,
                          .rotary = true};
  const auto refused = [](auto port, double speed) {  // to an end stop 20 turns away
    CHECK(port.update({.point = 125.0, .normal = -1.0, .stiffness = 0.5}));
    int bad = 0;
    for (double x = 0.0; x < 126.0; x += speed * T) {
      bad += port.tick(x, ph::seconds{T}).what >= ph::event::outside_workspace;
    }
    return bad;
  };
  for (const double speed : {1.0, 9.4, 60.0}) {
    CHECK(refused(ph::make_touch<d1>(knob, ph::known_hand{.force = 0.1}), speed) == 0);
  }
  knob.rotary = false;
  CHECK(refused(ph::make_touch<d1>(knob, ph::known_hand{.force = 0.1}), 60.0) > 0);  // the control
  knob.top_speed = 3.0;
  CHECK(refused(ph::make_touch<d1>(knob, ph::known_hand{.force = 0.1}), 9.4) > 0);
}

TEST_CASE("a description doubts what can be and is surely a slip", "[local_model]") {
  const auto doubted = [](auto device) {
    const auto fault = device.doubt();
    return std::string(fault ? fault.parameter : "");
  };
  CHECK(doubted(falcon).empty());
  CHECK(doubted(grip).empty());
  auto slip = falcon;
  slip.longest_tick = 1.0;  // ms
  CHECK(doubted(slip) == "longest_tick");
  slip = falcon;
  slip.mass = 100.0;  // g
  CHECK(doubted(slip) == "mass");
  slip = falcon;
  slip.damping = 30.0;
  CHECK(doubted(slip) == "damping");
  slip = falcon;
  slip.force_limit = 9000.0;
  CHECK(doubted(slip) == "force_limit");
  slip = falcon;
  slip.mass = 5.0;
  CHECK(doubted(slip).empty());
  slip.rotary = true;
  CHECK(doubted(slip) == "mass");
  CHECK_FALSE(slip.check());
  CHECK(doubted(ph::exact_device{}) == "damping");
  slip = falcon;
  slip.latency = 1000;  // µs
  CHECK(doubted(slip) == "latency");
  auto coarse = grip;
  coarse.friction = 2.0;
  CHECK(doubted(coarse) == "friction");
  coarse = grip;
  coarse.quantum = 0.055;  // mm
  CHECK(doubted(coarse) == "quantum");
  coarse.rotary = true;
  CHECK(doubted(coarse).empty());  // 114 counts
  coarse = grip;
  coarse.presliding = 15.0;  // µm
  CHECK(doubted(coarse) == "presliding");
}

TEST_CASE("a hand is doubted that no hand is", "[local_model]") {
  const auto doubted = [](double force) { return bool(ph::known_hand{.force = force}.doubt(9.0)); };
  CHECK_FALSE(doubted(5.0));
  CHECK_FALSE(doubted(250.0));
  CHECK_FALSE(ph::known_hand{.force = 0.05}.doubt(0.2));  // N·m
  CHECK(doubted(0.0));
  CHECK(doubted(0.01));
  CHECK(doubted(5000.0));  // mN
  CHECK(doubted(std::nan("")));
  CHECK(ph::make_touch<d1>(falcon, ph::known_hand{}).check());  // of these, 0 is refused, too
}
