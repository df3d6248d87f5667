// SPDX-License-Identifier: BSD-3-Clause
// The step of a sensor: exact where positions have one, and never taken for exact where they have none.
#include "support/catch.hpp"
#include <passive_haptics/identification/step_finder.hpp>
#include <passive_haptics/simulation/schedule.hpp>

namespace ph = passive_haptics;
using Catch::Matchers::WithinRel;
using ph::identification::step_finder;

namespace {

/// Two seconds to and fro, then at rest.
step_finder seen(auto shown, double rounding = std::numeric_limits<double>::epsilon()) {
  step_finder steps(rounding);
  for (int n = 0; n < 2000; ++n) {
    steps.book(shown(8e-3 * std::sin(7.0 * n * 1e-3)), false, n % 100 > 20);
  }
  steps.interrupt();  // elsewhere
  for (int n = 0; n < 500; ++n) steps.book(shown(3.14159e-3), true, true);
  return steps;
}

}  // namespace

TEST_CASE("a step is found to rounding, and is no less than it is", "[identification]") {
  for (const double q : {1e-6, 17.3e-6, 100e-6}) {
    const auto steps = seen([q](double x) { return std::floor(x / q) * q; });
    CHECK(steps.has_step());
    CHECK(steps.step() >= q);
    CHECK_THAT(steps.step(), WithinRel(q, 1e-9));
    CHECK(steps.noise() == 0.0);
    const auto in_float = seen(
        [q](double x) { return static_cast<double>(static_cast<float>(std::floor(x / q) * q)); },
        static_cast<double>(std::numeric_limits<float>::epsilon()));
    CHECK(in_float.step() >= q);
    CHECK_THAT(in_float.step(), WithinRel(q, 0.01));
  }
}

TEST_CASE("what is no lattice has no step, and what it is off by is noise", "[identification]") {
  ph::simulation::random_source random(5);
  const auto noisy = seen([&](double x) { return x + 20e-6 * (random.uniform() - 0.5); });
  CHECK_FALSE(noisy.has_step());
  CHECK(noisy.step() == 0.0);
  CHECK(noisy.noise() >= 20e-6);
  CHECK(noisy.noise() < 50e-6);
  // three encoders behind a mechanism: no lattice, and up to three halves of a step either way
  const double q = 20e-6;
  const auto mixed = seen([q](double x) {
    const auto leg = [&](double share) { return std::floor(share * x / q + share) * q / share; };
    return (leg(1.0) + leg(0.731) + leg(1.317)) / 3.0;
  });
  CHECK_FALSE(mixed.has_step());
  CHECK(mixed.noise() >= (20e-6 + 20e-6 / 0.731 + 20e-6 / 1.317) / 3.0);
  CHECK(mixed.noise() < 100e-6);
}

TEST_CASE("noise on a lattice is found at rest; a position between two steps is no noise",
          "[identification]") {
  ph::simulation::random_source random(6);
  const double q = 10e-6;
  const auto flickering =
      seen([&](double x) { return std::floor((x + 60e-6 * random.uniform()) / q) * q; });
  CHECK(flickering.has_step());
  CHECK(flickering.step() + flickering.noise() >= 60e-6);
  const auto between =
      seen([&](double x) { return std::floor((x + q * random.uniform()) / q) * q; });
  CHECK(between.noise() <= q);
}

TEST_CASE("what a float rounds of a position between two steps is no noise", "[identification]") {
  ph::simulation::random_source random(7);
  const auto flickering = [&](double q, double width) {
    return seen(
        [&, q, width](double x) {
          return static_cast<double>(
              static_cast<float>(0.7 + std::floor((x + width * random.uniform()) / q) * q));
        },
        static_cast<double>(std::numeric_limits<float>::epsilon()));
  };
  for (const double q : {10e-6, 17.3e-6, 23.1e-6, 31.7e-6, 40.3e-6}) {
    CAPTURE(q);
    const auto between = flickering(q, q);
    REQUIRE(between.has_step());
    CHECK(between.step() >= q);
    CHECK(between.noise() == 0.0);
    CHECK(flickering(q, 3.0 * q).noise() > q);  // the control
  }
}
