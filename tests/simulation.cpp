// SPDX-License-Identifier: BSD-3-Clause
// The simulation is the judge of every passivity claim, so it is tried first: against closed forms
// and series in long double, against its own energy books, and against the lemmas of
// docs/design/mathematics.md. Each negative has a positive control.

#include "support/catch.hpp"
#include <passive_haptics/eigen_space.hpp>
#include <passive_haptics/simulation/adversary.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/prescribed_motion.hpp>
#include <passive_haptics/simulation/scripted_device.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace ph = passive_haptics;
namespace sim = passive_haptics::simulation;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

using line = ph::space<double, 1>;
using plane = ph::space<double, 2>;
using room = ph::space<double, 3>;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

template <class Space>
constexpr bool is_modelled = ph::haptic_device_for<sim::device<Space>, Space>&&
    ph::haptic_device_for<sim::device<Space, sim::impedance_hand<Space>>,
                          Space>&& ph::haptic_device_for<sim::prescribed_motion<Space>, Space>&&
        ph::haptic_device_for<sim::scripted_device<sim::device<Space>, 2>, Space>&& sim::hand_for<
            sim::no_hand<Space>, Space>&& sim::hand_for<sim::constant_hand<Space>, Space>&&
            sim::hand_for<sim::impedance_hand<Space>, Space>&&
                sim::hand_for<sim::tapping_hand<Space>, Space>&&
                    sim::adversary_for<sim::nyquist_motion<Space>, Space>&&
                        sim::adversary_for<sim::random_walk<Space>, Space>&&
                            sim::adversary_for<sim::greedy_motion<Space>, Space>;
static_assert(is_modelled<ph::space<float, 1>> && is_modelled<line>);
static_assert(is_modelled<ph::space<float, 2>> && is_modelled<plane>);
static_assert(is_modelled<ph::space<float, 3>> && is_modelled<room>);
struct mute {};
static_assert(!ph::haptic_device_for<mute, line> && !sim::hand_for<mute, line> &&
              !sim::adversary_for<mute, line>);

using real = long double;
struct reference {
  real position, velocity;
};

/// m v̇ + b v = F by other means than the library: the power series of the solution, or for
/// b h/m > 1 its closed form, in long double.
reference solve(double mass, double damping, double force, double speed, double time) {
  const real r = real(damping) / real(mass), a = real(force) / real(mass);
  const real v0 = real(speed), h = real(time), z = r * h;
  if (z > 1) {
    const real final_speed = a / r, decay = std::exp(-z);
    return {final_speed * h + (v0 - final_speed) * (1 - decay) / r,
            final_speed + (v0 - final_speed) * decay};
  }
  real term = (a - r * v0) * h, velocity = v0, position = v0 * h;
  for (int n = 1; n < 60; ++n) {
    velocity += term;
    position += term * h / real(n + 1);
    term *= -z / real(n + 1);
  }
  return {position, velocity};
}

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

namespace {

struct worked {
  double residual, stops, friction, hand, kinetic, from_samples, port;
  bool saturated;
};

/// A wall and random jolts against a hand that strokes, with everything switched on.
template <class Space>
worked work(int ticks) {
  using hand = sim::impedance_hand<Space>;
  sim::device_parameters<Space> parameters{.friction = 0.1,
                                           .force_limit = 9.0,
                                           .quantum = 1e-5,
                                           .lower = sim::every_axis<Space>(-0.03),
                                           .upper = sim::every_axis<Space>(0.04),
                                           .load = sim::every_axis<Space>(-0.4),
                                           .start_velocity = sim::every_axis<Space>(0.2),
                                           .latency = 2};
  sim::device<Space, hand> device{parameters,
                                  hand{.stiffness = 400.0, .limit = 8.0, .own_mass = 0.05}};
  REQUIRE_FALSE(device.check());
  sim::random_source random{11};
  typename Space::vector force = Space::zero();
  ph::compensated_sum<double> sampled;
  bool saturated = false;
  for (int n = 0; n < ticks; ++n) {
    if (n % 500 == 0) {
      device.hand().aim(random.template direction<Space>() * random.uniform(0.0, 0.08),
                        sim::physical<Space>::zero(), device.time());
    }
    device.set_period(random.uniform(0.5e-3, 1.5e-3));
    const auto before = device.position();
    const ph::device_sample<Space> sample = device.exchange(force);
    const typename Space::vector held = sample.held;
    const typename sim::physical<Space>::vector moved = device.position() - before;
    sampled += -sim::physical<Space>::dot(sim::to_physical<Space>(held), moved);
    saturated = saturated || static_cast<double>(Space::norm(held)) > 9.0 * (1 - 1e-6);
    for (int i = 0; i < Space::dof; ++i) {
      const auto x = static_cast<double>(sim::component(sample.position, i));
      sim::component(force, i) =
          static_cast<typename Space::scalar>(x < 0.0 ? -2000.0 * x : random.uniform(-0.5, 0.5));
    }
  }
  const sim::energy_flows total = device.meter().total();
  sampled += total.damping;
  return {device.residual(), total.stops,     total.friction,         total.hand,
          device.kinetic(),  double(sampled), device.meter().value(), saturated};
}

}  // namespace

TEMPLATE_TEST_CASE("device loses no joule in 1e5 ticks with everything switched on",
                   "[simulation][device][law]", line, plane, room, (ph::space<float, 1>),
                   (ph::space<float, 3>)) {
  const worked run = work<TestType>(100000);
  CHECK(std::abs(run.residual) < 1e-12);
  CHECK_THAT(run.from_samples, WithinAbs(run.port, 1e-11));  // Δ of rounded positions
  CHECK(run.saturated);
  SECTION("control: every flow is there, and leaving one out would show") {
    CHECK(run.stops > 1e-3);
    CHECK(run.friction > 1e-3);
    CHECK(std::abs(run.hand) > 1e-3);
    CHECK(std::abs(run.residual - run.stops) > 1e-12);
    CHECK(std::abs(run.residual - run.friction) > 1e-12);
    CHECK(std::abs(run.residual + 1e-9 * run.hand) > 1e-12);
  }
}

TEST_CASE("a held spring on a lossless mass leaks K Δx²/2 per tick (lemma L2)",
          "[simulation][device][law]") {
  const double K = 2000.0;
  sim::device<line> device{{.damping = 0.0, .start = -0.005}};
  double force = 0.0, leak = 0.0, wrong_pairing = 0.0;
  double last = device.exchange(force).position;
  const double first = last;
  const double before = device.meter().value();
  for (int n = 0; n < 300; ++n) {
    force = -K * last;
    const double next = device.exchange(force).position;
    leak += K * (next - last) * (next - last) / 2;
    wrong_pairing += -K * next * (next - last);
    last = next;
    const double spring = K * (last * last - first * first) / 2;
    CHECK_THAT(device.meter().value() - before, WithinAbs(spring - leak, 1e-12 * (1 + spring)));
  }
  CHECK(leak > 1e-3);
  CHECK(device.meter().minimum() < -1e-3);
  // control: pairing the NEW force with the last displacement has the opposite sign
  CHECK(std::abs(-wrong_pairing - (device.meter().value() - before)) > 1e-3);
}

namespace {

/// Does the swing on a sampled, delayed spring grow?
bool grows(double K, double b, int latency) {
  sim::device<line> device{{.damping = b, .start = 0.01, .latency = latency}};
  double force = 0.0;
  const double first = K * 0.01 * 0.01 / 2;
  double energy = first;
  for (int n = 0; n < 400000 && energy < 1e8 * first && energy > 1e-8 * first; ++n) {
    const double x = device.exchange(force).position;
    force = -K * x;
    energy = device.kinetic() + K * x * x / 2;
  }
  return energy > first;
}

}  // namespace

TEST_CASE("device is stable up to K = b/(T/2 + t_d), within 1 %", "[simulation][device][law]") {
  for (const double b : {0.03, 0.1, 0.3}) {
    for (const int latency : {0, 1, 2}) {
      const double theory = b / (0.5e-3 + latency * 1e-3);
      double low = 0.5 * theory, high = 2.0 * theory;
      REQUIRE_FALSE(grows(low, b, latency));
      REQUIRE(grows(high, b, latency));
      while (high - low > 1e-3 * theory) {
        const double middle = (low + high) / 2;
        (grows(middle, b, latency) ? high : low) = middle;
      }
      CAPTURE(b, latency);
      CHECK_THAT(low, WithinRel(theory, 0.01));
    }
  }
}

TEST_CASE("device holds the force of tick n in interval n + latency", "[simulation][device]") {
  const int latency = GENERATE(0, 1, 3, 8);
  sim::device<line> device{{.latency = latency}};
  for (int n = 0; n < 50; ++n) {
    const double wanted = n >= latency ? 0.1 * (n - latency + 1) : 0.0;
    const double speed = device.velocity();
    const ph::device_sample<line> sample = device.exchange(0.1 * (n + 1));
    CHECK(sample.held == wanted);
    CHECK(sample.dt == 1e-3);
    CHECK(sample.valid);
    const reference moved = solve(0.1, 0.03, wanted, speed, 1e-3);
    CHECK_THAT(device.velocity(), WithinAbs(double(moved.velocity), 1e-14));
  }
  CHECK_THAT(device.time(), WithinRel(0.05, 1e-15));
}

TEMPLATE_TEST_CASE("device holds the saturated force, and says so", "[simulation][device]",
                   (ph::space<float, 3>), room) {
  using vector = typename TestType::vector;
  using scalar = typename TestType::scalar;
  sim::device<TestType> device{{.force_limit = 9.0}};
  const vector asked(scalar(30), scalar(-40), scalar(120));
  const vector held = device.exchange(asked).held;
  CHECK_THAT(double(held.norm()), WithinRel(9.0, 1e-6));
  CHECK((held.normalized() - asked.normalized()).norm() < scalar(1e-6));
  const vector small(scalar(1), scalar(2), scalar(-3));
  CHECK(vector(device.exchange(small).held) == small);
  SECTION("a finite force whose norm overflows keeps its direction") {
    const scalar huge = std::numeric_limits<scalar>::max();
    const vector limited = device.exchange(vector(huge, huge, scalar(0))).held;
    CHECK_THAT(double(limited.norm()), WithinRel(9.0, 1e-6));
  }
}

TEST_CASE("device saturates one axis at exactly the limit", "[simulation][device]") {
  sim::device<line> device{{.force_limit = 9.0}};
  CHECK(device.exchange(10.0).held == 9.0);
  CHECK(device.exchange(-1e300).held == -9.0);
  CHECK(device.exchange(8.0).held == 8.0);
}

TEST_CASE("device holds zero instead of a command that is no number", "[simulation][device]") {
  sim::device<line> device{{.force_limit = 9.0}};
  for (const double bad : {not_a_number, infinity, -infinity}) {
    const ph::device_sample<line> sample = device.exchange(bad);
    CHECK(sample.held == 0.0);
    CHECK(sample.position == 0.0);
    CHECK(sample.valid);
  }
  CHECK(device.exchange(1.0).position > 0.0);  // control: a good one moves it
  sim::device<room> three;
  CHECK(room::vector(three.exchange({1.0, not_a_number, 0.0}).held) == room::zero());
}

TEST_CASE("device floors what it measures and meters what is true", "[simulation][device]") {
  sim::device<line> device{{.quantum = 60e-6, .start = -0.001, .start_velocity = 0.0377}};
  bool off_grid = false;
  for (int n = 0; n < 100; ++n) {
    const double seen = device.exchange(0.1).position;
    const double steps = seen / 60e-6;
    CHECK_THAT(steps, WithinAbs(std::round(steps), 1e-9));
    CHECK(seen <= device.position());
    CHECK(seen > device.position() - 60e-6 * (1 + 1e-12));
    off_grid = off_grid || device.position() - seen > 10e-6;
  }
  CHECK(off_grid);
  CHECK_THAT(device.meter().total().actuator, WithinRel(0.1 * (device.position() + 0.001), 1e-12));
}

TEST_CASE("device without a hand does not depend on how often the hand is asked",
          "[simulation][device]") {
  using pressing = sim::device<line, sim::constant_hand<line>>;
  pressing coarse{{.substeps = 1}, {.push = -1.0}};
  pressing fine{{.substeps = 50}, {.push = -1.0}};
  for (int n = 0; n < 1000; ++n) {
    coarse.exchange(n % 3 == 0 ? 1.5 : 0.8);
    fine.exchange(n % 3 == 0 ? 1.5 : 0.8);
  }
  CHECK_THAT(coarse.position(), WithinRel(fine.position(), 1e-12));
  CHECK_THAT(coarse.meter().value(), WithinRel(fine.meter().value(), 1e-11));
}

TEST_CASE("device names its first bad parameter and then does not move", "[simulation][device]") {
  using parameters = sim::device_parameters<line>;
  CHECK_FALSE(parameters{}.check());
  const std::array bad{parameters{.mass = 0.0},          parameters{.damping = -1.0},
                       parameters{.friction = infinity}, parameters{.force_limit = not_a_number},
                       parameters{.quantum = -1.0},      parameters{.lower = 1.0, .upper = -1.0},
                       parameters{.load = not_a_number}, parameters{.period = 0.0},
                       parameters{.start = infinity},    parameters{.start_velocity = infinity},
                       parameters{.substeps = 0},        parameters{.latency = 9},
                       parameters{.upper = -1.0},        parameters{.latency = -1}};
  for (const parameters& p : bad) {
    sim::device<line> device{p};
    const auto fault = device.check();
    CHECK(fault);
    CAPTURE(fault.parameter);
    CHECK_FALSE(device.exchange(1.0).valid);
    CHECK(device.time() == 0.0);
  }
  sim::device<line, sim::impedance_hand<line>> lame{{}, {.stiffness = -1.0}};
  CHECK(lame.check());
  sim::device<line> jittery;
  CHECK_FALSE(jittery.set_period(0.0));
  CHECK_FALSE(jittery.set_period(not_a_number));
  CHECK(jittery.set_period(2e-3));
  CHECK(jittery.exchange(1.0).dt == 2e-3);
  CHECK(jittery.time() == 2e-3);
  const reference moved = solve(0.1, 0.03, 1.0, 0.0, 2e-3);  // and it really moves for that long
  CHECK_THAT(jittery.position(), WithinRel(double(moved.position), 1e-14));
}

TEST_CASE("impedance_hand settles on its target and never exceeds its limit",
          "[simulation][hand]") {
  using hand = sim::impedance_hand<plane>;
  const hand strong{.stiffness = 300.0, .limit = 2.0, .target = {0.05, -0.02}};
  sim::device<plane, hand> device{{}, strong};
  for (int n = 0; n < 3000; ++n) {
    device.exchange(plane::zero());
    const auto push = device.hand().force(device.time(), device.position(), device.velocity());
    CHECK(push.norm() <= 2.0 * (1 + 1e-15));
  }
  CHECK((device.position() - plane::vector(0.05, -0.02)).norm() < 1e-9);
  CHECK(strong.force(0.0, plane::zero(), plane::zero()).norm() > 1.99);  // control: it does limit

  SECTION("its mass moves with the device") {
    sim::device<plane, hand> heavy{{.mass = 0.1},
                                   {.stiffness = 0.0, .damping = 0.0, .own_mass = 0.3}};
    heavy.exchange({1.0, 0.0});
    CHECK_THAT(heavy.velocity()(0), WithinRel(1e-3 / 0.4, 1e-3));
  }
  SECTION("a moving target is followed between the calls") {
    hand follows{.stiffness = 100.0, .damping = 0.0};
    follows.aim({0.0, 0.0}, {0.2, 0.0}, 1.0);
    CHECK_THAT(follows.force(1.5, plane::zero(), plane::zero())(0), WithinRel(10.0, 1e-14));
  }
}

TEST_CASE("tapping_hand presses outside and pulls inside", "[simulation][hand]") {
  const sim::tapping_hand<room> tapping{.surface = {0, 0, 0.01}, .normal = {0, 0, 1}, .limit = 5.0};
  CHECK_FALSE(tapping.check());
  CHECK(tapping.force(0.0, {1, 2, 0.02}, room::zero()) == room::vector(0, 0, -5));
  CHECK(tapping.force(0.0, {1, 2, 0.0}, room::zero()) == room::vector(0, 0, 5));
  CHECK(sim::tapping_hand<room>{.normal = {0, 0, 2}}.check());
}

TEST_CASE("stroke goes from start to end, and its velocity is its derivative",
          "[simulation][hand]") {
  const auto profile = GENERATE(sim::stroke_profile::even, sim::stroke_profile::minimum_jerk);
  const sim::stroke<line> stroke{
      .from = 0.1, .to = -0.3, .start = 0.5, .duration = 2.0, .profile = profile};
  CHECK(stroke.position(0.0) == 0.1);
  CHECK_THAT(stroke.position(3.0), WithinAbs(-0.3, 1e-15));
  CHECK_THAT(stroke.position(1.5), WithinAbs(-0.1, 1e-15));
  CHECK(stroke.velocity(0.4) == 0.0);
  CHECK(stroke.velocity(2.6) == 0.0);
  for (double t = 0.55; t < 2.45; t += 0.1) {
    const double slope = (stroke.position(t + 1e-6) - stroke.position(t - 1e-6)) / 2e-6;
    CHECK_THAT(stroke.velocity(t), WithinAbs(slope, 1e-8));
  }
}

TEST_CASE("prescribed_motion books exactly b Δx²/T − f·Δx", "[simulation][adversary]") {
  sim::prescribed_motion<room> motion{{.force_limit = 9.0, .latency = 1}};
  sim::random_source random{3};
  double wanted = 0.0, least = 0.0;
  room::vector queued = room::zero();
  for (int n = 0; n < 1000; ++n) {
    const room::vector step = random.direction<room>() * random.uniform(0.0, 1e-3);
    const room::vector force = random.direction<room>() * random.uniform(0.0, 9.0);
    motion.move_to(motion.position() + step);
    const room::vector held = motion.exchange(force).held;
    CHECK(held == queued);
    wanted += 0.03 * step.squaredNorm() / 1e-3 - queued.dot(step);
    least = std::min(least, wanted);
    queued = force;
  }
  CHECK_THAT(motion.meter().value(), WithinAbs(wanted, 1e-14));
  CHECK_THAT(motion.meter().minimum(), WithinAbs(least, 1e-14));
  CHECK_THAT(motion.meter().residual(0.0), WithinAbs(0.0, 1e-14));
}

TEST_CASE("nyquist_motion takes exactly (K − 2B) δ² per cycle from a spring (A5)",
          "[simulation][adversary][law]") {
  const double K = 10000.0;
  sim::prescribed_motion<line> motion;
  sim::nyquist_motion<line> nyquist{.amplitude = 1e-3};
  sim::random_source random;
  double force = 0.0;
  constexpr int cycles = 10000;
  for (int n = 0; n < 2 * cycles; ++n) {
    motion.move_to(nyquist.next({motion.position(), 1.0, -motion.position(), force}, random));
    force = K * std::max(0.0, -motion.exchange(force).position);
  }
  CHECK_THAT(motion.meter().value(), WithinRel(-cycles * (K - 60.0) * 1e-6, 1e-12));
}

namespace {

/// Least true energy of a sampled wall with a jumping surface under an adversary; with `bounded`,
/// the strict law |f| ≤ √(4 B E1).
template <class Adversary>
double least_energy(Adversary adversary, bool bounded, std::uint64_t seed) {
  sim::prescribed_motion<room> motion;
  sim::random_source random{seed};
  sim::jumping_surface surface{2e-3, seed};
  sim::switching_stiffness stiffness{2000.0, 22000.0, seed + 1};
  const room::vector normal = random.direction<room>();
  room::vector force = room::zero(), last = room::zero();
  ph::compensated_sum<double> ledger;
  for (int n = 0; n < 20000; ++n) {
    const double top = surface.offset(motion.time());
    const double seen = top - normal.dot(motion.position());
    motion.move_to(adversary.next({motion.position(), normal, seen, force}, random));
    const ph::device_sample<room> sample = motion.exchange(force);
    const room::vector x = sample.position, held = sample.held, step = x - last;
    ledger += 30.0 * step.squaredNorm() - held.dot(step);
    last = x;
    double push = stiffness.stiffness(motion.time()) * std::max(0.0, top - normal.dot(x));
    if (bounded) push = std::min(push, ph::kernels::strict_force_bound<double>(ledger, 30.0));
    force = normal * push;
  }
  CHECK_THAT(double(ledger), WithinAbs(motion.meter().value(), 1e-10));
  return motion.meter().minimum();
}

}  // namespace

TEST_CASE("adversaries empty an unbounded wall and not a strictly bounded one",
          "[simulation][adversary][law]") {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
    CAPTURE(seed);
    const sim::greedy_motion<room> greedy{};
    const sim::random_walk<room> walk{};
    const sim::nyquist_motion<room> nyquist{};
    CHECK(least_energy(greedy, false, seed) < -0.1);
    CHECK(least_energy(walk, false, seed) < -1e-3);
    CHECK(least_energy(nyquist, false, seed) < -0.1);
    CHECK(least_energy(greedy, true, seed) >= -1e-12);
    CHECK(least_energy(walk, true, seed) >= -1e-12);
    CHECK(least_energy(nyquist, true, seed) >= -1e-12);
  }
}

TEST_CASE("greedy_motion takes the Δx that L3 calls worst", "[simulation][adversary]") {
  sim::random_source random{5};
  const sim::greedy_motion<line> greedy{.speed = 1.0, .press = 0.0};
  const double slow = greedy.next({0.0, 1.0, 1e-3, 0.03}, random);
  CHECK_THAT(slow, WithinRel(0.03 / 60.0, 1e-14));  // f/(2B), within the speed limit
  const double gain = 0.03 * slow - 30.0 * slow * slow;
  CHECK_THAT(gain, WithinRel(ph::kernels::worst_outflow(0.03, 30.0), 1e-14));
  CHECK_THAT(greedy.next({0.0, 1.0, 1e-3, 5.0}, random), WithinRel(1e-3, 1e-14));
  CHECK(greedy.next({0.0, 1.0, -1.0, 0.0}, random) == -1e-3);
}

TEST_CASE("port_energy_meter keeps 1e-12 J after 1e7 bookings", "[simulation][meter]") {
  sim::port_energy_meter meter;
  double plain = 0.0;
  meter.book({.damping = 100.0});
  plain += 100.0;
  for (int n = 0; n < 10000000; ++n) {
    meter.book({.damping = 1e-10});
    plain += 1e-10;
  }
  CHECK_THAT(meter.value(), WithinAbs(100.001, 1e-13));
  CHECK(std::abs(plain - 100.001) > 1e-12);  // control: a plain sum does not
}

TEST_CASE("port_energy_meter remembers the least energy, and never hides NaN",
          "[simulation][meter]") {
  sim::port_energy_meter meter;
  meter.book({.actuator = 2.0});
  meter.book({.damping = 5.0});
  CHECK(meter.value() == 3.0);
  CHECK(meter.minimum() == -2.0);
  sim::port_energy_meter broken;
  broken.book({.damping = 1.0});
  CHECK(broken.minimum() >= -1e-12);
  broken.book({.damping = not_a_number});
  broken.book({.damping = 1.0});
  CHECK_FALSE(broken.minimum() >= -1e-12);
}

TEST_CASE("update_schedule keeps 20-50 ms, and repeats with its seed", "[simulation][schedule]") {
  sim::update_schedule schedule{42}, twin{42}, other{43};
  std::vector<double> periods;
  double last = 0.0, shortest_polled = infinity, longest_polled = 0.0;
  bool again = false, same = true, differs = false;
  for (int n = 0; n < 2000000; ++n) {
    const double time = n * 1e-3, due = schedule.next();
    const bool now = schedule.due(time);
    again = schedule.due(time) || again;
    same = now == twin.due(time) && same;
    differs = now != other.due(time) || differs;
    if (!now) continue;
    periods.push_back(schedule.next() - due);
    if (n > 0) {
      shortest_polled = std::min(shortest_polled, time - last);
      longest_polled = std::max(longest_polled, time - last);
    }
    last = time;
  }
  CHECK_FALSE(again);  // once per update
  CHECK(same);
  CHECK(differs);
  const auto [least, most] = std::minmax_element(periods.begin(), periods.end());
  CHECK(*least >= 0.020 - 1e-9);
  CHECK(*most <= 0.050 + 1e-9);
  CHECK(*least < 0.0201);
  CHECK(*most > 0.0499);
  CHECK_THAT(2000.0 / double(periods.size()), WithinRel(0.035, 0.01));
  CHECK(shortest_polled >= 0.019 - 1e-9);
  CHECK(longest_polled <= 0.051 + 1e-9);

  SECTION("equal bounds are a fixed period, and a late caller is not flooded") {
    sim::update_schedule fixed{1, 0.02, 0.02};
    CHECK(fixed.due(0.0));
    CHECK_FALSE(fixed.due(0.0199));
    CHECK(fixed.due(0.02));
    CHECK(fixed.due(1.0));
    CHECK_FALSE(fixed.due(1.01));
    CHECK_FALSE(fixed.due(not_a_number));
  }
  CHECK_FALSE(schedule.check());
  CHECK(sim::update_schedule(1, 0.0, 1.0).check());
  CHECK(sim::update_schedule(1, 0.05, 0.02).check());
}

TEST_CASE("one_update_late answers with the update before", "[simulation][schedule]") {
  sim::one_update_late<double> late{7.0};
  CHECK(late(1.0) == 7.0);
  CHECK(late(2.0) == 1.0);
}

TEST_CASE("random_source is the published splitmix64, uniform in every direction",
          "[simulation][schedule]") {
  sim::random_source known{1234567};  // reference values of the authors' C code
  CHECK(known.bits() == 6457827717110365317U);
  CHECK(known.bits() == 3203168211198807973U);
  static_assert(sim::random_source{1}.uniform() >= 0.0 && sim::random_source{1}.uniform() < 1.0);
  sim::random_source random{1};
  room::vector mean = room::zero();
  double squares = 0.0, longest_error = 0.0;
  for (int n = 0; n < 100000; ++n) {
    const room::vector u = random.direction<room>();
    longest_error = std::max(longest_error, std::abs(u.norm() - 1.0));
    mean += u / 100000.0;
    squares += u(2) * u(2) / 100000.0;
  }
  CHECK(longest_error < 1e-15);
  CHECK(mean.norm() < 0.01);
  CHECK_THAT(squares, WithinAbs(1.0 / 3.0, 0.01));
  CHECK(std::abs(random.direction<line>()) == 1.0);
}

TEST_CASE("jumping_surface and switching_stiffness change every 20-50 ms",
          "[simulation][adversary]") {
  sim::jumping_surface surface{2e-3, 9};
  sim::switching_stiffness stiffness{100.0, 5000.0, 9};
  int jumps = 0, switches = 0;
  double offset = 0.0, K = 0.0, farthest = 0.0;
  bool other = false;
  for (int n = 0; n < 100000; ++n) {
    const double next = surface.offset(n * 1e-3), next_K = stiffness.stiffness(n * 1e-3);
    farthest = std::max(farthest, std::abs(next));
    other = other || (next_K != 100.0 && next_K != 5000.0);
    jumps += next != offset ? 1 : 0;
    switches += next_K != K ? 1 : 0;
    offset = next;
    K = next_K;
  }
  CHECK(farthest <= 2e-3);
  CHECK(farthest > 1.9e-3);
  CHECK_FALSE(other);
  CHECK_THAT(100.0 / jumps, WithinRel(0.035, 0.05));
  CHECK_THAT(100.0 / switches, WithinRel(0.035, 0.05));
}

TEMPLATE_TEST_CASE("scripted_device spoils the chosen ticks and no other", "[simulation][fault]",
                   (ph::space<float, 1>), room) {
  using kind = sim::sample_fault;
  const std::array script{
      sim::scripted_fault{1, kind::nan_position}, sim::scripted_fault{2, kind::infinite_position},
      sim::scripted_fault{3, kind::zero_dt},      sim::scripted_fault{4, kind::negative_dt},
      sim::scripted_fault{5, kind::jump, 0.25},   sim::scripted_fault{6, kind::no_answer},
      sim::scripted_fault{7, kind::nan_held},     sim::scripted_fault{8, kind::nan_dt}};
  sim::device<TestType> sound;
  sim::scripted_device broken{sound, script};
  for (int n = 0; n < 12; ++n) {
    const auto good = sound.exchange(TestType::zero());
    const auto bad = broken.exchange(TestType::zero());
    const auto x = sim::component(bad.position, 0);
    CAPTURE(n);
    CHECK(std::isnan(x) == (n == 1));
    CHECK(std::isinf(x) == (n == 2));
    CHECK((bad.dt == 0) == (n == 3 || n == 6));
    CHECK((bad.dt < 0) == (n == 4));
    CHECK((std::abs(static_cast<double>(x)) > 0.2) == (n == 2 || n == 5));
    CHECK(bad.valid == (n != 6));
    CHECK(std::isnan(sim::component(bad.held, 0)) == (n == 7));
    CHECK(std::isnan(bad.dt) == (n == 8));
    CHECK(good.valid);
    CHECK(good.dt > 0);
  }
  CHECK(broken.device().position() == sound.position());
  CHECK(broken.tick() == 12);
}
