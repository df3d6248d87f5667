// SPDX-License-Identifier: BSD-3-Clause
#include "force_bound/attacks.hpp"
#include "force_bound/upkeep.hpp"
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/base/samples.hpp>
#include <passive_haptics/contact/settled_force.hpp>
#include <passive_haptics/simulation/device.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace sim = ph::simulation;

namespace {

constexpr ph::settled_force rule{.mass = 0.1};
constexpr double B = 0.25 * 0.1 / 1e-3;  // of that rule at 1 kHz [N·s/m]
constexpr ph::given_force as_given{};
constexpr ph::settled_force no_slide = [] {
  ph::settled_force p = rule;
  p.slide_fraction = 0.0;
  return p;
}();

template <class Space, class Source, class Motion = ph::last_difference>
auto guard_of(const Source& source, const Motion& motion = {}) {
  return ph::passive_port{Space{}, source, ph::no_observer{}, ph::no_bound{}, thesis_loop, motion};
}

/// How fast a device of 0.1 kg without friction or hand still is, in the last tenth of a run, behind a
/// renderer that is `late` ticks late [m/s].
template <class Space, class Source, class Renderer>
double swings(const Source& source, const Renderer& renderer,
              const typename Space::coordinates& load, double seconds, std::size_t late = 0) {
  auto guard = guard_of<Space>(source);
  sim::device<Space> device{{.mass = 0.1, .damping = 0.0, .load = load}};
  auto sample = device.exchange(Space::zero());
  std::deque<typename Space::coordinates> rendered(late, renderer(sample.position));
  double fastest = 0.0;
  for (int n = 0; n < int(seconds * 1e3); ++n) {
    rendered.push_back(renderer(sample.position));
    const auto force = guard.tick(sample, rendered.front()).force;
    rendered.pop_front();
    sample = device.exchange(force);
    if (n > int(seconds * 900)) fastest = std::max(fastest, Space::norm(device.velocity()));
  }
  return fastest;
}

/// A renderer: a floor of K [N/m], which presses with `pressed` [N] at 0.
auto floor_of(double K, double pressed = 0.0) {
  return [K, pressed](double x) { return std::max(0.0, pressed - K * x); };
}
/// And one of two planes that meet in a trough along y, whose floor rises along it with `slope` [N/m].
auto trough_of(double K, double slope) {
  return [K, slope](const d3::vector& x) {
    d3::vector f(0.0, 0.0, 0.0);
    for (const double side : {-0.3, 0.3}) {
      const d3::vector n = d3::vector(side, 0.0, 1.0).normalized();
      if (const double depth = -n.dot(x); depth > 0.0) f += n * (K * depth);
    }
    if (f(2) > 0.0) f(1) = -slope * (x(1) - 0.02);
    return f;
  };
}

}  // namespace

TEST_CASE("a settled force is the given one at rest, and none in the air", "[settled_force]") {
  auto guard = guard_of<d3>(rule);
  for (int n = 0; n < 3; ++n) {
    CHECK(guard.tick({0, 0, 0}, 1ms, {1, 2, 3}).force == d3::vector(1, 2, 3));
  }
  CHECK(guard.tick({0, 0, 0}, 1ms, {1, 2, 2.5}).force == d3::vector(1, 2, 2.5));
  CHECK_FALSE(guard.tick({0, 0, 1e-4}, 1ms, {1, 2, 2.5}).force == d3::vector(1, 2, 2.5));
  CHECK(guard.tick({0.003, 0, 0}, 1ms, {0, 0, 0}).force == d3::zero());
}

TEST_CASE("along the force it is damped, but never pulls and never steps at the touch",
          "[settled_force]") {
  const auto out = [](double moved, double wanted) {
    auto guard = guard_of<d1>(rule);
    (void)guard.tick(0.0, 1ms, 0.0);
    return guard.tick(moved, 1ms, wanted).force;
  };
  CHECK_THAT(out(1e-5, 2.0), WithinAbs(2.0 - B * 0.01, 1e-12));
  CHECK_THAT(out(-1e-5, 2.0), WithinAbs(2.0 + B * 0.01, 1e-12));
  CHECK(out(1e-3, 2.0) == 0.0);
  CHECK_THAT(out(-1e-3, 2.0), WithinAbs(6.0, 1e-12));
  CHECK_THAT(out(-1e-3, 1e-6), WithinAbs(3e-6, 1e-15));
  CHECK_THAT(out(1e-5, -2.0), WithinAbs(-2.0 - B * 0.01, 1e-12));  // the other way round
}

TEST_CASE("what settled_force adds to a force only brakes", "[settled_force]") {
  ph::laws::samples random(7);
  auto guard = guard_of<d3>(rule);
  d3::vector x = d3::zero(), w = d3::zero();
  double most = 0.0, least = 0.0;
  for (int n = 0; n < 20000; ++n) {
    const d3::vector travel = random.vector<d3>() * 2e-4;
    w = n % 50 == 0 ? d3::vector(random.vector<d3>() * 3.0)
                    : d3::vector(w + random.vector<d3>() * 0.1);
    if (n % 331 == 0) w = d3::zero();
    x += travel;
    const d3::vector added = guard.tick(x, 1ms, w).force - w;
    if (n == 0) continue;
    most = std::max(most, added.dot(travel));
    least = std::min(least, added.dot(travel));
    REQUIRE(added.norm() <= (std::sqrt(5.0) + 1e-9) * w.norm());
  }
  CHECK(most < 1e-15);   // [J]
  CHECK(least < -1e-4);  // and it does
}

TEST_CASE("a renderer that rings behind a given_force rests behind a settled_force",
          "[settled_force]") {
  for (const double K : {300.0, 2000.0, 8000.0}) {
    CAPTURE(K);
    CHECK(swings<d1>(rule, floor_of(K), -1.0, 1.0) < 1e-4);
    CHECK(swings<d1>(as_given, floor_of(K), -1.0, 1.0) > 0.05);
  }
  const d3::coordinates down(0.3, 0.0, -1.0);
  CHECK(swings<d3>(rule, trough_of(2000.0, 20.0), down, 4.0) < 1e-3);
  CHECK(swings<d3>(as_given, trough_of(2000.0, 20.0), down, 4.0) > 0.05);
}

TEST_CASE("most_stiffness settles however late the renderer is, and four times that does not",
          "[settled_force]") {
  for (const double fraction : {0.1, 0.25, 0.5}) {
    for (const int late : {0, 1, 3, 10}) {
      ph::settled_force p = rule;
      p.damping_fraction = fraction;
      CAPTURE(fraction, late);
      const double K = p.most_stiffness(1e-3, late);
      CHECK_THAT(K, WithinRel(fraction * 0.1 * 1e6 / (late + 1.5), 1e-12));
      CHECK(swings<d1>(p, floor_of(K, 5.0), -5.1, 2.0, std::size_t(late)) < 1e-4);
      p.softens = false;
      CHECK(swings<d1>(p, floor_of(4.0 * K, 5.0), -5.1, 2.0, std::size_t(late)) > 1e-2);
    }
  }
}

TEST_CASE("a late loop is as late as its renderer, and the more often softer", "[settled_force]") {
  CHECK_THAT(rule.most_stiffness(1e-3, 1, 2), WithinRel(rule.most_stiffness(1e-3, 3) / 3.0, 1e-12));
  CHECK(rule.settles(1.0, 1e-3));
  CHECK_FALSE(rule.settles(0.0, 1e-3));
  ph::settled_force p = rule;
  p.lead = 3.5;
  CHECK(p.settles(1.0, 1e-3, 1, 1));
  CHECK_FALSE(p.settles(1.0, 1e-3, 2, 1));
  CHECK_FALSE(p.settles(1.0, 1e-3, 1, 2));
  CHECK(p.settles(p.most_stiffness(1e-3, 0, 2), 1e-3, 0, 2));
}

TEST_CASE("what is steeper than it settles with is felt softer, and rests", "[settled_force]") {
  ph::settled_force as_steep = rule;
  as_steep.softens = false;
  const double most = rule.most_stiffness(1e-3);
  for (const double times : {1.5, 3.0, 10.0}) {
    CAPTURE(times);
    CHECK(swings<d1>(rule, floor_of(times * most), -1.0, 1.0) < 1e-4);
    CHECK(swings<d1>(as_steep, floor_of(3.0 * times * most), -1.0, 1.0) > 0.02);  // the control
    CHECK(swings<d3>(rule, trough_of(times * most, 600.0), {0.3, 0.0, -1.0}, 4.0) < 1e-3);
  }
}

TEST_CASE("a settled force says how much of a steep one it shows, and shows all of any other",
          "[settled_force]") {
  const double most = rule.most_stiffness(1e-3);
  auto guard = guard_of<d1>(rule);
  int tick = 0;
  // For a second: swings by 0.2 mm about where it presses with 30 N, 8 times a second, under that slope.
  const auto swing = [&](double K) {
    for (int n = 0; n < 1000; ++n) {
      const double way = 2e-4 * std::sin(0.05 * ++tick);
      (void)guard.tick(way, 1ms, 30.0 - K * way);
    }
    return double(guard.source().shown());
  };
  CHECK(swing(0.99 * most) == 1.0);
  CHECK_THAT(swing(4.0 * most), WithinRel(0.75 / 4.0, 0.03));
  CHECK_THAT(swing(2.0 * most), WithinRel(0.75 / 4.0, 0.03));  // half as steep: as it was
  for (int n = 0; n < 3; ++n) swing(0.1 * most);
  CHECK(guard.source().shown() == 1.0);
  (void)swing(4.0 * most);
  guard.reset();
  CHECK(guard.source().shown() == 1.0);
  for (int n = 0; n < 50; ++n) (void)guard.tick(-1e-5 * n, 1ms, 4.0 * most * 1e-5 * n);
  CHECK_THAT(guard.explain().shown, WithinRel(4.0 * most, 1e-6));  // pressed steadily: as given
  CHECK(guard.explain().stiffness == ph::softened_by::nothing);
  (void)swing(4.0 * most);
  CHECK_THAT(guard.explain().shown, WithinRel(0.75 * most, 1e-6));
  CHECK(guard.explain().stiffness == ph::softened_by::mass_and_tick);
  guard.reset();
  ph::settled_force on_steps = rule;
  on_steps.most = most;  // on encoders, where a press is a row of jumps, the slope alone counts
  auto stepped = guard_of<d1>(on_steps);
  for (int n = 0; n < 50; ++n) (void)stepped.tick(-1e-5 * n, 1ms, 4.0 * most * 1e-5 * n);
  CHECK_THAT(double(stepped.source().shown()), WithinRel(0.75 / 4.0, 0.03));

  ph::laws::samples random(3);
  double x = 0.0;
  for (int n = 0; n < 5000; ++n) {  // news to a device that holds still, and one that they push
    const double w = 2.0 + random.number<double>();
    x += 1e-5 * (w - 2.0) * (n % 100 < 50 ? 0.0 : 1.0);
    (void)guard.tick(x, 1ms, w);
    CHECK(guard.explain().shown <= most * (1.0 + 1e-12));  // what is no slope is not said to be one
  }
  CHECK(guard.source().shown() == 1.0);
}

TEST_CASE("a renderer that is told to be slow is shown as soft as settles with so old a force",
          "[settled_force]") {
  const double most = rule.most_stiffness(1e-3);
  const auto shown = [&](double K, int ticks, bool told) {
    ph::settled_force slow = rule;
    if (told) slow.renderer_period = ticks * 1e-3;
    auto guard = guard_of<d1>(slow);
    double w = 2.0;
    for (int n = 0; n < 2000; ++n) {
      const double x = 1e-4 * std::sin(0.03 * n);
      if (n % ticks == 0) w = 2.0 - K * x;
      (void)guard.tick(x, 1ms, w);
    }
    return double(guard.source().shown()) * K;
  };
  CHECK(shown(0.5 * most, 1, true) == 0.5 * most);
  for (const int ticks : {4, 10, 33}) {
    CAPTURE(ticks);
    const double settles = rule.most_stiffness(1e-3, ticks);
    CHECK(shown(0.5 * most, ticks, true) < settles);
    CHECK(shown(0.5 * most, ticks, true) > 0.4 * settles);
    CHECK(shown(0.1 * settles, ticks, true) == 0.1 * settles);
    if (ticks == 4) CHECK(shown(0.1 * most, ticks, false) == 0.1 * most);
  }
}

TEST_CASE("a sphere that is rendered 30 times a second rests behind a guard that is told so",
          "[settled_force]") {
  constexpr double mass = 0.1, period = 33e-3;
  const auto last_step = [&](double told) {
    auto guard =
        ph::make_guard<d3>({.mass = mass, .damping = 0.1, .force_limit = 9.0, .longest_tick = 1e-3},
                           {.force = 5.0}, told);
    REQUIRE_FALSE(guard.check());
    ph::simulation::device<d3, ph::simulation::impedance_hand<d3>> device(
        {.mass = mass, .damping = 0.1, .start = {0.004, 0.003, 0.06}},
        {.stiffness = 300.0, .damping = 0.5, .target = {0.004, 0.003, 0.035}});
    auto sample = device.exchange(d3::zero());
    d3::vector w = d3::zero(), last = d3::zero();
    double step = 0.0;
    for (int n = 0; n < 4000; ++n) {
      const d3::vector x = sample.position;
      const double deep = 0.05 - x.norm();
      if (n % 33 == 0) w = deep > 0.0 ? d3::vector(2000.0 * deep * x.normalized()) : d3::zero();
      const d3::vector force = guard.tick(sample, w).force;
      if (n > 1000) step = std::max(step, (force - last).norm());
      last = force;
      sample = device.exchange(force);
    }
    CHECK(device.meter().minimum() >= -1e-12);
    return step;
  };
  CHECK(last_step(period) < 0.02);
  CHECK(last_step(0.0) > 1.0);
}

TEST_CASE("what is steeper across the force than along it is shown by what is across",
          "[settled_force]") {
  const double most = rule.most_stiffness(1e-3);
  const auto shown = [&](double along, double across) {
    auto guard = guard_of<d3>(rule);
    for (int n = 0; n < 2000; ++n) {
      const d3::vector x(1e-5 * std::sin(0.31 * n), 0.0, 1e-5 * std::sin(0.2 * n));
      (void)guard.tick(x, 1ms, {-across * x(0), 0.0, 9.0 - along * x(2)});
    }
    return double(guard.source().shown());
  };
  CHECK_THAT(shown(2.0 * most, 0.0), WithinRel(0.75 / 2.0, 0.1));
  CHECK_THAT(shown(2.0 * most, 8.0 * most), WithinRel(0.75 / 8.0, 0.1));
}

TEST_CASE("a slide brakes what swings along a trough, and its lead what is stiff there",
          "[settled_force]") {
  const d3::coordinates down(0.0, 0.0, -1.0);
  ph::settled_force no_lead = rule;
  no_lead.lead = no_lead.slide_fraction = 0.0;
  CHECK(swings<d3>(rule, trough_of(2000.0, 5.0), down, 4.0) < 0.01);
  CHECK(swings<d3>(no_slide, trough_of(2000.0, 5.0), down, 4.0) > 0.02);
  CHECK(swings<d3>(no_slide, trough_of(2000.0, 300.0), down, 4.0) < 1e-3);
  CHECK(swings<d3>(no_lead, trough_of(2000.0, 300.0), down, 4.0) > 0.02);
}

TEST_CASE("a force that is the same everywhere is not braked, and a spring as its slope asks for",
          "[settled_force]") {
  const auto brakes = [](double slope, double aside, int ticks) {  // at 0.1 m/s and 1 N
    auto guard = guard_of<d3>(rule);
    (void)guard.tick({0, 0, 0}, 1ms, {0, 0, 1});
    double added = 0.0;
    for (int n = 1; n <= ticks; ++n) {
      const double x = 1e-4 * n;
      const d3::vector way(aside * x, 0.0, (1.0 - aside) * x), w(0, 0, 1.0 - slope * x);
      added = (guard.tick(way, 1ms, w).force - w).norm();
    }
    return added;
  };
  CHECK_THAT(brakes(0.0, 0.0, 1), WithinAbs(1.0, 1e-12));  // at first it may be a wall
  CHECK(brakes(0.0, 0.0, 1000) < 0.001);
  CHECK_THAT(brakes(0.0, 1.0, 1000), WithinAbs(0.02, 1e-6));
  const double asked = 0.1 * 0.05 * 5.0;  // [N]
  CHECK(brakes(5.0, 0.0, 1000) >= asked);
  CHECK(brakes(5.0, 0.0, 1000) <= 2.0 * asked);
}

TEST_CASE("a tick that comes half a second late leaves no damper, and none that pushes",
          "[settled_force]") {
  auto guard = guard_of<d1>(rule);
  (void)guard.tick(0.0, 1ms, 1.0);
  (void)guard.tick(0.01, 500ms, 1.0);
  CHECK(guard.tick(0.0101, 1ms, 1.0).force == 1.0);
  CHECK(guard.tick(0.0102, 1ms, 0.9).force < 0.9);  // the control: a slope
}

TEST_CASE("a slow loop is damped as its longest tick asks for", "[settled_force]") {
  const auto brakes = [](double T) {  // a spring of 10 N/m at 0.1 m/s
    ph::passive_port guard{d1{}, rule, ph::no_observer{}, ph::no_bound{},
                           ph::loop_limits{.longest_tick = T}};
    double added = 0.0;
    for (int n = 0; n < 1000; ++n) {
      const double x = 0.1 * T * n, w = 50.0 - 10.0 * x;
      added = w - guard.tick(x, ph::seconds{T}, w).force;
    }
    return added / 0.1;  // [N·s/m]
  };
  CHECK(brakes(1e-3) >= 10.0 * 0.05);
  CHECK(brakes(1e-3) <= 10.0 * 0.1);
  CHECK(brakes(4e-3) >= 10.0 * 50.0 * 4e-3);
  CHECK(brakes(4e-3) <= 10.0 * 100.0 * 4e-3);
}

TEST_CASE("a stroke along a flat wall costs 0.02 N at most, whatever the mass", "[settled_force]") {
  for (const double mass : {0.1, 0.5, 3.0}) {
    ph::settled_force heavy = rule;
    heavy.mass = mass;
    auto guard = guard_of<d3>(heavy);
    double most = 0.0, rough = 0.0;
    for (int n = 0; n < 2000; ++n) {
      const double x = 0.02 * std::sin(5e-3 * n);
      const double rubs = n < 1000 ? 0.0 : -200.0 * x;  // the control: what has a slope there
      const double f = guard.tick({x, 0.0, -1e-3}, 1ms, {rubs, 0.0, 9.0}).force(0) - rubs;
      (n < 1000 ? most : rough) = std::max(n < 1000 ? most : rough, std::abs(f));
    }
    CAPTURE(mass);
    CHECK(most < 0.0201);
    CHECK(rough > 0.9 * 0.1 * 2.0 * mass);
  }
}

TEST_CASE("where a facet ends the damper turns smoothly", "[settled_force]") {
  const auto step = [](const ph::settled_force& p) {  // 0.1 m/s over an edge of 15 degrees
    auto guard = guard_of<d3>(p);
    d3::vector x = d3::zero(), last = d3::zero();
    const d3::vector before(0.0, 0.0, 2.0), after(2.0 * std::sin(0.26), 0.0, 2.0 * std::cos(0.26));
    double largest = 0.0;
    for (int n = 0; n < 200; ++n) {
      x(0) += 1e-4;
      const d3::vector f = guard.tick(x, 1ms, n < 100 ? before : after).force;
      if (n > 10) largest = std::max(largest, (f - last).norm());
      last = f;
    }
    return largest / (after - before).norm();
  };
  ph::settled_force at_once = rule;
  at_once.turn_time = 0.0;
  CHECK(step(rule) < 1.1);
  CHECK(step(at_once) > 1.3);
}

TEST_CASE("what the motors cannot hold lets a device out at a speed that it can be stopped from",
          "[settled_force]") {
  ph::settled_force limited = rule;
  limited.force_limit = 2.0;
  const auto out = [&](double moved, double wanted) {
    auto guard = guard_of<d1>(limited);
    (void)guard.tick(0.0, 1ms, 0.0);
    return guard.tick(moved, 1ms, wanted).force;
  };
  CHECK(out(0.0, 18.0) == 2.0);
  CHECK_THAT(out(1e-5, 2.0), WithinAbs(2.0 - B * 0.01, 1e-12));
  CHECK_THAT(out(1e-5, 18.0), WithinAbs(2.0 - B / 3.0 * 0.01, 1e-12));
  CHECK_THAT(out(-1e-5, -18.0), WithinAbs(B / 3.0 * 0.01 - 2.0, 1e-12));
}

TEST_CASE("a late loop is damped less, and rests", "[settled_force]") {
  ph::passive_port late{d1{}, rule, ph::no_observer{}, ph::no_bound{},
                        ph::late_loop_limits<1>{.longest_tick = 1e-3}};
  (void)late.tick(0.0, 1ms, 0.0);
  CHECK_THAT(late.tick(1e-5, 1ms, 2.0).force, WithinAbs(2.0 - B / 2.0 * 0.01, 1e-12));
  static_assert(rule.most_stiffness(1e-3, 2, 1) == rule.most_stiffness(1e-3, 3) / 2.0);
}

TEST_CASE("the damper is that of the longest tick, as the port knows it", "[settled_force]") {
  ph::passive_port port{d1{}, rule, ph::no_observer{}, ph::no_bound{},
                        ph::loop_limits{.longest_tick = 2e-3}};
  const auto brake = [&](double from) {
    (void)port.tick(from, 1ms, 0.0);
    (void)port.tick(from, 1ms, 2.0);
    return 2.0 - port.tick(from + 1e-5, 1ms, 2.0).force;
  };
  CHECK_THAT(brake(0.0), WithinAbs(B / 2.0 * 0.01, 1e-12));
  REQUIRE_FALSE(port.set(ph::loop_limits{.longest_tick = 1e-3}));
  CHECK_THAT(brake(1e-4), WithinAbs(B * 0.01, 1e-12));
  ph::settled_force half = rule;
  half.damping_fraction /= 2.0;
  REQUIRE_FALSE(port.set(half));
  CHECK_THAT(brake(2e-4), WithinAbs(B / 2.0 * 0.01, 1e-12));
}

TEST_CASE("the speed is the motion estimator's", "[settled_force]") {
  const auto step = [](auto motion) {  // pressed at rest, between two steps of an encoder
    auto guard = guard_of<d1>(rule, motion);
    double last = 2.0, largest = 0.0;
    for (int n = 0; n < 400; ++n) {
      const double f = guard.tick(n % 40 < 20 ? 0.0 : 6e-5, 1ms, 2.0).force;
      if (n > 100) largest = std::max(largest, std::abs(f - last));
      last = f;
    }
    return largest;
  };
  CHECK(step(ph::last_difference{}) > 1.4);
  CHECK(step(ph::mass_observer{.mass = 0.1, .quantum = 6e-5}) < 0.5);
}

TEST_CASE("a settled force fades, is refused and is forgotten as a given one", "[settled_force]") {
  auto guard = guard_of<d1>(rule);
  CHECK(guard.tick(0.0, 1ms).what == ph::event::no_target);
  (void)guard.tick(0.0, 1ms, 3.0);
  CHECK(guard.tick(0.0, 1ms, std::nan("")).force == 3.0);
  for (int n = 0; n < 125; ++n) (void)guard.tick(0.0, 1ms);
  const auto fading = guard.tick(0.0, 1ms);
  CHECK(fading.what == ph::event::stale_target);
  CHECK_THAT(fading.force, WithinAbs(1.4, 0.1));
  guard.reset();
  CHECK(guard.tick(0.0, 1ms).what == ph::event::no_target);
}

TEST_CASE("a direction is forgotten in the air and where the force has turned round",
          "[settled_force]") {
  const auto brake_along = [](const d3::vector& first, int ticks_of_air) {
    auto guard = guard_of<d3>(rule);
    (void)guard.tick({0, 0, 0}, 1ms, first);
    for (int n = 0; n < ticks_of_air; ++n) (void)guard.tick({0, 0, 0}, 1ms, {0, 0, 0});
    return 2.0 - guard.tick({0, 0, 1e-5}, 1ms, {0, 0, 2}).force(2);
  };
  CHECK_THAT(brake_along({0, 0, 2}, 0), WithinAbs(B * 0.01, 1e-9));
  CHECK_THAT(brake_along({2, 0, 0.1}, 1), WithinAbs(B * 0.01, 1e-9));
  CHECK_THAT(brake_along({2, 0, -0.1}, 0), WithinAbs(B * 0.01, 1e-9));
  CHECK_THAT(brake_along({2, 0, 0}, 0), WithinAbs(B * 0.01, 1e-9));  // by a right angle
  CHECK(brake_along({2, 0, 0.1}, 0) < 0.5 * B * 0.01);               // the control: it is kept
}

TEST_CASE("a lead brakes no more than the damper of its speed, and is none where it would push",
          "[settled_force]") {
  const auto added = [](double moved, double change) {  // across the force
    auto guard = guard_of<d3>(no_slide);
    (void)guard.tick({0, 0, 0}, 1ms, {0, 0, 2});
    return guard.tick({moved, 0, 0}, 1ms, {change, 0, 2}).force(0) - change;
  };
  CHECK_THAT(added(1e-4, -1e-3), WithinAbs(-5e-3, 1e-4));     // 5 ticks of it
  CHECK_THAT(added(1e-6, -0.1), WithinAbs(-B * 1e-3, 1e-3));  // B times the speed
  CHECK_THAT(added(0.0, -0.1), WithinAbs(0.0, 1e-12));        // at rest it is what is given
  CHECK_THAT(added(1e-6, 0.1), WithinAbs(0.0, 2e-3));         // it would push
}

TEST_CASE("a reset forgets the force and its direction", "[settled_force]") {
  const auto next = [](bool tilted_first) {
    auto guard = guard_of<d3>(rule);
    if (tilted_first) (void)guard.tick({0, 0, 0}, 1ms, {1.5, 0.0, 0.5});
    guard.reset();
    (void)guard.tick({0, 0, 0}, 1ms, {0, 0, 2});
    return d3::vector(guard.tick({1e-5, 0, 1e-5}, 1ms, {0, 0, 2}).force);
  };
  CHECK(next(true) == next(false));
}

TEST_CASE("an absurd force goes out as it is, and the next one is damped again",
          "[settled_force]") {
  auto guard = guard_of<f3>(rule);
  for (const float absurd : {3e38F, 1e-44F}) {
    (void)guard.tick({0, 0, 0}, 1ms, {1, 0, 0});
    CHECK(f3::is_finite(guard.tick({1e-5F, 1e-5F, 0}, 1ms, {absurd, absurd, -absurd}).force));
    (void)guard.tick({1e-5F, 1e-5F, 0}, 1ms, {0, 0, 2});
    const auto f = guard.tick({1e-5F, 1e-5F, 1e-5F}, 1ms, {0, 0, 2}).force;
    CHECK_THAT(double(f(2)), WithinAbs(2.0 - B * 0.01, 1e-3));
  }
}

TEST_CASE("a force whose square is no number goes out as it is, and the next one as after none",
          "[settled_force]") {
  auto line = guard_of<d1>(rule);
  (void)line.tick(0.0, 1ms, 2.0);
  CHECK(line.tick(1e-5, 1ms, 1e-170).force == 1e-170);
  const auto next = [](double tiny) {
    auto guard = guard_of<d3>(rule);
    (void)guard.tick({0, 0, 0}, 1ms, {1, 1, 1});
    (void)guard.tick({0, 0, 0}, 1ms, {tiny, tiny, tiny});
    return d3::vector(guard.tick({1e-5, 1e-5, 2e-5}, 1ms, {1, 1, 2}).force);
  };
  CHECK(next(1e-170) == next(0.0));
  CHECK_FALSE(next(1e-150) == next(0.0));  // the control: its direction is one
}

TEST_CASE("an absurd force is no reason to show a steep one as it is", "[settled_force]") {
  for (const float absurd : {1.0F, 3e38F, -3e38F}) {
    auto guard = guard_of<ph::space<float, 1>>(rule);
    const double K = 4.0 * rule.most_stiffness(1e-3);
    for (int n = 0; n < 500; ++n) {
      const float x = float(2e-4 * std::sin(0.05 * n));
      (void)guard.tick(x, 1ms, n == 5 ? absurd : 20.0F - float(K) * x);
    }
    CAPTURE(absurd);
    CHECK_THAT(double(guard.source().shown()), WithinRel(0.75 / 4.0, 0.05));
  }
}

TEST_CASE("a given force that fades is not taken for a steep one", "[settled_force]") {
  const auto shown = [](bool told) {  // 5 N that are gone after 0.15 s, or are told to go so
    auto guard = guard_of<d1>(rule);
    double x = 0.0, t = 0.0;
    (void)guard.tick(x, 1ms, 5.0);
    for (int n = 1; n < 200; ++n) {
      const double dt = n % 2 == 0 ? 0.5e-3 : 1.5e-3;
      x += 2e-3 * dt;
      t += dt;
      if (told) {
        (void)guard.tick(x, ph::seconds{dt}, std::clamp(100.0 * (0.15 - t), 0.0, 5.0));
      } else {
        (void)guard.tick(x, ph::seconds{dt});
      }
    }
    CHECK(guard.tick(x, 1ms).force == 0.0);
    return double(guard.source().shown());
  };
  CHECK(shown(false) == 1.0);
  CHECK(shown(true) < 0.5);
}

TEST_CASE("after an absurd force three ticks are too few again", "[settled_force]") {
  const double most = rule.most_stiffness(1e-3), step = 1e-5;
  for (const double absurd : {1e200, -1e200}) {
    auto guard = guard_of<d1>(rule);
    double x = 0.0, w = 100.0;
    int tick = 0;
    const auto next = [&](double K) {
      const double way = ++tick % 2 == 0 ? step : 3.0 * step;
      x -= way;
      w += K * way;
      (void)guard.tick(x, 1ms, w);
      return double(guard.source().shown());
    };
    for (int n = 0; n < 200; ++n) (void)next(1.5 * most);
    CHECK_THAT(guard.source().shown(), WithinRel(0.75 / 1.5, 1e-3));
    x -= step;
    (void)guard.tick(x, 1ms, absurd);
    const double before = next(16.0 * most);  // the change from it is absurd as well
    for (int n = 0; n < 3; ++n) CHECK(next(16.0 * most) == before);
    CHECK(next(16.0 * most) < 0.1);
  }
}

TEST_CASE("a settled force that looks at a steep one forgets at a reset that it did",
          "[settled_force]") {
  const double K = 8.0 * rule.most_stiffness(1e-3);
  const auto touched = [&](auto& guard) {  // from the air onto a steep floor
    std::vector<double> shown;
    for (int n = 0; n < 12; ++n) {
      const double x = 1e-5 * (3 - n) + (n % 2 == 0 ? 0.0 : 5e-6);
      (void)guard.tick(x, 1ms, std::max(0.0, -K * x));
      shown.push_back(double(guard.source().shown()));
    }
    return shown;
  };
  auto fresh = guard_of<d1>(rule), worn = guard_of<d1>(rule);
  const auto as_new = touched(fresh);
  CHECK(as_new.front() == 1.0);
  CHECK(as_new.back() < 0.2);
  for (int n = 0; n < 3; ++n) {
    CHECK(touched(worn) == as_new);
    worn.reset();
  }
}

TEST_CASE("what a settled force may not be told is refused with its name", "[settled_force]") {
  const auto refused = [](auto change) {
    ph::settled_force p = rule;
    change(p);
    const auto fault = p.check();
    return std::string(fault ? fault.parameter : "");
  };
  CHECK(refused([](auto&) {}).empty());
  CHECK(std::string(ph::settled_force{}.check().parameter) == "mass");
  const double nan = std::nan("");
  for (const double bad : {0.0, -0.1, 0.51, nan}) {
    CHECK(refused([&](auto& p) { p.damping_fraction = bad; }) == "damping_fraction");
  }
  for (const double bad : {-1.0, 10.1, nan}) {
    CHECK(refused([&](auto& p) { p.lead = bad; }) == "lead");
    CHECK(refused([&](auto& p) { p.slide_fraction = bad; }) == "slide_fraction");
  }
  CHECK(refused([&](auto& p) { p.turn_time = -1e-3; }) == "turn_time");
  CHECK(refused([&](auto& p) { p.force_limit = 0.0; }) == "force_limit");
  CHECK(refused([&](auto& p) { p.fade = 0.0; }) == "fade");
  CHECK(refused([&](auto& p) {
          p.damping_fraction = 0.5, p.lead = 0, p.slide_fraction = 0;
        }).empty());
  CHECK(refused([](auto& p) { p.lead = 10, p.slide_fraction = 0.1; }).empty());
}

namespace {

/// A motion estimator that takes a device for faster than it is, so that a source has to look at the way itself.
struct faster {
  [[nodiscard]] constexpr ph::parameter_fault check() const noexcept { return {}; }
  template <class P>
  struct on {
    struct seen {
      typename P::vector position, velocity;
      [[nodiscard]] double along(const typename P::vector& n) const noexcept {
        return P::dot(velocity, n);
      }
    };
    constexpr explicit on(const faster& /*p*/) noexcept {}
    [[nodiscard]] seen estimate(const typename P::vector& x, const typename P::vector& way,
                                const typename P::vector& /*held*/, double dt,
                                bool /*known*/) const noexcept {
      return {x, way * (8.0 / dt)};
    }
  };
};

/// settled_force a second time, from mathematics.md § 10: the stiffness from all ticks anew, each along the force and
/// across it, with weights that fall with a time constant of 30 ms; and every part of f for itself.
template <int N>
struct plainly {
  using vector = Eigen::Matrix<double, N, 1>;
  struct tick {
    std::array<double, 2> work, way, change;  // along w, and across it
    double moved, keep, out, rise;            // Δx and Δw along w
  };
  ph::settled_force p;
  double T;
  int late;
  bool knows_speed;
  std::vector<tick> seen{};
  vector rendered = vector::Zero(), last = vector::Zero(), n = vector::Zero();
  double braked = 1e9, slid = 0.0;  // t times the slopes along n and across it
  bool begun = false, steep = false;
  int watched = 0;  // ticks of motion that are still to be looked at
  double shown = 1.0;

  [[nodiscard]] double most() const { return std::min(p.most_stiffness(T, 0, late), p.most); }
  [[nodiscard]] double share(std::size_t k) const {  // K_m over the slope, 100 for what is none
    double work = 0.0, moved = 0.0, changed = 0.0, weight = 1.0;
    double out = 0.0, rise = 0.0, ticks = 0.0;
    for (std::size_t i = seen.size(); i-- > 0;) {
      const tick& t = seen[i];
      work -= weight * t.work[k];
      moved += weight * (t.way[k] + 1e-4 * t.moved);
      changed += weight * t.change[k];
      out += weight * t.out;
      rise += weight * t.rise;
      ticks += weight;
      weight *= t.keep;
    }
    const double s = share(work, moved, changed);
    if (k == 1) return s;
    const double varies = std::max(0.9999 * moved - out * out / ticks, 1e-5 * moved);
    return std::max(s, share(work + out * rise / ticks, varies, changed - rise * rise / ticks));
  }
  [[nodiscard]] double share(double work, double moved, double changed) const {
    const double correlation = work * work / (moved * changed), slope = work / moved;
    const double rest = moved * changed * (1.0 - correlation);
    const bool sure = correlation > 0.25 && rest <= 8.0 * std::pow(work - most() * moved, 2);
    return sure && slope > most() / 100.0 ? most() / slope : 100.0;
  }
  void forget() {
    seen.clear();
    begun = steep = false;
    watched = 0;
    shown = 1.0;
  }
  void reset() {
    forget();
    rendered = last = n = vector::Zero();
    braked = 1e9, slid = 0.0;
  }
  /// What of a damper is in use where w falls by `fall` [N/s] per m/s of the speed v, and what is left for later.
  [[nodiscard]] double felt(double& damper, double fall, double v, double dt, double share) const {
    const double whole = p.damping_fraction * p.mass / (T * (1 + late));
    damper = std::min(damper, whole);
    const double t = std::max({0.05, 50.0 * T, 4.0 * p.mass / whole});
    const double asked = t * fall / dt, used = damper;
    if (v == 0.0) return used;
    if (asked > damper) return damper += (std::min(asked, whole) - damper) / 5.0;
    if (2.0 * asked < damper && v > 1e-3 && share == 1.0) damper *= 1.0 - std::min(10.0 * dt, 1.0);
    return used;
  }
  void look(const vector& w, const vector& way, double dt) {
    const vector change = w - rendered;
    rendered = w;
    if (!std::exchange(begun, true) || way.norm() <= 1e-3 * dt || w.norm() == 0.0) return;
    const vector along = w / w.norm(), way_across = way - along * way.dot(along);
    const vector change_across = change - along * change.dot(along);
    seen.push_back({{way.dot(along) * change.dot(along), way_across.dot(change_across)},
                    {std::pow(way.dot(along), 2), way_across.squaredNorm()},
                    {std::pow(change.dot(along), 2), change_across.squaredNorm()},
                    way.squaredNorm(),
                    0.03 / (0.03 + dt),
                    way.dot(along),
                    change.dot(along)});
    steep = steep || -change.dot(way) > most() * way.squaredNorm();
    double ticks = 0.0, weight = 1.0;
    for (std::size_t i = seen.size(); i-- > 0; weight *= seen[i].keep) ticks += weight;
    const double s = steep && ticks > 3.0 ? std::min(share(0), share(1)) : 1.0;
    if (s < shown) {
      shown = 0.75 * s;
    } else if (s > 8.0 / 3.0 * shown) {
      shown = std::min(shown * (1.0 + dt), 1.0);
    }
    if (shown == 1.0 && --watched == 0) forget();
  }
  static double limited(double x, double least, double most) {
    return std::max(least, std::min(x, most));
  }
  vector force(const vector& wanted, const vector& way, const vector& v, double dt) {
    if (watched > 0) look(wanted, way, dt);
    const double size = shown * wanted.norm(), share = std::min(1.0, p.force_limit / size);
    const vector w = wanted * shown * (size > 0.0 ? share : 1.0), change = w - last;
    last = w;
    const bool looks = p.softens;
    if (looks && -change.dot(way) > most() * way.squaredNorm()) watched = 30;
    if (w.norm() == 0.0) {
      n.setZero();
      braked = 1e9, slid = 0.0;
      return w;
    }
    const vector now = w / w.norm();
    const double a = dt / (p.turn_time + dt);
    n = n.dot(now) > 0.0 ? vector((1.0 - a) * n + a * now).normalized() : now;
    const double along = n.dot(w), speed = n.dot(v), rise = n.dot(change);
    const double unit = p.mass / (T * (1 + late)) * std::sqrt(share);
    const double damps = p.damping_fraction * unit;
    const vector v_across = v - n * speed, w_across = change - n * rise;
    const double aside = v_across.norm();
    const double braking =
        felt(braked, speed == 0.0 ? 0.0 : -rise / speed, std::abs(speed), dt, share);
    const double falls = aside == 0.0 ? 0.0 : -w_across.dot(v_across) / (aside * aside);
    const double slides = p.slide_fraction * unit;
    const double slow = std::max(aside, 1e-3);
    const double most = std::max(slides, std::min(10.0 * slides, 0.04 / slow));
    const double trough = std::min({most, damps, felt(slid, 4.0 * falls, aside, dt, share)});
    vector across = -std::max(std::min(slides, 0.02 / slow), trough) * v_across;
    if (const double length = w_across.norm(); length > 0.0) {
      const double brakes = limited(-damps * w_across.dot(v) / length, 0.0, p.lead * length);
      across += w_across * (brakes / length);
    }
    if (across.norm() > w.norm()) across *= w.norm() / across.norm();
    return w - n * limited(std::min(damps, braking) * speed, -2.0 * along, along) + across;
  }
};

/// How often it was felt softer, rose again, was whole again, and was cut by F.
struct felt {
  int softer = 0, rises = 0, whole = 0, cut = 0;
};

/// Tries one guard against its twin under a renderer that is steep, noisy, soft, gone, turned round or slow.
template <class Space, class Motion, class Limits>
felt tries(unsigned seed, const ph::settled_force& p, const Limits& limits, const Motion& motion,
           double tick, int ticks) {
  constexpr int N = Space::dof;
  using vector = Eigen::Matrix<double, N, 1>;
  ph::laws::samples random(seed);
  ph::passive_port guard{Space{}, p, ph::no_observer{}, ph::no_bound{}, limits, motion};
  plainly<N> twin{p, 1e-3, Limits::latency, std::same_as<Motion, ph::last_difference>};
  const auto to = [](const vector& x) -> typename Space::vector {
    if constexpr (N == 1) {
      return x(0);
    } else {
      return x;
    }
  };
  const auto any = [&](double size) {
    vector out;
    for (int i = 0; i < N; ++i) out(i) = size * random.number<double>();
    return out;
  };
  felt out;
  const double most = twin.most();
  vector x = vector::Zero(), base = any(4.0), stiff = vector::Zero(), wanted = vector::Zero();
  const double steep = seed % 2 == 0 ? 1.0 : 4.0, spread = seed % 2 == 0 ? 0.1 : 1.0;
  double noise = 0.0, pace = 1e-5;
  (void)guard.tick(to(x), ph::seconds{tick}, to(wanted));
  for (int n = 1; n < ticks; ++n) {
    if (n % 23 == 1) {  // another renderer, or another hand
      const int kind = n % 900 < 140 ? (n / 23) % 7 : 3;
      stiff = any(spread) + (1.05 + spread) * vector::Ones();
      stiff *= most * (kind < 2 ? steep : kind == 2 ? 0.6 : 0.2);
      noise = kind == 4 ? 0.4 * most * 1e-5 : 0.0;
      pace = kind == 6 ? 1e-7 : kind == 3 ? 1e-4 : 1e-5;
      if (kind == 5) base = any(4.0);
    }
    if (n % 1103 == 0) {
      guard.reset();
      twin.reset();
      (void)guard.tick(to(x), ph::seconds{tick}, to(wanted));  // the position is news
      (void)twin.force(wanted, vector::Zero(), vector::Zero(), tick);
    }
    if (n % 1301 == 0) {
      for (const bool softens : {false, true}) {
        twin.p.softens = softens;
        REQUIRE_FALSE(guard.set(twin.p));
      }
      twin.forget();
    }
    const double dt = tick * (n % 5 == 4 ? 0.75 : 1.0);
    const vector way = n % 41 == 40 ? vector(vector::Zero()) : any(pace);
    x += way;
    wanted = base - vector(stiff.cwiseProduct(x)) + any(noise);
    if (n % 97 > 94) wanted.setZero();
    const double rises = twin.shown;
    const vector expected =
        twin.force(wanted, way, way * ((twin.knows_speed ? 1.0 : 8.0) / dt), dt);
    vector got;
    const auto f = guard.tick(to(x), ph::seconds{dt}, to(wanted)).force;
    for (int i = 0; i < N; ++i) got(i) = Space::component(f, i);
    CAPTURE(N, seed, n, got, expected, twin.shown);
    REQUIRE_THAT(guard.source().shown(), WithinRel(twin.shown, 1e-6));
    REQUIRE((got - expected).norm() <= 1e-6 * (1e-3 + expected.norm()));
    out.softer += twin.shown < 0.7 ? 1 : 0;
    out.rises += twin.shown > rises ? 1 : 0;
    out.whole += twin.shown == 1.0 && rises < 1.0 ? 1 : 0;
    out.cut += twin.shown * wanted.norm() > p.force_limit ? 1 : 0;
  }
  return out;
}

}  // namespace

TEST_CASE("a settled force is that of its formulas, with the slope which all ticks together have",
          "[settled_force]") {
  ph::settled_force limited = rule;
  limited.force_limit = 3.0;
  limited.slide_fraction = 0.05;
  const ph::loop_limits prompt{.longest_tick = 1e-3};
  const ph::late_loop_limits<1> late{.longest_tick = 1e-3};
  const ph::loop_limits hasty{.longest_tick = 1e-3, .top_speed = 1e20};
  const ph::last_difference known{};
  felt all;
  const auto also = [&](const felt& f) {
    all = {all.softer + f.softer, all.rises + f.rises, all.whole + f.whole, all.cut + f.cut};
  };
  for (unsigned seed = 1; seed < 7; ++seed) {
    also(tries<d1>(seed, limited, prompt, known, 1e-3, 1800));
    also(tries<d2>(seed, limited, prompt, known, 1e-3, 1800));
    also(tries<d3>(seed, rule, late, known, 1e-3, 1800));
    also(tries<d2>(seed, rule, prompt, faster{}, 1e-3, 1800));
    also(tries<d1>(seed, rule, prompt, faster{}, 1e-3, 1800));
    also(tries<d2>(seed, no_slide, hasty, known, 1e-20, 100));  // ticks that count as whole ones
  }
  CHECK(all.softer > 2000);
  CHECK(all.rises > 50);
  CHECK(all.whole > 3);
  CHECK(all.cut > 50);
}

TEST_CASE("a wall that heaves against a finger that gives in steadily is not taken for a steep one",
          "[settled_force]") {
  // The finger moves in at 2 mm/s and the wall comes at four times that, so each tick looks five times as steep.
  const double K = 0.4 * rule.most_stiffness(1e-3);
  auto guard = guard_of<d1>(rule);
  double x = 0.0, wall = 0.0, step = 0.0, last = 0.0;
  for (int n = 0; n < 400; ++n) {
    const double f = guard.tick(x, 1ms, K * std::max(0.0, wall - x)).force;
    if (n > 5) step = std::max(step, std::abs(f - last));
    last = f;
    x -= 2e-6 + 0.1e-6 * std::sin(0.05 * n);
    wall += 8e-6;
  }
  CHECK(guard.source().shown() == 1.0);
  CHECK(step < 0.1);
}

TEST_CASE("a slope of K_m is not too steep, and at 1 mm/s none is learned", "[settled_force]") {
  ph::settled_force p = rule;
  p.most = 1024.0;
  const double dt = 0x1p-10, step = 0x1p-12;
  const auto shown_after = [&](const auto& motion, double at_first, int steep) {
    ph::passive_port guard{
        d1{}, p, ph::no_observer{}, ph::no_bound{}, ph::loop_limits{.longest_tick = 1e-3}, motion};
    double x = 0.0, w = 64.0;
    int tick = 0;
    const auto next = [&](double K) {
      const double way = ++tick % 2 == 0 ? step : 3.0 * step;
      x -= way;
      w += K * way;
      (void)guard.tick(x, ph::seconds{dt}, w);
    };
    (void)guard.tick(x, ph::seconds{dt}, w);
    next(at_first);
    for (int n = 0; n < 3; ++n) next(0.0);
    for (int n = 0; n < steep; ++n) next(16384.0);
    return double(guard.source().shown());
  };
  const auto both = [&](double at_first, int steep) {
    const double s = shown_after(ph::last_difference{}, at_first, steep);
    CHECK(s == shown_after(faster{}, at_first, steep));
    return s;
  };
  CHECK(both(1024.0, 5) == 1.0);  // one is noticed, one begins, and three are too few
  CHECK(both(1024.0, 6) < 1.0);
  CHECK(both(1025.0, 5) < 1.0);  // and so many are enough where more of them count

  const auto crept = [&](double times) {
    auto guard = guard_of<d1>(rule);
    const double way = times * (1e-3 * 1e-3), K = 8.0 * rule.most_stiffness(1e-3);
    for (int n = 0; n < 40; ++n) {
      const double x = n % 2 == 0 ? 0.0 : way;
      (void)guard.tick(x, 1ms, 3.0 - K * x);
    }
    return double(guard.source().shown());
  };
  CHECK(crept(1.0) == 1.0);
  CHECK(crept(1.01) < 1.0);

  const auto turned =
      [&](double K) {  // steeper along, and it pushes across: softer than K_m in all
        ph::passive_port guard{d2{}, p, ph::no_observer{}, ph::no_bound{},
                               ph::loop_limits{.longest_tick = 1e-3}};
        d2::vector x(0, 0), w(0, 4096);
        const auto next = [&](const d2::vector& way, const d2::vector& change) {
          x += way;
          w += change;
          (void)guard.tick(x, ph::seconds{dt}, w);
        };
        next({0, 0}, {0, 0});
        next({0, -step}, {0, 2048.0 * step});  // noticed
        next({0, 0}, {0, 0});
        next({0, -step}, {0, K * step});
        for (int n = 0; n < 9; ++n) {
          const double way = n % 2 == 0 ? 3.0 * step : step;
          next({way, -way}, {8192.0 * way, 4096.0 * way});
        }
        return double(guard.source().shown());
      };
  CHECK(turned(1024.0) == 1.0);
  CHECK(turned(1025.0) < 1.0);
}

TEST_CASE("a port says what settles in its own loop, and why it shows less", "[settled_force]") {
  ph::settled_force told = rule;
  told.most = 5e4;
  const auto port = [&](const auto& limits) {
    return ph::passive_port{d1{}, ph::settled_force{told}, ph::no_observer{}, ph::no_bound{},
                            limits};
  };
  auto prompt = port(ph::loop_limits{.longest_tick = 2e-3, .top_speed = 100});
  const double most =
      rule.most_stiffness(2e-3);  // B (k + l + 3/2) T, four times softer than at 1 ms
  CHECK_THAT(most, WithinRel(0.25 * 0.1 / (1.5 * 4e-6), 1e-12));
  CHECK(prompt.source().settles(most * 0.999));
  CHECK_FALSE(prompt.source().settles(most * 1.001));
  CHECK(prompt.source().settles(most * 0.599, 1));
  CHECK_FALSE(prompt.source().settles(most * 0.601, 1));
  CHECK_FALSE(prompt.source().settles(1.0, 5));  // across w a lead of 5 ticks is needed
  CHECK(prompt.explain().shown == most);
  CHECK(prompt.explain().asked == std::numeric_limits<double>::infinity());
  const auto late = port(ph::late_loop_limits<1>{.longest_tick = 1e-3, .top_speed = 100});
  CHECK(late.source().settles(rule.most_stiffness(1e-3, 0, 1) * 0.999));
  CHECK_FALSE(late.source().settles(rule.most_stiffness(1e-3, 0, 1) * 1.001));
  CHECK_THAT(rule.most_stiffness(1e-3, 0, 1), WithinRel(0.25 * 0.1 / (2.0 * 2.5 * 1e-6), 1e-12));
  told.most = 500.0;  // what the friction on encoders pays for
  CHECK(port(ph::loop_limits{.longest_tick = 1e-3}).explain().shown == 500.0);

  const auto steepened = [&](auto& guard, double K) {
    for (int n = 0; n < 500; ++n) {
      const double x = 2e-4 * std::sin(0.05 * n);
      (void)guard.tick(x, 1ms, std::max(0.0, 3.0 - K * x));
    }
  };
  told.most = 1000.0;  // is what is learned from, too
  auto thrifty = port(ph::loop_limits{.longest_tick = 1e-3, .top_speed = 100});
  steepened(thrifty, 4000.0);
  CHECK_THAT(thrifty.source().shown(), WithinRel(0.75 / 4.0, 0.03));
  CHECK_THAT(thrifty.explain().shown, WithinRel(750.0, 1e-9));
  CHECK_THAT(thrifty.explain().asked, WithinRel(4000.0, 0.03));
  told.lead = 4.0;
  CHECK_FALSE(thrifty.set(told));  // it goes on with what it has learned
  CHECK(thrifty.source().shown() < 0.2);
  told.softens = false;
  CHECK_FALSE(thrifty.set(told));
  CHECK(thrifty.source().shown() == 1.0);
  steepened(thrifty, 4000.0);
  CHECK(thrifty.source().shown() == 1.0);
  told.most = 0.0;
  CHECK(told.check().parameter == std::string_view("most"));
}

TEMPLATE_TEST_CASE("what is shown of a renderer is a share of it, however small or huge its forces",
                   "[settled_force]", d2, d3, f1, f3) {
  using scalar = typename TestType::scalar;
  using vector = typename TestType::vector;
  const scalar least = ph::kernels::smallest<scalar>(), root = std::sqrt(least);
  ph::laws::samples draw{11};
  auto guard = guard_of<TestType>(rule);
  vector x = TestType::zero();
  for (int n = 0; n < 20000; ++n) {
    x = x + scalar(1e-4) * draw.vector<TestType>();
    const scalar sizes[] = {scalar(1),          scalar(1e3),      root,
                            root * scalar(1e3), scalar(1) / root, least};
    const vector w = sizes[draw.bits() % 6] * draw.vector<TestType>();
    (void)guard.tick({x, TestType::zero(), scalar(1e-3), true}, w);
    REQUIRE(guard.source().shown() > scalar(0));
    REQUIRE(guard.source().shown() <= scalar(1));
  }
}

// ------------------------------------------------------------------ as a shaper of a contact law

namespace {

/// A surface under a law, which the test moves.
template <class Space, class Law, class Observer, class Bound, class Limits, class Motion>
auto surface_under(const Law& law, const Observer& observer, const Bound& bound,
                   const Limits& limits, const Motion& motion) {
  return ph::local_model{Space{},
                         ph::followed<ph::half_space<Space>>{},
                         ph::turn_at_once{},
                         law,
                         observer,
                         bound,
                         limits,
                         motion};
}

/// Somebody's laws without a damper: one that stiffens, twice as stiff 0.5 mm deep as at the surface, and one that
/// pushes a device that leaves with 1 N·s/m.
struct stiffening {
  double pushes = 0.0, length = 1e-3;  ///< [N·s/m], [m]
  [[nodiscard]] constexpr ph::parameter_fault check() const noexcept { return {}; }
  template <class Space>
  class on {
   public:
    constexpr explicit on(const stiffening& p) noexcept : pushes_(p.pushes), length_(p.length) {}
    constexpr void adopt(double K, double /*T*/) noexcept { K_ = K; }
    [[nodiscard]] constexpr double force(double d, double v) const noexcept {
      return d > 0.0 ? std::max(0.0, K_ * d * (1.0 + d / length_) + pushes_ * v) : 0.0;
    }
    [[nodiscard]] double depth(double f, double v) const noexcept {
      const double still = std::max(0.0, f - pushes_ * v) / (K_ * length_);
      return length_ * still * 2.0 / (1.0 + std::sqrt(1.0 + 4.0 * still));
    }

   private:
    double pushes_, length_, K_ = 0.0;
  };
};
constexpr stiffening pushing{.pushes = 1.0, .length = 1.0};

/// Comes down onto z = 0, presses 2 N more and holds still from 1.5 s on, or slides to and fro.
struct pressing_hand {
  bool slides = false;
  [[nodiscard]] d3::vector force(double t, const d3::vector& x,
                                 const d3::vector& v) const noexcept {
    d3::vector goal(0.004, 0.003, 0.01 - 0.01 * std::min(t, 1.0));
    if (slides && t > 1.5) goal(0) += 0.02 * std::sin(5.0 * (t - 1.5));
    const d3::vector more(0.0, 0.0, -2.0 * std::clamp(2.0 * (t - 1.0), 0.0, 1.0));
    return 300.0 * (goal - x) - 0.5 * v + more;
  }
  [[nodiscard]] double mass() const noexcept { return 0.0; }
  [[nodiscard]] ph::parameter_fault check() const noexcept { return {}; }
};
struct pressed {
  double step = 0.0,
         speed = 0.0;  ///< the largest from a second after the hand holds still [N], [m/s]
  double along = 0.0;  ///< the largest force along the wall [N]
  double depth = 0.0, force = 0.0, shown = 0.0, asked = 0.0;  ///< at the end [m], [N], [N/m]
  double least = 0.0;                                         ///< energy at the port [J]
};
/// Presses, or slides on, a wall of K [N/m] under the law, behind a reachable_bound or behind none.
template <class Law>
pressed press(const Law& law, double K, bool bounded = true, bool slides = false) {
  const auto run = [&](auto model) {
    pressed seen;
    REQUIRE(model.update({d3::vector(0, 0, 0), d3::vector(0, 0, 1), K}));
    sim::device<d3, pressing_hand> device{
        {.mass = 0.1, .damping = 0.1, .start = d3::vector(0.004, 0.003, 0.01)}, {slides}};
    auto sample = device.exchange(d3::zero());
    d3::vector last = d3::zero();
    for (int n = 1; n < 4000; ++n) {
      const d3::vector f = model.tick(sample).force;
      sample = device.exchange(f);
      seen.along = std::max(seen.along, std::hypot(f(0), f(1)));
      if (n > 2500) {
        seen.step = std::max(seen.step, (f - last).norm());
        seen.speed = std::max(seen.speed, device.velocity().norm());
      }
      last = f;
    }
    seen.depth = -device.position()(2);
    seen.force = last(2);
    seen.shown = model.explain().shown;
    seen.asked = model.explain().asked;
    seen.least = device.meter().minimum();
    return seen;
  };
  const ph::last_difference known{};
  if (!bounded) {
    return run(surface_under<d3>(law, ph::no_observer{}, ph::no_bound{}, thesis_loop, known));
  }
  return run(surface_under<d3>(law, ph::reduced_energy{.damping = 0.05},
                               ph::bound_chain{ph::reachable_bound{.mass = 0.1, .hand_force = 8.0},
                                               ph::actuator_limit{.most = 9.0}},
                               ph::loop_limits{.longest_tick = 1.1e-3}, known));
}
bool rests(const pressed& p) {
  return p.step <= 0.02 && p.speed <= 1e-3;
}

/// A shaper that changes nothing.
struct as_it_is {
  static constexpr bool needs_local_model = false, needs_ledger = false;
  template <class Space>
  struct on {
    constexpr explicit on(const as_it_is& /*p*/) noexcept {}
    [[nodiscard]] constexpr ph::share<double> shape(const auto& /*f*/, const auto& /*contact*/,
                                                    const auto& /*port*/) const noexcept {
      return {1.0};
    }
  };
};

/// The shaped spring is the source that is given the spring's force, bit by bit, on a surface that moves.
template <class Space, class Limits, class Motion>
void shapes_as_it_is_asked(const ph::settled_force& p, const Limits& limits, const Motion& motion,
                           double dt) {
  using vector = typename Space::vector;
  const ph::no_observer uncounted;
  const ph::no_bound unbounded;
  auto bare = surface_under<Space>(ph::spring{}, uncounted, unbounded, limits, motion);
  auto shaped = surface_under<Space>(ph::shaped{ph::spring{}, as_it_is{}, p}, uncounted, unbounded,
                                     limits, motion);
  ph::passive_port guard{Space{}, p, uncounted, unbounded, limits, motion};
  const double K = 3.0 * p.most_stiffness(limits.longest_tick, 0, Limits::latency);
  ph::laws::samples random(5);
  vector x = Space::zero();
  int differ = 0;
  double softest = 1.0;
  for (int n = 0; n < 4000; ++n) {
    if (n % 500 == 0) {
      const ph::half_space<Space> now{random.vector<Space>() * 1e-3, random.direction<Space>(),
                                      n % 1000 == 0 ? K : 0.1 * K};
      REQUIRE((bare.update(now) && shaped.update(now)));
      x = vector(now.point) - vector(now.normal) * 5e-4;
    }
    x = x + random.vector<Space>() * 2e-5;
    const auto given = bare.tick(x, ph::seconds{dt}).force;
    const auto asked = guard.tick(x, ph::seconds{dt}, given).force;
    const auto got = shaped.tick(x, ph::seconds{dt}).force;
    CAPTURE(Space::dof, Limits::latency, n);
    REQUIRE(got == asked);
    differ += got == given ? 0 : 1;
    softest = std::min(softest, double(guard.source().shown()));
    if (guard.source().shown() < 1.0) {
      REQUIRE_THAT(shaped.explain().shown,
                   WithinRel(guard.source().shown() * shaped.explain().asked, 1e-9));
    }
  }
  CAPTURE(Space::dof, Limits::latency, differ);
  CHECK(differ > 3000);
  CHECK(softest < 0.5);
}

}  // namespace

TEST_CASE("as a shaper it makes of a law's force what the source makes of a given one",
          "[settled_force][shaper]") {
  ph::settled_force limited = rule;
  limited.force_limit = 20.0;
  const ph::last_difference known{};
  shapes_as_it_is_asked<d1>(rule, thesis_loop, known, 1e-3);
  shapes_as_it_is_asked<d3>(rule, thesis_loop, known, 1e-3);
  shapes_as_it_is_asked<d3>(limited, thesis_loop, faster{}, 0.75e-3);
  shapes_as_it_is_asked<d2>(rule, ph::late_loop_limits<1>{.longest_tick = 2e-3, .top_speed = 100.0},
                            known, 1.9e-3);
}

TEST_CASE("a law without a damper rings, and shaped by settled_force it rests where it did",
          "[settled_force][shaper]") {
  const auto tries = [](const auto& law, double K) {
    CAPTURE(K);
    const pressed bare = press(law, K), now = press(ph::shaped{law, rule}, K);
    const pressed alone = press(ph::shaped{law, rule}, K, false);
    CHECK_FALSE(rests(bare));
    CHECK(rests(now));
    CHECK(rests(alone));
    CHECK(now.least == 0.0);
    CHECK(now.shown == K);
    ph::part_at<std::remove_cvref_t<decltype(law)>, d3> by_itself(law);
    by_itself.adopt(K, 1e-3);
    CHECK_THAT(alone.depth, WithinAbs(by_itself.depth(alone.force, 0.0), 1e-6));
  };
  tries(ph::spring{}, 2000.0);
  for (const double K : {500.0, 2000.0}) {
    tries(stiffening{}, K);
    tries(pushing, K);
  }
}

TEST_CASE("a law too stiff for the mass and the tick is felt softer, and rests",
          "[settled_force][shaper]") {
  ph::settled_force as_stiff = rule;
  as_stiff.softens = false;
  const double most = rule.most_stiffness(1e-3);
  for (const double times : {1.5, 3.0, 10.0}) {
    CAPTURE(times);
    const double K = times * most;
    const pressed now = press(ph::shaped{ph::spring{}, rule}, K, false);
    CHECK(rests(now));
    CHECK(now.shown < 1.2 * most);
    CHECK(now.shown > 0.5 * most);
    CHECK_THAT(now.depth, WithinRel(now.force / now.shown, 1e-3));
    CHECK_FALSE(rests(press(ph::spring{}, K, false)));
    CHECK_FALSE(rests(press(ph::shaped{ph::spring{}, as_stiff}, 3.0 * K, false)));
    const pressed behind = press(ph::shaped{ph::spring{}, rule}, K);
    CHECK(rests(behind));
    CHECK(behind.least == 0.0);
  }
  const pressed cap = press(ph::shaped{ph::capped{ph::spring{}, 2.0 * most}, rule}, 4.0 * most);
  CHECK(rests(cap));
  CHECK(cap.asked == 4.0 * most);
  CHECK(cap.shown < 1.2 * most);
}

TEST_CASE("along a flat wall a shaped law drags by 0.05 N at most", "[settled_force][shaper]") {
  for (const double K : {500.0, 2000.0, 8000.0}) {
    CAPTURE(K);
    const pressed now = press(ph::shaped{ph::spring{}, rule}, K, true, true);
    CHECK(now.along < 0.05);
    CHECK(now.along > 0.01);
    CHECK(now.least == 0.0);
    CHECK(press(ph::shaped{ph::spring{}, no_slide}, K, true, true).along < 0.005);
  }
}

TEST_CASE("a surface says what is shown of it under a law that settled_force shapes",
          "[settled_force][shaper]") {
  const auto under = [](const ph::settled_force& p, double T = 1e-3) {
    return surface_under<d1>(ph::shaped{ph::spring{}, p}, ph::no_observer{}, ph::no_bound{},
                             ph::loop_limits{.longest_tick = T, .top_speed = 100.0},
                             ph::last_difference{});
  };
  const double most = rule.most_stiffness(1e-3);
  auto model = under(rule);
  CHECK(double(model.update(wall<d1>(0.99 * most)).stiffness) == 0.99 * most);
  CHECK(model.explain().stiffness == ph::softened_by::nothing);
  CHECK_THAT(double(model.update(wall<d1>(4.0 * most)).stiffness), WithinRel(most, 1e-12));
  CHECK_THAT(model.explain().shown, WithinRel(most, 1e-12));
  CHECK(model.explain().asked == 4.0 * most);
  CHECK(model.explain().stiffness == ph::softened_by::mass_and_tick);
  REQUIRE_FALSE(model.set(ph::loop_limits{.longest_tick = 2e-3, .top_speed = 100.0}));
  CHECK_THAT(model.explain().shown, WithinRel(most / 4.0, 1e-12));

  ph::settled_force thrifty = rule;
  thrifty.most = 800.0;
  auto paid = under(thrifty);
  paid.update(wall<d1>(1000));
  CHECK(paid.explain().shown == 800.0);
  CHECK(paid.explain().stiffness == ph::softened_by::encoder_steps);
  thrifty.softens = false;
  REQUIRE_FALSE(paid.set(thrifty));
  CHECK(paid.explain().shown == 1000.0);

  const ph::damped_spring damped{.mass = 0.1};
  const auto late = [](const auto& law) {
    auto one = surface_under<d1>(law, ph::no_observer{}, ph::no_bound{},
                                 ph::late_loop_limits<2>{.longest_tick = 1e-3, .top_speed = 100.0},
                                 ph::last_difference{});
    return double(one.update(wall<d1>(5e4)).stiffness);
  };
  CHECK(late(ph::shaped{damped, as_it_is{}}) == late(damped));
  CHECK(late(damped) < double(under(rule).update(wall<d1>(5e4)).stiffness));
  static_assert(!ph::settled_force::needs_local_model && !ph::settled_force::needs_ledger);
  CHECK(ph::shaped{ph::spring{}, ph::settled_force{}}.check().parameter ==
        std::string_view("mass"));
}

TEST_CASE("a shaped law takes new parameters of settled_force and keeps what it has learned",
          "[settled_force][shaper]") {
  ph::settled_force heavy = rule, wrong = rule;
  heavy.mass = 0.2;
  wrong.mass = 0.0;
  check_upkeep(
      following_half_space<d1>(ph::shaped{ph::spring{}, rule}, thesis_ledger(), ph::strict_bound{}),
      rule, heavy, wrong);
}

TEST_CASE("a strict bound behind a law that settled_force shapes keeps its promise",
          "[settled_force][shaper][passivity]") {
  const ph::shaped settling{ph::spring{}, rule};
  const auto least = [&](const auto& bound) {
    return attacks::worst_of<d1>(attacks::model_of<d1>(bound, thesis_loop, settling), {}, 4).least;
  };
  CHECK(least(ph::strict_bound{}) >= -1e-12);
  CHECK(least(ph::no_bound{}) < -1e-6);
}
