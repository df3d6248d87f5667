// SPDX-License-Identifier: BSD-3-Clause
// The simulation is the judge of every passivity claim, so it is tried first: against closed forms
// and series in long double, against its own energy books, and against the lemmas of
// docs/design/mathematics.md. Each negative has a positive control.
#include "simulation/reference.hpp"
#include "support/catch.hpp"
#include <passive_haptics/simulation/axis.hpp>
#include <passive_haptics/simulation/schedule.hpp>

#include <algorithm>
#include <cmath>

namespace sim = ph::simulation;
using namespace simulated;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// ∫ b v² dt by Simpson's rule on a grid as dense in every time constant of the decay.
double damped_energy(double m, double b, double F, double v0, double h) {
  constexpr int panels = 2000;
  const double constants = std::log1p(b / m * h);
  const auto at = [&](int i) {
    const double share = double(i) / panels;
    return constants > 1.0 ? h * std::expm1(constants * share) / std::expm1(constants) : h * share;
  };
  const auto square = [&](double t) {
    const real v = solve(m, b, F, v0, t).velocity;
    return v * v;
  };
  real sum = 0;
  for (int i = 0; i < panels; ++i) {
    const double from = at(i), to = at(i + 1);
    sum += real(to - from) / 6 * (square(from) + 4 * square((from + to) / 2) + square(to));
  }
  return b * double(sum);
}

double relative_error(double got, double wanted, double scale) {
  return std::abs(got - wanted) / scale;
}

}  // namespace

TEST_CASE("axis falls as the closed form says, for any damping and mass", "[simulation][axis]") {
  for (const double m : {1e-4, 1e-2, 0.1, 10.0}) {
    for (const double b : {0.0, 1e-12, 1e-3, 0.03, 5.0, 1e3}) {
      for (const double h : {5e-5, 1e-3, 0.02, 1.0}) {
        for (const double v0 : {0.0, 0.3, -0.7}) {
          const double F = -m * 9.81;
          const sim::axis along{.mass = m, .damping = b};
          sim::axis_state state{0.1, v0};
          const sim::axis_motion moved = along.advance(state, F, h);
          const reference wanted = solve(m, b, F, v0, h);
          const double speed = std::max(std::abs(v0), std::abs(double(wanted.velocity)));
          const double way = std::max({std::abs(double(wanted.position)), 1e-9 * h});
          CAPTURE(m, b, h, v0);
          CHECK(relative_error(state.velocity, double(wanted.velocity), speed) < 1e-12);
          CHECK(relative_error(moved.displacement, double(wanted.position), way) < 1e-12);
          CHECK(state.position == 0.1 + moved.displacement);
          CHECK(moved.friction == 0.0);
          CHECK(moved.stops == 0.0);
        }
      }
    }
  }
  SECTION("control: the Euler step that this replaces is off by more than 1e-4") {
    CHECK(relative_error(0.3 - 9.81 * 0.02 - 0.03 / 0.1 * 0.3 * 0.02,
                         double(solve(0.1, 0.03, -0.981, 0.3, 0.02).velocity), 0.3) > 1e-4);
  }
}

TEST_CASE("axis damping is the integral of b v², and never negative", "[simulation][axis]") {
  for (const double m : {1e-4, 0.1, 10.0}) {
    for (const double b : {1e-12, 0.03, 1.0, 1e3}) {
      for (const double h : {5e-5, 1e-3, 0.3}) {
        for (const double v0 : {0.0, 0.5, -0.5}) {
          for (const double F : {0.0, 1.0, -3.0, 0.5 * b}) {
            const sim::axis along{.mass = m, .damping = b};
            sim::axis_state state{0.0, v0};
            const double damped = along.advance(state, F, h).damping;
            CAPTURE(m, b, h, v0, F);
            CHECK(damped >= 0.0);
            CHECK_THAT(damped, WithinRel(damped_energy(m, b, F, v0, h), 2e-9));
          }
        }
      }
    }
  }
  SECTION("where F Δx and ½ m Δ(v²) cancel to nothing, it still has all its digits") {
    const sim::axis along{.mass = 10.0, .damping = 1e-12};
    sim::axis_state state{0.0, 1.0};
    CHECK_THAT(along.advance(state, 0.0, 1e-3).damping, WithinRel(1e-15, 1e-12));
  }
}

TEST_CASE("axis obeys the semigroup law: one step of T is n steps of T/n", "[simulation][axis]") {
  sim::random_source random{7};
  for (int trial = 0; trial < 200; ++trial) {
    const sim::axis along{.mass = random.uniform(0.05, 0.5),
                          .damping = random.uniform(0.0, 1.0),
                          .friction = trial % 2 == 0 ? 0.0 : random.uniform(0.0, 0.5),
                          .lower = -0.01,
                          .upper = 0.02};
    const sim::axis_state start{random.uniform(-0.01, 0.02), random.uniform(-1.0, 1.0)};
    const double F = random.uniform(-2.0, 2.0);
    constexpr int n = 64;
    constexpr double T = 0.05;
    sim::axis_state once = start, often = start;
    const sim::axis_motion whole = along.advance(once, F, T);
    double damping = 0.0, friction = 0.0, stops = 0.0;
    for (int i = 0; i < n; ++i) {
      const sim::axis_motion part = along.advance(often, F, T / n);
      damping += part.damping;
      friction += part.friction;
      stops += part.stops;
    }
    CAPTURE(trial, along.mass, along.damping, along.friction, start.position, start.velocity, F);
    CHECK_THAT(once.position, WithinAbs(often.position, 1e-14));
    CHECK_THAT(once.velocity, WithinAbs(often.velocity, 1e-12));
    CHECK_THAT(whole.damping, WithinAbs(damping, 1e-14));
    CHECK_THAT(whole.friction, WithinAbs(friction, 1e-14));
    CHECK_THAT(whole.stops, WithinAbs(stops, 1e-13));
  }
}

TEST_CASE("axis friction stops a block at the analytic time, and it sticks", "[simulation][axis]") {
  const double m = 0.1, f_c = 0.2, v0 = 0.5;
  SECTION("undamped: after m v/f_c, on m v²/(2 f_c)") {
    const sim::axis along{.mass = m, .damping = 0.0, .friction = f_c};
    sim::axis_state before{0.0, v0}, after{0.0, v0};
    along.advance(before, 0.0, 0.25 * (1 - 1e-9));
    CHECK(before.velocity > 0.0);
    const sim::axis_motion moved = along.advance(after, 0.0, 0.25 * (1 + 1e-9));
    CHECK(after.velocity == 0.0);
    CHECK_THAT(after.position, WithinRel(m * v0 * v0 / (2 * f_c), 1e-14));
    CHECK_THAT(moved.friction, WithinRel(m * v0 * v0 / 2, 1e-14));
  }
  SECTION("damped: after (m/b) ln(1 + b v/f_c)") {
    const double b = 0.4, time = m / b * std::log1p(b * v0 / f_c);
    const sim::axis along{.mass = m, .damping = b, .friction = f_c};
    sim::axis_state before{0.0, v0}, after{0.0, v0};
    along.advance(before, 0.0, time * (1 - 1e-9));
    CHECK(before.velocity > 0.0);
    along.advance(after, 0.0, time * (1 + 1e-9));
    CHECK(after.velocity == 0.0);
    CHECK_THAT(after.position, WithinRel(double(solve(m, b, -f_c, v0, time).position), 1e-13));
  }
  SECTION("a force up to f_c does not move it, a larger one moves it by the excess") {
    const sim::axis along{.mass = m, .damping = 0.0, .friction = f_c};
    sim::axis_state stuck, sliding;
    for (int i = 0; i < 1000; ++i) along.advance(stuck, i % 2 == 0 ? f_c : -f_c, 1e-3);
    CHECK(stuck.position == 0.0);
    CHECK(stuck.velocity == 0.0);
    along.advance(sliding, 0.3, 1.0);
    CHECK_THAT(sliding.position, WithinRel((0.3 - f_c) / m / 2, 1e-13));
  }
}

TEST_CASE("axis handles rest, reversal and both stops in one interval", "[simulation][axis]") {
  const double m = 0.1, f_c = 0.2, F = -1.0;
  const sim::axis along{.mass = m, .damping = 0.0, .friction = f_c, .lower = -0.03, .upper = 1.0};
  sim::axis_state state{0.0, 0.5};
  // out against F and friction to v²/(2a), back with F − friction into the lower stop, rest
  const double out = 0.5 * 0.5 / (2 * (1.0 + f_c) / m);
  const double back = out + 0.03;
  const sim::axis_motion moved = along.advance(state, F, 1.0);
  CHECK(state.position == -0.03);
  CHECK(state.velocity == 0.0);
  CHECK_THAT(moved.displacement, WithinRel(-0.03, 1e-13));
  CHECK_THAT(moved.friction, WithinRel(f_c * (out + back), 1e-13));
  CHECK_THAT(moved.stops, WithinRel((1.0 - f_c) * back, 1e-13));

  SECTION("stop, away from it, other stop") {
    const sim::axis narrow{
        .mass = m, .damping = 0.1, .friction = 0.1, .lower = -0.01, .upper = 0.01};
    sim::axis_state bounced{0.0, 2.0};
    const sim::axis_motion both = narrow.advance(bounced, F, 1.0);
    CHECK(bounced.position == -0.01);
    CHECK(bounced.velocity == 0.0);
    CHECK_THAT(both.friction, WithinRel(0.1 * 0.03, 1e-13));
    CHECK_THAT(F * both.displacement + m * 4.0 / 2 - both.damping - both.friction - both.stops,
               WithinAbs(0.0, 1e-15));
  }
}

TEST_CASE("axis stops inelastically at the analytic impact time", "[simulation][axis]") {
  const sim::axis along{.mass = 0.1, .damping = 0.0, .upper = 0.05};
  const double time = std::sqrt(2 * 0.05 / 9.81);
  sim::axis_state before, after;
  along.advance(before, 0.981, time * (1 - 1e-9));
  CHECK(before.position < 0.05);
  CHECK(before.velocity > 0.0);
  const sim::axis_motion moved = along.advance(after, 0.981, time * (1 + 1e-9));
  CHECK(after.position == 0.05);
  CHECK(after.velocity == 0.0);
  CHECK_THAT(moved.stops, WithinRel(0.981 * 0.05, 1e-13));

  SECTION("it rests while pushed, books nothing, and leaves when pulled") {
    const sim::axis_motion resting = along.advance(after, 5.0, 1.0);
    CHECK(resting.displacement == 0.0);
    CHECK(resting.stops == 0.0);
    along.advance(after, -0.1, 0.1);
    CHECK_THAT(after.position, WithinRel(0.05 - 0.1 / 0.1 * 0.01 / 2, 1e-13));
  }
  SECTION("with damping, friction and speed: the impact time solves the equation of motion") {
    const sim::axis damped{.mass = 0.1, .damping = 0.8, .friction = 0.05, .upper = 0.05};
    sim::axis_state moving{0.0, 0.6};
    const sim::axis_motion hit = damped.advance(moving, 0.4, 0.5);
    CHECK(moving.position == 0.05);
    double early = 0.0, late = 0.5;  // bisection, on the reference
    for (int i = 0; i < 200; ++i) {
      const double middle = (early + late) / 2;
      (solve(0.1, 0.8, 0.35, 0.6, middle).position < 0.05L ? early : late) = middle;
    }
    const double speed = static_cast<double>(solve(0.1, 0.8, 0.35, 0.6, late).velocity);
    CHECK_THAT(hit.stops, WithinRel(0.1 * speed * speed / 2, 1e-12));
    CHECK_THAT(hit.damping, WithinRel(damped_energy(0.1, 0.8, 0.35, 0.6, late), 1e-9));
  }
}
