// SPDX-License-Identifier: BSD-3-Clause
// Detents and end stops of a knob.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/knob/detents.hpp>
#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/friction_elastic.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace sim = ph::simulation;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using ph::softened_by;

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr ph::exact_device motor{
    .mass = 5e-5, .damping = 1e-3, .force_limit = 0.2, .longest_tick = 1e-3, .rotary = true};
constexpr ph::known_hand fingers{.force = 0.15};
constexpr ph::detents shape{
    .pitch = 0.25, .stiffness = 0.1, .first = -2.0, .last = 2.0, .stop_stiffness = 0.5};

/// What is asked at x, without ledger and damping.
double asked(const ph::detents& of, double x) {
  auto d = of;
  d.rest.mass = 5e-5;
  ph::passive_port port{d1{}, d, ph::no_observer{}, ph::no_bound{},
                        ph::loop_limits{.longest_tick = 1e-4, .top_speed = 1e9, .workspace = inf}};
  (void)port.tick(x, 1ms);
  return port.tick(x, 1ms).force;
}

/// The torque at the end, and the energy, of a knob that a spring of 0.02 N·m/rad has turned to `target`.
struct turned {
  double place, force, least_energy, swing;
};
template <class Port>
turned turn(Port& port, double target, double quantum = 0.0, double friction = 0.0) {
  sim::device<d1, sim::impedance_hand<d1>, sim::slider_and_spring> device(
      {.mass = 5e-5, .damping = 2e-3, .quantum = quantum},
      {.stiffness = 0.05, .damping = 2e-4, .limit = 0.1, .target = target},
      {.level = {friction}, .presliding = {1e-4}});
  auto sample = device.exchange(0.0);
  turned t{0.0, 0.0, 0.0, 0.0};
  double low = inf, high = -inf;
  for (int n = 0; n < 3000; ++n) {
    t.force = port.tick(sample).force;
    sample = device.exchange(t.force);
    t.least_energy = std::min(t.least_energy, device.meter().with_friction());
    if (n > 2500) low = std::min(low, device.position()), high = std::max(high, device.position());
  }
  t.place = device.position();
  t.swing = high - low;
  return t;
}

}  // namespace

TEST_CASE("a detent is as stiff at its bottom as it says, and is where a multiple of the pitch is",
          "[detents]") {
  for (const int n : {-7, -1, 0, 1, 6}) {
    const double here = shape.pitch * n;
    CHECK_THAT(asked(shape, here), WithinAbs(0.0, 1e-15));
    CHECK_THAT(asked(shape, here - 1e-6) / 1e-6, WithinRel(0.1, 1e-4));
    CHECK_THAT(asked(shape, here + 1e-6) / -1e-6, WithinRel(0.1, 1e-4));
    CHECK_THAT(asked(shape, here + shape.pitch / 4), WithinRel(-0.1 * 0.25 / 8, 1e-9));  // most
    CHECK_THAT(asked(shape, here + shape.pitch / 2), WithinAbs(0.0, 1e-12));             // the top
  }
}

TEST_CASE("it is a sine to within 6 % of its top", "[detents]") {
  const double top = 0.1 * 0.25 / 8;
  for (double x = -0.3; x < 0.3; x += 1e-3) {
    CHECK_THAT(asked(shape, x),
               WithinAbs(-top * std::sin(2 * 3.14159265358979 * x / 0.25), 0.0601 * top));
  }
}

TEST_CASE("a way there and back over detents and stops costs nothing", "[detents]") {
  double work = 0.0, most = 0.0;
  const double dx = 1e-3;
  for (int n = -2500; n < 2500; ++n) work += asked(shape, dx * (n + 0.5)) * dx;
  for (int n = 2500; n > -2500; --n) {
    work -= asked(shape, dx * (n - 0.5)) * dx;
    most = std::max(most, std::abs(work));
  }
  CHECK_THAT(work, WithinAbs(0.0, 1e-12));
  CHECK(most > 0.05);
}

TEST_CASE("a stop is a spring that begins where it is, and its force does not step", "[detents]") {
  auto off = shape;
  off.last = 0.3;  // on the way up from a bottom
  const double at_stop = asked(off, 0.3);
  CHECK(at_stop < -1e-3);
  CHECK_THAT(asked(off, 0.3 + 1e-9), WithinAbs(at_stop, 1e-8));
  CHECK_THAT(asked(off, 0.4), WithinRel(at_stop - 0.05, 1e-9));
  CHECK_THAT(asked(off, -2.1), WithinRel(0.05, 1e-9));
  CHECK_THAT(asked({.first = -1.0, .stop_stiffness = 0.5}, -1.2), WithinRel(0.1, 1e-9));
  CHECK(asked({.first = -1.0, .stop_stiffness = 0.5}, 1e6) == 0.0);
  CHECK(asked({.pitch = 0.25, .stiffness = 0.1}, 1e7) == 0.0);  // 40 million detents away
}

TEST_CASE("what is out of range is named", "[detents]") {
  const auto named = [](ph::detents d) {
    d.rest.mass = 1e-4;
    const auto fault = d.check();
    return fault ? std::string(fault.parameter) : "";
  };
  CHECK(named(shape).empty());
  CHECK(named({}).empty());  // a knob that runs free
  CHECK(named({.pitch = 0.0, .stiffness = 1.0}) == "pitch");
  CHECK(named({.pitch = 0.1, .stiffness = -1.0}) == "stiffness");
  CHECK(named({.pitch = 0.1, .stiffness = std::nan("")}) == "stiffness");
  CHECK(named({.first = 1.0, .last = 1.0, .stop_stiffness = 1.0}) == "last");
  CHECK(named({.first = std::nan(""), .stop_stiffness = 1.0}) == "last");
  CHECK(named({.first = 0.0}) == "stop_stiffness");
  CHECK(named({.stop_stiffness = 1.0}) == "stop_stiffness");
  CHECK(named({.most = 0.0}) == "most");
  CHECK(std::string(shape.check().parameter) == "mass");
}

TEST_CASE("a knob comes to rest in the detent that it is turned to, and at its stop", "[detents]") {
  auto knob = ph::make_detents<d1>(motor, fingers, shape);
  REQUIRE_FALSE(knob.check());
  const turned in_detent = turn(knob, 0.27);
  CHECK_THAT(in_detent.place, WithinAbs(0.25, 0.01));
  CHECK(in_detent.swing < 1e-6);
  CHECK(in_detent.least_energy > -1e-12);
  const auto said = knob.explain();
  CHECK(said.asked == 0.1);
  CHECK(said.shown == 0.1);
  CHECK(said.now == softened_by::nothing);

  const turned at_stop = turn(knob, 4.0);
  CHECK(at_stop.swing < 1e-6);
  CHECK(at_stop.least_energy > -1e-12);
  CHECK_THAT(at_stop.force / (2.0 - at_stop.place), WithinRel(0.5, 0.01));
  CHECK(knob.explain().shown == 0.5);
  CHECK_THAT(knob.explain().depth, WithinRel(at_stop.place - 2.0, 1e-3));
}

TEST_CASE("the same stop without damping rings on", "[detents]") {  // the control
  ph::passive_port port{d1{}, ph::given_force{}, ph::reduced_energy{.damping = 1e-3},
                        ph::bound_chain{ph::reachable_bound{.mass = 5e-5, .hand_force = 0.15},
                                        ph::actuator_limit{.most = 0.2}},
                        ph::loop_limits{.longest_tick = 1e-3, .top_speed = 500, .workspace = inf}};
  struct {
    decltype(port)& of;
    auto tick(const ph::device_sample<d1>& s) {
      return of.tick(s, s.position > 2.0 ? -5.0 * (s.position - 2.0) : 0.0);
    }
  } stop{port};
  auto steep = shape;
  steep.stop_stiffness = 5.0;
  auto knob = ph::make_detents<d1>(motor, fingers, steep);
  CHECK(turn(stop, 4.0).swing > 1e-3);
  CHECK(turn(knob, 4.0).swing < 1e-6);
}

TEST_CASE("a stiffness that would ring is shown as stiff as comes to rest, and explained",
          "[detents]") {
  auto steep = shape;
  steep.stop_stiffness = 50.0;
  auto knob = ph::make_detents<d1>(motor, fingers, steep);
  const turned at_stop = turn(knob, 4.0);
  CHECK(at_stop.swing < 1e-6);
  CHECK(at_stop.least_energy > -1e-12);
  const auto said = knob.explain();
  CHECK(said.asked == 50.0);
  CHECK(said.stiffness == softened_by::mass_and_tick);
  CHECK_THAT(said.shown, WithinRel(0.25 * 5e-5 / 1.5e-6, 1e-9));
  CHECK_THAT(at_stop.force / (2.0 - at_stop.place), WithinRel(said.shown, 0.01));
}

TEST_CASE("a knob with 2000 counts has detents, as stiff as its dry friction pays for",
          "[detents]") {
  const double step = 2 * 3.14159265358979 / 2000;
  constexpr ph::encoder_device device{.mass = 5e-5,
                                      .damping = 1e-3,
                                      .friction = 2e-3,
                                      .presliding = 2e-4,
                                      .quantum = 3.2e-3,
                                      .force_limit = 0.2,
                                      .longest_tick = 5e-4,
                                      .rotary = true};
  auto knob = ph::make_detents<d1>(device, fingers, shape);
  REQUIRE_FALSE(knob.check());
  sim::device<d1, sim::impedance_hand<d1>, sim::slider_and_spring> hand(
      {.mass = 5e-5, .damping = 2e-3, .quantum = step, .period = 5e-4},
      {.stiffness = 0.05, .damping = 2e-4, .limit = 0.1, .target = 0.3},
      {.level = {4e-3}, .presliding = {1.5e-4}});
  auto sample = hand.exchange(0.0);
  double most = 0.0, least = 0.0;
  for (int n = 0; n < 6000; ++n) {
    sample = hand.exchange(knob.tick(sample).force);
    most = std::max(most, std::abs(hand.position()));
    least = std::min(least, hand.meter().with_friction());
  }
  const auto said = knob.explain();
  CHECK(said.shown > 0.02);
  CHECK(said.shown <= 0.1);
  CHECK_THAT(hand.position(), WithinAbs(0.25, 0.1));
  CHECK(least > -0.5 * 2e-3 * 2e-4 - 1e-9);
}

TEST_CASE("a stop on encoders that turn lasts under kneading", "[detents]") {
  constexpr ph::encoder_device device{.mass = 4e-5,  // kg·m²
                                      .damping = 4e-5,
                                      .friction = 2.6e-3,
                                      .presliding = 7.5e-4,
                                      .quantum = 2.75e-3,
                                      .force_limit = 0.2,
                                      .rotary = true};
  auto stop = ph::make_touch<d1>(device, ph::known_hand{.force = 0.1});
  const double shown = stop.update({.point = 0.0, .normal = 1.0, .stiffness = 8.0}).stiffness;
  sim::device<d1, sim::impedance_hand<d1>, sim::slider_and_spring> knob(
      {.mass = 4e-5, .damping = 4e-5, .quantum = 2.75e-3, .start = 0.15},
      {.stiffness = 0.12, .damping = 1.2e-3, .limit = 0.09, .target = 0.15},
      {.level = {2.6e-3}, .presliding = {7.5e-4}});
  auto sample = knob.exchange(0.0);
  double pressed = 0.0, is_due = 0.0;
  for (int ms = 0; ms < 30000; ++ms) {
    const double push = 0.025 + 0.005 * std::sin(6e-3 * ms);  // N·m, once a second
    if (ms > 200) knob.hand().target = -push / 0.12;
    const double torque = stop.tick(sample).force;
    if (ms > 15000) {
      pressed += torque;
      is_due += shown * std::max(-sample.position, 0.0);
    }
    sample = knob.exchange(torque);
  }
  CAPTURE(shown);
  CHECK(pressed > 0.9 * is_due);
  CHECK(knob.meter().with_friction() > 0.0);
}

TEST_CASE("parameters of detents change live, and are given back", "[detents]") {
  auto knob = ph::make_detents<d1>(motor, fingers, shape);
  auto other = knob.source().parameters();
  CHECK(other.pitch == shape.pitch);
  CHECK(other.last == shape.last);
  other.stiffness = 0.05;
  CHECK_FALSE(knob.set(other));
  CHECK(knob.explain().asked == 0.05);
  other.pitch = 0.0;
  CHECK(std::string(knob.set(other).parameter) == "pitch");
  CHECK(knob.explain().asked == 0.05);
}

TEST_CASE("a touch on encoders and detents are two sources of one port", "[detents]") {
  constexpr ph::encoder_device device{.mass = 0.1,
                                      .damping = 0.2,
                                      .friction = 0.15,
                                      .presliding = 1e-5,
                                      .quantum = 3e-5,
                                      .force_limit = 9.0};
  constexpr ph::known_hand hand{.force = 5.0};
  constexpr ph::detents notches{.pitch = 5e-3,
                                .stiffness = 1500.0,
                                .most = 1500.0,
                                .rest = {.mass = 0.1, .force_limit = 9.0}};
  ph::passive_port slider{
      d1{},
      ph::contacts{ph::local_contact{ph::followed<ph::half_space<d1>>{}, ph::turn_at_once{},
                                     ph::capped{ph::eased{ph::damped_spring{.mass = 0.1}}, 1500.0}},
                   notches},
      ph::dual_ledger{.damping = {.coefficient = 0.2, .coulomb = 0.15, .presliding = 1e-5},
                      .quantum = 3e-5},
      ph::bound_chain{ph::reachable_bound{.mass = 0.1, .hand_force = 5.0},
                      ph::actuator_limit{.most = 9.0}},
      ph::loop_limits{.longest_tick = 1e-3},
      ph::mass_observer{.mass = 0.1, .quantum = 3e-5}};
  REQUIRE_FALSE(slider.check());
  REQUIRE(slider.source().contact<0>().update({-0.02, 1.0, 1000.0}));
  sim::device<d1, sim::impedance_hand<d1>, sim::slider_and_spring> finger(
      {.mass = 0.1, .damping = 0.3, .quantum = 3e-5},
      {.stiffness = 300, .damping = 1, .limit = 5, .target = 0.0057},
      {.level = {0.3}, .presliding = {8e-6}});
  auto sample = finger.exchange(0.0);
  const auto hold = [&](double target) {
    finger.hand().target = target;
    for (int n = 0; n < 2000; ++n) sample = finger.exchange(slider.tick(sample).force);
    return finger.position();
  };
  CHECK_THAT(hold(0.0057), WithinAbs(5e-3, 8e-4));  // in the first notch
  const double deep = -0.02 - hold(-0.03);          // and in the wall at the fourth
  CHECK(deep > 5e-4);
  CHECK(deep < 4e-3);
  CHECK(finger.meter().with_friction() > 0.0);
  CHECK(ph::make_touch<d1>(device, hand).passivity == decltype(slider)::passivity);
}

TEST_CASE("in float, on a core of its own, it is the same knob", "[detents]") {
  auto wide = ph::make_detents<d1>(motor, fingers, shape);
  auto narrow = ph::make_detents<f1>(motor, fingers, shape);
  double off = 0.0;
  for (int n = 0; n < 4000; ++n) {
    const double x = 2.05 * std::sin(2e-3 * n);
    off = std::max(off, std::abs(wide.tick(x, 1ms).force -
                                 double(narrow.tick(static_cast<float>(x), 1ms).force)));
  }
  CHECK(off < 2e-3);
}
