// SPDX-License-Identifier: BSD-3-Clause
// The mock Falcon's arms: their poses, their steps, their energy.
#include "support/catch.hpp"
#include "support/falcon_loop.hpp"
#include <passive_haptics/simulation/schedule.hpp>

#include <cmath>
#include <iostream>
#include <string>

namespace {

using sim::random_source;

static_assert(falcon::mock_body<sim::device<d3>>);
static_assert(!falcon::mock_body<sim::device<ph::space<double, 1>>>);  // it has one axis

constexpr mock_parameters ready{.runs = true, .homed = true};

falcon::leg_words random_words(random_source& random) {
  falcon::leg_words words{};
  for (auto& word : words) word = static_cast<std::int16_t>(random.uniform(-4095, 4095));
  return words;
}

}  // namespace

TEST_CASE("every pose that the mock's arms can take is a good one", "[falcon][mock]") {
  const mock_parameters mock;
  CHECK_FALSE(mock.check());
  double worst = 0.0, steep = 0.0;
  const auto& [low, high] = std::pair(d3::vector(mock.body.lower), d3::vector(mock.body.upper));
  for (int i = 0; i <= 20; ++i) {
    for (int j = 0; j <= 20; ++j) {
      for (int k = 0; k <= 20; ++k) {
        const d3::vector part = d3::vector(i, j, k) / 20.0;
        const d3::vector p = low + part.cwiseProduct(high - low);
        const falcon::point<double> exact{{p[0], p[1], p[2]}};
        const auto theta = falcon::inverse(exact);
        REQUIRE(theta);
        const auto pose =
            falcon::forward(falcon::to_angles<double>(falcon::to_counts(theta.value)));
        REQUIRE(pose);
        worst = std::max(worst, falcon::norm(pose.position - exact));
        steep = std::max(steep, pose.condition);
      }
    }
  }
  std::cout << "mock's box: counts show the grip to " << worst << " m, cond (Frobenius) " << steep
            << '\n';
  CHECK(worst < 2e-4);
}

TEST_CASE("one count of every leg is less than the quantum that the ledger is told",
          "[falcon][mock]") {
  double most = 0.0;
  const auto& ball = falcon::workspace<double>;
  for (double x = -0.04; x <= 0.04; x += 0.002) {
    for (double y = -0.04; y <= 0.04; y += 0.002) {
      for (double z = -0.04; z <= 0.04; z += 0.002) {
        const auto p = ball.centre + falcon::point<double>{{x, y, z}};
        if (!ball.contains(p)) continue;
        const auto J = falcon::jacobian(falcon::rates(p, falcon::inverse(p).value));
        for (const auto& row : J.row) {
          const double sum = std::abs(row[0]) + std::abs(row[1]) + std::abs(row[2]);
          most = std::max(most, sum * falcon::angle_per_count<double>);
        }
      }
    }
  }
  std::cout << "one count of every leg moves the grip by up to " << most << " m along an axis\n";
  CHECK(most <= falcon_quantum);
  CHECK(most > 0.99 * falcon_quantum);
}

TEST_CASE("the mock's energy meter books what its motors do", "[falcon][mock]") {
  random_source random(21);
  double worst = 0.0, work = 0.0;
  for (int run = 0; run < 10; ++run) {
    mock_parameters setup = ready;
    setup.body.start = {0.001 * run, -0.002 * run, 0.125};
    setup.body.friction = run % 2 == 0 ? 0.0 : 0.2;
    mock_falcon<sim::impedance_hand<d3>>::mechanism_type arms(
        setup, sim::impedance_hand<d3>{.stiffness = 400.0, .damping = 3.0, .target = {0, 0, 0.12}});
    for (int n = 0; n < 500; ++n) {
      if (n % 7 == 0) arms.hold(random_words(random));
      arms.elapse(random.uniform(1e-4, 2e-3));
    }
    worst = std::max(worst, std::abs(arms.motor_work() - arms.body().meter().total().actuator));
    work += std::abs(arms.motor_work());
    CHECK(std::abs(arms.body().residual()) < 1e-12);
  }
  std::cout << "motors' work against the meter: " << worst << " J of " << work << " J\n";
  CHECK(worst < 1e-12);
  CHECK(work > 0.1);
}

TEST_CASE("a bad parameter of the mock is named", "[falcon][mock]") {
  CHECK(std::string(mock_parameters{.gain = 0.0}.check().parameter) == "gain");
  CHECK(std::string(mock_parameters{.out_angle = -1.0}.check().parameter) == "out_angle");
}
