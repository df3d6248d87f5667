// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/contact/at_tip.hpp>
#include <passive_haptics/contact/contact_set.hpp>
#include <passive_haptics/contact/contacts.hpp>
#include <passive_haptics/contact/given_force.hpp>
#include <passive_haptics/contact/rigid_tool.hpp>

static_assert(ph::loop_limits::latency == 0 && !ph::loop_limits::traits.watched);
static_assert(ph::late_loop_limits<3>::latency == 3 && !ph::late_loop_limits<3>::traits.watched);
static_assert(ph::watched_loop_limits<>::traits.watched &&
              ph::watched_loop_limits<2>::latency == 2);
static_assert(ph::loop_limits{}.top_speed == 5.0);
static_assert(ph::limits_for<ph::late_loop_limits<3>, d1> && !ph::limits_for<ph::spring, d1>);

TEST_CASE("the longest tick of a loop is never assumed", "[loop_limits]") {
  const auto refused = [](const ph::loop_limits& limits) {
    const auto fault = limits.check();
    return std::string(fault ? fault.parameter : "");
  };
  const double nan = std::nan("");
  CHECK(refused({.longest_tick = 1e-3}).empty());
  CHECK(refused({}) == "longest_tick");
  for (const double bad : {0.0, -1e-3, nan, HUGE_VAL}) {
    CHECK(refused({.longest_tick = bad}) == "longest_tick");
    CHECK(refused({.longest_tick = 1e-3, .top_speed = bad}) == "top_speed");
  }
  for (const double bad : {0.0, -1.0, nan}) {
    CHECK(refused({.longest_tick = 1e-3, .workspace = bad}) == "workspace");
  }
  for (const double bad : {0.0, -1e-3, nan, 0.9e-3}) {
    CHECK(refused({.longest_tick = 1e-3, .watchdog = bad}) == "watchdog");
  }
  CHECK(refused({.longest_tick = 1e-3, .workspace = HUGE_VAL, .watchdog = 1e-3}).empty());
}

TEST_CASE("loop limits are kept in the port's scalar, and given back", "[loop_limits]") {
  const ph::loop_limits::on<f1> limits(
      {.longest_tick = 0.0011, .top_speed = 3.0, .workspace = 0.5, .watchdog = 0.125});
  CHECK(limits.longest_tick == 0.0011F);
  CHECK(limits.parameters().top_speed == 3.0);
  CHECK(limits.parameters().workspace == 0.5);
  CHECK(limits.parameters().watchdog == 0.125);
  CHECK(ph::loop_limits::on<f1>(thesis_loop).parameters().watchdog == double(1e-3F));
  static_assert(sizeof(limits) == 4 * sizeof(float));
}

TEST_CASE("a loop that learns its longest tick says so in its type, and goes by the longest so far",
          "[loop_limits]") {
  const auto guard_with = [](const auto& limits) {
    return ph::passive_port{d1{}, ph::given_force{}, thesis_ledger(), ph::strict_bound{}, limits};
  };
  auto learns = guard_with(ph::learning_loop_limits<>{.longest_tick = 1e-3});
  auto states = guard_with(ph::loop_limits{.longest_tick = 1e-3});
  static_assert(decltype(learns)::passivity == ph::guarantee::conditional);
  static_assert(decltype(states)::passivity == ph::guarantee::strict);
  for (auto tick : {0, 1}) {
    (void)tick;
    CHECK(learns.tick(0.0, 1ms, 0.0).what == ph::event::nominal);
    CHECK(states.tick(0.0, 1ms, 0.0).what == ph::event::nominal);
  }
  CHECK(learns.tick(0.0, 1500us, 0.0).what == ph::event::late_tick);
  CHECK(states.tick(0.0, 1500us, 0.0).what == ph::event::late_tick);
  CHECK(learns.tick(0.0, 1500us, 0.0).what == ph::event::late_tick);  // the first is nobody's word
  CHECK(learns.tick(0.0, 1500us, 0.0).what == ph::event::nominal);
  CHECK(states.tick(0.0, 1500us, 0.0).what == ph::event::late_tick);
  CHECK(learns.tick(0.0, 1ms, 0.0).what == ph::event::nominal);
  CHECK(learns.tick(0.0, 1400us, 0.0).what == ph::event::nominal);
  // the same energy covers less force then
  const auto push = [](auto& port) {
    (void)port.tick(1e-3, 1ms, 0.0);
    return port.tick(1e-3, 1ms, 100.0).force;
  };
  const double less = push(learns), more = push(states);
  CHECK(less > 0.0);
  CHECK_THAT(more / less, Catch::Matchers::WithinRel(std::sqrt(1.5), 1e-6));
}

TEST_CASE("a loop learns from ticks up to ten times as long as its longest, and from no other",
          "[loop_limits]") {
  ph::passive_port port{d1{}, ph::given_force{}, thesis_ledger(), ph::strict_bound{},
                        ph::learning_loop_limits<>{.longest_tick = 1e-3}};
  (void)port.tick(0.0, 1ms, 0.0);
  for (const double dt :
       {0.0101, 1.0, 1e160}) {  // a debugger, a laptop that slept, no number of a clock
    CHECK(port.tick(0.0, ph::seconds{dt}, 0.0).what == ph::event::late_tick);
    CHECK(port.longest_tick() == 1e-3);
  }
  for (const double T : {1e-3, 9e-3}) {
    CHECK(port.tick(0.0, 9ms, 0.0).what == ph::event::late_tick);
    CHECK(port.longest_tick() == T);
  }
  ph::passive_port dropping{d1{}, ph::given_force{}, thesis_ledger(), ph::strict_bound{},
                            ph::learning_loop_limits<>{.longest_tick = 1e-3, .watchdog = 4e-3}};
  for (const double dt : {1e-3, 9e-3, 9e-3}) (void)dropping.tick(0.0, ph::seconds{dt}, 0.0);
  CHECK(dropping.longest_tick() == 4e-3);  // no force is held for longer
}

TEST_CASE("a loop learns from no long tick that stays alone, and forgets what is over",
          "[loop_limits]") {
  ph::passive_port port{d1{}, ph::given_force{}, thesis_ledger(), ph::strict_bound{},
                        ph::learning_loop_limits<>{.longest_tick = 1e-3}};
  const auto T_after = [&port](double seconds, double tick = 1e-3) {
    for (double t = 0.5 * tick; t < seconds; t += tick) {
      (void)port.tick(0.0, ph::seconds{tick}, 0.0);
    }
    return port.longest_tick();
  };
  for (const double dt : {1.5e-3, 10e-3, 5e-3}) {  // one by one, more than 10 s apart
    CHECK(port.tick(0.0, ph::seconds{dt}, 0.0).what == ph::event::late_tick);
    CHECK(T_after(10.1) == 1e-3);
  }
  CHECK(T_after(4e-3, 4e-3) == 1e-3);
  CHECK(T_after(9.9) == 1e-3);
  CHECK(T_after(3e-3, 3e-3) == 3e-3);  // the second is no accident
  CHECK(T_after(20.0, 2e-3) == 3e-3);  // it is kept as long as there are others about as long
  CHECK(T_after(9.9) == 3e-3);
  CHECK(T_after(0.2) == 1e-3);
  for (int n = 0; n < 20; ++n) {  // with a tick of 8 ms every 5 s it is late twice, and then never
    CHECK((port.tick(0.0, 8ms, 0.0).what == ph::event::late_tick) == (n < 2));
    (void)T_after(5.0);
  }
}

TEST_CASE("the tick that a loop learns from is late for its bound, too", "[loop_limits]") {
  const auto pushed_in = [](const auto& limits) {
    ph::passive_port port{d1{}, ph::given_force{}, thesis_ledger(), ph::memoryless_bound{}, limits};
    (void)port.tick(0.0, ph::seconds{1e-3}, 0.0);
    (void)port.tick(1e-4, ph::seconds{1e-3}, 1e-3);
    return port.tick(2e-4, ph::seconds{1.5e-3}, 1e-3);
  };
  const auto learns = pushed_in(ph::learning_loop_limits<>{.longest_tick = 1e-3});
  const auto told = pushed_in(ph::loop_limits{.longest_tick = 1.5e-3});
  CHECK(learns.what == ph::event::late_tick);
  CHECK(learns.force == 0.0);  // what it held was bounded for a shorter one
  CHECK(told.what == ph::event::nominal);
  CHECK(told.force > 0.0);
}

namespace {

constexpr double stiff = 1e5;  // more than 0.1 kg can be held with in ticks of 1 ms [N/m]
const ph::half_space<d1> stiff_wall{0.0, 1.0, stiff};
const ph::half_space<d3> stiff_floor{d3::zero(), d3::vector(0, 0, 1), stiff};
constexpr ph::proxy_spring proxy{.mass = 0.1};

/// A port that gives what its source asks for, in a loop that is told of ticks of 1 ms, and in one that was
/// told of 0.1 ms and learns: the second presses as the first does. `tell` brings a surface, if there is one.
template <class Port, class Source, class Pose>
void check_that_it_learns(const Source& source, auto tell, const Pose& outside,
                          const Pose& inside) {
  ph::passive_port told{Port{}, source, ph::no_observer{}, ph::no_bound{},
                        ph::loop_limits{.longest_tick = 1e-3}};
  ph::passive_port learns{Port{}, source, ph::no_observer{}, ph::no_bound{},
                          ph::learning_loop_limits<>{.longest_tick = 1e-4}};
  for (const bool again : {false, true}) {  // news that come before the loop has learned, and after
    tell(told.source());
    tell(learns.source());
    for (const Pose& x : {outside, outside, inside, inside, inside}) {
      const auto expected = told.tick(x, ph::seconds{1e-3});
      const auto found = learns.tick(x, ph::seconds{1e-3});
      CAPTURE(again, found.depth);
      CHECK(found.force == expected.force);
      CHECK((expected.depth > 0.0) == !(expected.force == Port::zero()));
    }
  }
  CHECK(told.longest_tick() == 1e-3);
  CHECK(learns.longest_tick() == 1e-3);
  REQUIRE_FALSE(told.set(ph::loop_limits{.longest_tick = 2e-3}));
  CHECK(told.longest_tick() == 2e-3);
  CHECK_FALSE(told.tick(inside, ph::seconds{1e-3}).force ==
              learns.tick(inside, ph::seconds{1e-3}).force);  // softer
  for (int k = 0; k < 2; ++k) (void)learns.tick(inside, ph::seconds{2e-3});
  for (int k = 0; k < 2000; ++k) {  // sets do not step there
    (void)told.tick(inside, ph::seconds{1e-3});
    (void)learns.tick(inside, ph::seconds{1e-3});
  }
  CHECK(told.tick(inside, ph::seconds{1e-3}).force == learns.tick(inside, ph::seconds{1e-3}).force);
}
constexpr auto silent = [](auto& /*source*/) {};

}  // namespace

TEST_CASE("a wall is as stiff as the ticks that its loop has learned of can hold",
          "[loop_limits]") {
  const auto wall = [](const auto& supply) {
    return ph::local_contact{supply, ph::turn_at_once{}, ph::damped_spring{.mass = 0.1}};
  };
  SECTION("one that is fixed") {
    check_that_it_learns<d1>(wall(ph::fixed{stiff_wall}), silent, 1e-3, -1e-3);
  }
  SECTION("one that is followed, silent or not") {
    check_that_it_learns<d1>(wall(ph::followed{stiff_wall}), silent, 1e-3, -1e-3);
    check_that_it_learns<d1>(
        wall(ph::followed<ph::half_space<d1>>{}), [](auto& one) { one.update(stiff_wall); }, 1e-3,
        -1e-3);
  }
  SECTION("one among other contacts") {
    check_that_it_learns<d1>(ph::contacts{wall(ph::fixed{stiff_wall}), ph::given_force{}}, silent,
                             1e-3, -1e-3);
  }
  SECTION("one in a set") {
    check_that_it_learns<d1>(
        ph::contact_set{proxy, ph::pursuit{}, ph::slots<ph::half_space<d1>, 2>{}},
        [](auto& set) { set.update(0, stiff_wall); }, 1e-3, -1e-3);
  }
  SECTION("one at the tip of a stylus") {
    const ph::rigid_pose<double> above{{0, 0, 0.101}, {}}, below{{0, 0, 0.099}, {}};
    check_that_it_learns<ph::stylus<double>>(
        ph::at_tip{ph::contact_set{proxy, ph::pursuit{}, ph::slots<ph::half_space<d3>, 1>{}},
                   {0.0, 0.0, -0.1}},
        [](auto& tip) { tip.contact().update(0, stiff_floor); }, above, below);
  }
  SECTION("one under a rigid tool") {
    const ph::rigid_pose<double> above{{0, 0, 0.101}, {}}, below{{0, 0, 0.099}, {}};
    check_that_it_learns<ph::rigid_body<double>>(
        ph::rigid_tool{ph::tool_spring{.mass = 0.15, .least_inertia = 1e-4}, ph::pursuit{},
                       ph::slots<ph::half_space<d3>, 2>{}},
        [](auto& tool) {
          tool.update(1, {0.02, 0.0, -0.1}, stiff_floor);
        },
        above, below);
  }
}

namespace {

constexpr double step = 60e-6;  // of an encoder [m]

/// The worst event of a run, and how many new places were shown until it was a repeated sample.
struct seen {
  int repeated = 0;
  int places_before = 0;
};
template <class Limits>
seen watch(const Limits& limits, auto place_at, int ticks) {
  ph::passive_port guard{d1{}, ph::given_force{}, thesis_ledger(), ph::strict_bound{}, limits};
  seen result;
  double last = 1e9;
  for (int n = 0; n < ticks; ++n) {
    const double x = place_at(n);
    const auto out = guard.tick(x, 1ms, 0.0);
    if (out.what == ph::event::repeated_sample) ++result.repeated;
    if (result.repeated == 0 && x != last) ++result.places_before;
    last = x;
  }
  return result;
}
constexpr ph::watched_loop_limits<> watched{.longest_tick = 1e-3};

/// To and fro, 50 mm a stroke.
double stroke(double speed, double t) {
  const double way = std::fmod(speed * t, 0.1);
  return way < 0.05 ? way : 0.1 - way;
}

}  // namespace

TEST_CASE("a sensor that is slower than the loop is reported within 20 fast motions",
          "[loop_limits][watch]") {
  for (const int slower : {2, 4}) {
    for (const double speed : {0.15, 0.3, 1.0}) {
      const auto place = [&](int n) { return stroke(speed, 1e-3 * (n - n % slower)); };
      const auto found = watch(watched, place, 2000);
      INFO(slower << " times slower, " << speed << " m/s");
      CHECK(found.repeated > 0);
      CHECK(found.places_before <= 20);
      const auto on_steps = [&](int n) { return std::floor(place(n) / step) * step; };
      CHECK(watch(watched, on_steps, 2000).places_before <= 20);
      // nobody looks where nobody is asked to
      CHECK(watch(thesis_loop, place, 2000).repeated == 0);
    }
  }
}

TEST_CASE("no device on encoder steps is taken for a slow sensor, however it is moved",
          "[loop_limits][watch]") {
  for (const double speed : {0.001, 0.003, 0.01, 0.03, 0.06, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0}) {
    const auto strokes = [&](int n) { return std::floor(stroke(speed, 1e-3 * n) / step) * step; };
    CHECK(watch(watched, strokes, 20000).repeated == 0);
    const auto swings = [&](int n) {  // its fastest is that speed
      return std::floor(0.02 * std::sin(speed / 0.02 * 1e-3 * n) / step) * step;
    };
    CHECK(watch(watched, swings, 20000).repeated == 0);
  }
}

TEST_CASE("a device at rest is not taken for a slow sensor", "[loop_limits][watch]") {
  CHECK(watch(
            watched, [](int) { return 0.01; }, 5000)
            .repeated == 0);
  const auto flickering = [](int n) { return n % 3 == 0 ? step : 0.0; };
  CHECK(watch(watched, flickering, 5000).repeated == 0);
  const auto moved_now_and_then = [](int n) {  // from rest to 1 m/s in 10 ms, and back to rest
    const double t = 1e-3 * (n % 200);
    return t < 0.02 ? 50 * t * t : 0.02;
  };
  CHECK(watch(watched, moved_now_and_then, 600).repeated == 0);
}

TEST_CASE("a repeated sample is news of the device, and the worst news wins",
          "[loop_limits][watch]") {
  ph::passive_port guard{d1{}, ph::given_force{}, thesis_ledger(), ph::strict_bound{}, watched};
  for (int n = 0; n < 100; ++n) (void)guard.tick(1e-3 * (n - n % 2) * 0.5, 1ms, 0.0);
  CHECK(guard.tick(0.05, 1ms, 0.0).what == ph::event::repeated_sample);
  (void)guard.tick(0.05, 1ms, 0.0);
  CHECK(guard.tick(0.051, 1ms, std::nan("")).what == ph::event::rejected_target);
  CHECK(guard.tick(std::nan(""), 1ms, 0.0).what == ph::event::rejected_sample);
  guard.reset();
  (void)guard.tick(0.0, 1ms, 0.0);
  (void)guard.tick(0.0, 1ms, 0.0);
  CHECK(guard.tick(0.001, 1ms, 0.0).what == ph::event::nominal);
}
