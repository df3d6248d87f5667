// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/reference.hpp"
#include "support/catch.hpp"
#include <passive_haptics/device/rigid_body.hpp>
#include <passive_haptics/simulation/quiet.hpp>

#include <array>
#include <cmath>
#include <type_traits>
#include <vector>

namespace sim = ph::simulation;
using namespace simulated;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double pi = 3.14159265358979;
constexpr std::array<double, 1> presses{1.0};

/// Half a second of a force [N] and a speed [m/s] on one axis, each a function of time.
sim::quiet_judge<line> judged(auto force, auto speed, const sim::quiet_bars& bars = {},
                              double dt = 1e-3) {
  sim::quiet_judge<line> judge(bars);
  for (int n = 0; n * dt < 0.5 - dt / 2; ++n) judge.add(force(n * dt), speed(n * dt), dt, presses);
  return judge;
}
double rest(double /*t*/) {
  return 0.0;
}
double hold(double /*t*/) {
  return 3.0;
}

}  // namespace

TEST_CASE("a device that holds still under a constant force is quiet from the start",
          "[simulation][quiet]") {
  const auto judge = judged(hold, rest);
  CHECK(judge.quiet());
  CHECK(judge.since() == 0.0);
  CHECK(judge.missed() == sim::quiet_bar::none);
  CHECK(judge.figures().force == 0.0);
  CHECK(judge.figures().step == 0.0);
  CHECK_THAT(judge.time(), WithinAbs(0.5, 1e-12));
  CHECK_FALSE(sim::quiet_judge<line>{}.quiet());  // nothing has been seen
}

TEST_CASE("q1: a force that rings above 10 Hz is not quiet, a slow one is", "[simulation][quiet]") {
  // 0.04 N at 40 Hz: 0.0283 N rms, of which a pass of 10 Hz leaves 0.97; its largest step is 0.010 N.
  const auto ringing =
      judged([](double t) { return 3.0 + 0.04 * std::sin(2 * pi * 40 * t); }, rest);
  CHECK_FALSE(ringing.quiet());
  CHECK(std::isnan(ringing.since()));
  CHECK(ringing.missed() == sim::quiet_bar::force);
  CHECK_THAT(ringing.figures().force, WithinAbs(0.0274, 0.001));
  CHECK(ringing.figures().step < 0.011);
  CHECK(judged([](double t) { return 3.0 + 0.02 * std::sin(2 * pi * 40 * t); }, rest).quiet());
  CHECK(judged([](double t) { return 3.0 + 0.2 * std::sin(2 * pi * 0.5 * t); }, rest).quiet());
}

TEST_CASE("q2: a device that creeps is not quiet", "[simulation][quiet]") {
  const auto creeping = judged(hold, [](double) { return 1.1e-3; });
  CHECK_FALSE(creeping.quiet());
  CHECK(creeping.missed() == sim::quiet_bar::motion);
  CHECK_THAT(creeping.figures().speed, WithinRel(1.1e-3, 1e-9));
  CHECK(judged(hold, [](double) { return 0.9e-3; }).quiet());
}

TEST_CASE("q3: a force that steps in one tick is not quiet", "[simulation][quiet]") {
  const auto step = [](double size) {
    return judged([size](double t) { return t < 0.4505 ? 3.0 : 3.0 + size; }, rest);
  };
  const auto stepping = step(0.021);
  CHECK_FALSE(stepping.quiet());
  CHECK(stepping.missed() == sim::quiet_bar::step);
  CHECK_THAT(stepping.figures().step, WithinAbs(0.021, 1e-12));
  CHECK(stepping.figures().force < 0.02);
  CHECK(step(0.019).quiet());
}

TEST_CASE("it is quiet since the end of the last window that was not, and news begin anew",
          "[simulation][quiet]") {
  sim::quiet_judge<line> judge;
  const auto hold_on = [&judge](int ticks, double speed) {
    for (int n = 0; n < ticks; ++n) judge.add(1.0, speed, 1e-3, presses);
  };
  hold_on(250, 0.01);  // creeps for 0.25 s
  hold_on(250, 0.0);
  CHECK_THAT(judge.since(), WithinAbs(0.3, 1e-12));
  hold_on(50, 0.0);
  judge.news();
  CHECK_FALSE(judge.quiet());  // not before a whole window
  hold_on(100, 0.01);
  hold_on(100, 0.0);
  CHECK_THAT(judge.since(), WithinAbs(0.65, 1e-12));
  CHECK_THAT(judge.settling(), WithinAbs(0.1, 1e-12));
  judge.news();
  hold_on(100, 0.0);
  CHECK(judge.settling() == 0.0);  // not before the news, however quiet it was
}

TEST_CASE("a swing along a free direction is not charged, one across a wall is",
          "[simulation][quiet]") {
  const auto swing = [](const room::vector& way, const std::vector<room::vector>& pressing) {
    sim::quiet_judge<room> judge;
    for (int n = 0; n < 500; ++n) {
      judge.add({0.0, 0.0, 2.0}, way * (0.1 * std::cos(0.01 * n)), 1e-3, pressing);
    }
    return judge;
  };
  const room::vector up(0.0, 0.0, 1.0), east(1.0, 0.0, 0.0);
  CHECK(swing(east, {up}).quiet());
  CHECK(swing(east, {}).quiet());
  CHECK_FALSE(swing(up, {up}).quiet());
  CHECK_FALSE(swing(east, {up, east}).quiet());
  CHECK_FALSE(swing(room::vector(east + up), {up}).quiet());
}

TEST_CASE("positions are judged as the speeds they have", "[simulation][quiet]") {
  sim::quiet_judge<room> seen, told;
  const std::array<room::vector, 1> floor{room::vector(0.0, 0.0, 1.0)};
  for (int n = 0; n < 200; ++n) {
    const room::vector v(0.0, 0.0, 2e-3);
    told.add({0.0, 0.0, 1.0}, v, 1e-3, floor);
    seen.add_at({0.0, 0.0, 1.0}, v * (1e-3 * n), 1e-3, floor);
  }
  CHECK_THAT(seen.figures().speed, WithinRel(told.figures().speed, 1e-9));
  CHECK_FALSE(seen.quiet());
}

TEST_CASE("a NaN is not quiet, wherever it is, until a window without one", "[simulation][quiet]") {
  for (const int where : {0, 1, 2, 3}) {
    sim::quiet_judge<line> judge;
    const auto tick = [&](bool spoilt) {
      const auto of = [&](int i, double x) { return spoilt && where == i ? not_a_number : x; };
      const std::array<double, 1> n{of(3, 1.0)};
      judge.add(of(0, 1.0), of(1, 0.0), of(2, 1e-3), n);
    };
    for (int n = 0; n < 200; ++n) tick(false);
    CHECK(judge.quiet());
    for (int n = 0; n < 100; ++n) tick(true);
    CAPTURE(where);
    CHECK_FALSE(judge.quiet());
    CHECK(judge.missed() == sim::quiet_bar::number);
    CHECK(std::isnan(judge.since()));
    for (int n = 0; n < 200; ++n) tick(false);
    CHECK(judge.quiet());
  }
  sim::quiet_judge<line> after;  // what comes after a NaN is no step from what was before it
  after.add(1.0, 0.0, 1e-3, presses);
  after.add(not_a_number, 0.0, 1e-3, presses);
  for (int n = 0; n < 100; ++n) after.add(5.0, 0.0, 1e-3, presses);
  CHECK(after.quiet());
  sim::quiet_bars bad;
  bad.force = not_a_number;
  CHECK(bad.check());
  CHECK_FALSE(sim::quiet_bars{}.check());
  CHECK_FALSE(judged(hold, rest, bad).quiet());
}

TEST_CASE("on encoders the bars rise to what a step of them does to a stiffness",
          "[simulation][quiet]") {
  const auto hunt = [](double t) { return 3.0 + (std::fmod(t + 1e-9, 0.02) < 0.01 ? 0.18 : 0.0); };
  const sim::quiet_bars bars;
  CHECK_FALSE(judged(hunt, rest, bars).quiet());
  CHECK(judged(hunt, rest, bars.on_encoders(60e-6, 3000.1, 0.1)).quiet());
  CHECK_FALSE(judged(hunt, rest, bars.on_encoders(60e-6, 2900.0, 0.1)).quiet());
  CHECK(bars.on_encoders(10e-6, 300.0, 0.1).step == bars.step);  // K q is below the bar
  CHECK_THAT(bars.on_encoders(60e-6, 3000.0, 0.1).force, WithinRel(0.09, 1e-9));
  CHECK(bars.on_encoders(10e-6, 300.0, 0.1).speed == bars.speed);
  CHECK_THAT(bars.on_encoders(60e-6, 1000.0, 0.1).speed, WithinRel(3e-3, 1e-9));
}

TEST_CASE("other bars hold from the window that is open on", "[simulation][quiet]") {
  auto judge = judged(hold, [](double /*t*/) { return 2e-3; });
  CHECK_FALSE(judge.quiet());
  CHECK(judge.bars().speed == 1e-3);
  judge.judge_by(sim::quiet_bars{}.on_encoders(60e-6, 1000.0, 0.1));
  CHECK(judge.bars().speed == 3e-3);
  CHECK_FALSE(judge.quiet());  // what is over is not judged again
  for (int n = 0; n < 100; ++n) judge.add(3.0, 2e-3, 1e-3, presses);
  CHECK(judge.quiet());
}

TEST_CASE("of a tool the torque counts by its lever, and what presses are rows",
          "[simulation][quiet]") {
  using body = ph::rigid_body<double>;
  const body::triple up(0.0, 0.0, 1.0), east(1.0, 0.0, 0.0), none(0.0, 0.0, 0.0);
  const body::triple arm(0.0, 0.1, 0.0);  // of the contact, from the handle
  const std::array<body::vector, 1> floor{body::join(up, ph::space<double, 3>::cross(arm, up))};
  const auto held = [&](const body::triple& torque_step, const body::triple& turning,
                        double lever) {
    sim::quiet_bars bars;
    bars.lever = lever;
    sim::quiet_judge<body> judge(bars);
    for (int n = 0; n < 100; ++n) {
      judge.add(body::join(up, body::triple(torque_step * (n == 50 ? 1.0 : 0.0))),
                body::join(none, turning), 1e-3, floor);
    }
    return judge;
  };
  CHECK(held(none, none, 0.03).quiet());
  CHECK(held(east * 1e-3, none, 0.1).quiet());  // 0.01 N
  CHECK(held(east * 1e-3, none, 0.03).missed() == sim::quiet_bar::step);
  // a turn about x lifts a contact at 0.1 m along y, one about the arm does not
  CHECK(held(none, east * 0.02, 0.03).missed() == sim::quiet_bar::motion);
  CHECK(held(none, body::triple(0.0, 1.0, 0.0), 0.03).quiet());
}

TEST_CASE("what is judged does not hang on the length of a tick", "[simulation][quiet]") {
  const auto ring = [](double t) { return 0.04 * std::sin(2 * pi * 40 * t); };
  const double fine = judged(ring, rest, {}, 1e-4).figures().force;
  CHECK_THAT(judged(ring, rest).figures().force, WithinRel(fine, 0.12));
  CHECK_THAT(judged(ring, rest, {}, 5e-4).figures().force, WithinRel(fine, 0.06));
  sim::quiet_judge<line> judge;
  for (int n = 0; n < 333; ++n) judge.add(1.0, 0.0, 3e-4, presses);  // 99.9 ms, nearest to a window
  CHECK(judge.quiet());
}
