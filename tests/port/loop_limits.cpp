// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"

static_assert(ph::loop_limits::latency == 0 && !ph::loop_limits::traits.watched);
static_assert(ph::late_loop_limits<3>::latency == 3 && !ph::late_loop_limits<3>::traits.watched);
static_assert(ph::watched_loop_limits<>::traits.watched &&
              ph::watched_loop_limits<2>::latency == 2);
static_assert(ph::loop_limits{}.top_speed == 5.0);

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
