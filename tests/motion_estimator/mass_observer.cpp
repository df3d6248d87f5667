// SPDX-License-Identifier: BSD-3-Clause
// A motion estimator against the simulated device, which knows the truth.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/simulation/device.hpp>

#include <numbers>

namespace sim = ph::simulation;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

static_assert(ph::motion_estimator_for<ph::mass_observer, d1>);
static_assert(!ph::motion_estimator_for<ph::reduced_energy, d1>);  // which observes energy

namespace {

/// A hand that presses 0 to 5 N three times a second and changes its mind by 1 N now and then.
struct busy_hand {
  [[nodiscard]] double force(double t, double /*x*/, double /*v*/) const noexcept {
    const double step = std::fmod(t, 1.0) < 0.5 ? 0.5 : 1.5;
    return 2.5 * (1.0 - std::cos(2.0 * std::numbers::pi * 3.0 * t)) + step;
  }
  [[nodiscard]] double mass() const noexcept { return 0.0; }
  [[nodiscard]] ph::parameter_fault check() const noexcept { return {}; }
};

/// Root mean square error of the speed [m/s] while the hand presses into a spring of 10 kN/m.
template <class Motion>
double speed_error(const Motion& parameters, double quantum, double friction) {
  ph::part_at<Motion, d1> motion(parameters);
  sim::device<d1, busy_hand> device(
      {.friction = friction, .force_limit = 20, .quantum = quantum, .start = 1e-4});
  auto sample = device.exchange(0.0);
  double last = sample.position, square = 0.0;
  bool known = false;
  for (int n = 0; n < 4000; ++n) {
    const double moved = sample.position - last;
    last = sample.position;
    const double v = motion.estimate(sample.position, moved, sample.held, 1e-3, known).along(1.0);
    known = true;
    if (n >= 500) square += (v - device.velocity()) * (v - device.velocity()) / 3500;
    const double x = device.position();
    const double B = 50.0 * std::min(0.0, device.velocity());
    sample = device.exchange(std::min(0.0, -1e4 * x - B));
  }
  return std::sqrt(square);
}

}  // namespace

TEST_CASE("mass_observer stays within the step shown, in free flight as in a press", "[motion]") {
  for (const double quantum : {0.0, 1e-5, 6e-5}) {
    ph::mass_observer::on<d1> observer({.mass = 0.13, .quantum = quantum});
    sim::device<d1, busy_hand> device({.quantum = quantum, .start = -0.003});
    auto sample = device.exchange(0.0);
    for (int n = 0; n < 3000; ++n) {
      const double x = observer.estimate(sample.position, 0.0, sample.held, 1e-3, n > 0).position;
      REQUIRE(x >= sample.position);
      REQUIRE(x <= sample.position + quantum);
      sample = device.exchange(std::min(0.0, -1e4 * x));
    }
  }
}

TEST_CASE("mass_observer finds speed and outside force of a falling mass between the steps",
          "[motion]") {
  const double q = 6e-5;
  ph::mass_observer::on<d3> observer({.mass = 0.1, .quantum = q});
  sim::device<d3> device({.quantum = q, .load = {0.3, -0.981, 0.0}});
  auto sample = device.exchange(d3::zero());
  CHECK(observer.position() == d3::zero());
  for (int n = 0; n < 400; ++n) {
    const auto seen = observer.estimate(sample.position, d3::zero(), sample.held, 1e-3, n > 0);
    CHECK(observer.position() == seen.position);
    CHECK(seen.along(d3::vector(0.6, 0.0, 0.8)) ==
          d3::dot(seen.velocity, d3::vector(0.6, 0.0, 0.8)));
    if (n > 200) {
      const d3::vector error = seen.velocity - device.velocity();
      REQUIRE(error.norm() < 0.02);  // one step in one tick would be 0.06 m/s
    }
    sample = device.exchange(d3::zero());
  }
  // what pushes besides the motors is what changes the speed inside a step, where nothing corrects it
  const auto now = observer.estimate(sample.position, d3::zero(), sample.held, 1e-3, true);
  const d3::vector middle = now.position - d3::vector::Constant(q / 2);
  const auto then = observer.estimate(middle, d3::zero(), d3::zero(), 1e-9, true);
  CHECK_THAT((then.velocity[1] - now.velocity[1]) / 1e-9, WithinAbs(-9.81, 1.0));
}

TEST_CASE(
    "mass_observer corrects speed by 1/64 and outside force by 1/(8 · 64²) of what it was off",
    "[motion]") {
  const double q = 8e-5, dt = 1e-3;
  ph::mass_observer::on<d1> observer({.mass = 0.1, .quantum = q});
  (void)observer.estimate(0.0, 0.0, 0.0, dt, false);
  const auto off = observer.estimate(q, 0.0, 0.0, dt, true);  // by q/2, from the middle of a step
  CHECK(off.position == q);
  const double c = q / 2, w = c / (8 * 64 * 64 * dt * dt);
  CHECK_THAT(off.velocity, WithinRel(c / (64 * dt), 1e-12));
  const auto next = observer.estimate(q, 0.0, 0.0, dt, true);  // within the step: nothing is off
  CHECK_THAT(next.velocity, WithinRel(off.velocity + w * dt, 1e-12));
  CHECK_THAT(next.position, WithinRel(q + (off.velocity + w * dt / 2) * dt, 1e-12));
}

TEST_CASE("mass_observer believes a motion of more than 4/3 of a step", "[motion]") {
  const double q = 8e-5, dt = 1e-3;
  ph::mass_observer::on<d1> observer({.mass = 0.1, .quantum = q});
  (void)observer.estimate(0.0, 0.0, 0.0, dt, false);
  const auto doubted = observer.estimate(1.8 * q, 0.0, 0.0, dt, true);  // by 1.3 q
  CHECK_THAT(doubted.velocity, WithinRel(1.3 * q / (64 * dt), 1e-9));
  (void)observer.estimate(0.0, 0.0, 0.0, dt, false);
  const auto seen = observer.estimate(1.9 * q, 0.0, 0.0, dt, true);  // by 1.4 q, in one tick
  CHECK_THAT(seen.velocity, WithinRel(1.4 * q * (1 + 1.0 / 64) / dt, 1e-9));
  const auto next = observer.estimate(1.9 * q + seen.velocity * dt, 0.0, 0.0, dt, true);
  const double w = 1.4 * q * (0.5 + 1.0 / (8 * 64 * 64)) / (dt * dt);
  CHECK_THAT(next.velocity, WithinRel(seen.velocity + w * dt, 1e-9));
}

TEST_CASE("mass_observer takes just 4/3 of a step for none, and counts the time before, either way",
          "[motion]") {
  constexpr double third = 0x1p-14, q = 3 * third, dt = 0x1p-10;  // so that sums are exact
  const auto after = [](int ticks, double way) {
    ph::mass_observer::on<d1> observer({.mass = 0.1, .quantum = q});
    (void)observer.estimate(0.0, 0.0, 0.0, dt, false);
    for (int n = 0; n < ticks; ++n) (void)observer.estimate(0.0, 0.0, 0.0, dt, true);
    return observer.estimate(way, 0.0, 0.0, dt, true).velocity;
  };
  for (const double sign : {1.0, -1.0}) {  // from the middle to the nearer end of the new step
    for (const int ticks : {0, 1, 10}) {
      const double tie = 4 * third, more = 4.25 * third;
      CHECK_THAT(after(ticks, sign * (tie + q / 2)), WithinRel(sign * tie / (64 * dt), 1e-12));
      CHECK_THAT(after(ticks, sign * (more + q / 2)),
                 WithinRel(sign * more * (1.0 / 64 + 1.0 / (ticks + 1)) / dt, 1e-12));
    }
  }
}

TEST_CASE("mass_observer follows a busy hand, at the price of half as much error again",
          "[motion]") {
  const double q = 6e-5;  // 60 mm/s, if one step shows in one tick
  for (const double friction : {0.0, 0.2}) {
    const double plain = speed_error(ph::last_difference{}, q, friction);
    for (const double mass : {0.08, 0.1, 0.125}) {
      const double error = speed_error(ph::mass_observer{.mass = mass, .quantum = q}, q, friction);
      UNSCOPED_INFO(friction << " N, " << mass << " kg: " << error << " against " << plain);
      CHECK(error < 1.6 * plain);
      CHECK(error < 0.025);
    }
  }
}

TEST_CASE("mass_observer keeps a speed and a push that are numbers, however far apart they are",
          "[motion]") {
  // Without steps all of a motion is off, which is believed at once: v loses v + a dt/2, and w half of that over dt,
  // and both are corrected besides.
  const double F = 1.75e308;
  double v = 0.0, w = 0.0;
  const auto pushed = [&](double dt) {
    const double a = F + w, off = -(v + a * dt / 2);
    v += a * dt + off * (1 + 1.0 / 64);
    w += off * (0.5 + 1.0 / (8 * 64 * 64)) / dt;
    return v;
  };
  const double after_one = pushed(1.0), after_two = pushed(0.5);
  REQUIRE(std::isfinite(v + w));
  REQUIRE(!std::isfinite(v - w));
  for (const double sign : {1.0, -1.0}) {
    ph::mass_observer::on<d1> observer({.mass = 1.0});
    (void)observer.estimate(0.0, 0.0, 0.0, 1.0, false);
    const auto seen = [&](double dt) {
      return observer.estimate(0.0, 0.0, sign * F, dt, true).velocity;
    };
    CHECK_THAT(seen(1.0), WithinRel(sign * after_one, 1e-12));
    CHECK_THAT(seen(0.5), WithinRel(sign * after_two, 1e-12));
  }
}

TEST_CASE("mass_observer starts anew after lost samples and absurd forces", "[motion]") {
  ph::mass_observer::on<f1> observer({.mass = 0.1, .quantum = 1e-5});
  (void)observer.estimate(0.0F, 0.0F, 0.0F, 1e-3F, false);
  CHECK(observer.estimate(0.01F, 0.0F, 0.0F, 1e-3F, true).velocity > 1.0F);
  CHECK(observer.estimate(0.02F, 0.0F, 0.0F, 1e-3F, false).velocity == 0.0F);
  for (const float force : {1e38F, -1e38F, 3e38F}) {
    const auto seen = observer.estimate(0.02F, 0.0F, force, 1e-3F, true);
    CHECK(seen.velocity == 0.0F);
    CHECK(seen.position == 0.02F + 0.5e-5F);  // the middle of the step
  }
  CHECK(std::string(ph::mass_observer{}.check().parameter) == "mass");
  CHECK(std::string(ph::mass_observer{.mass = 1.0, .quantum = -1.0}.check().parameter) ==
        "quantum");
}
