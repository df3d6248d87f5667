// SPDX-License-Identifier: BSD-3-Clause
// The Falcon's kinematics: against vectors computed apart, against differences and against
// themselves. No device, no thread, no transport.
#include "falcon/poses.hpp"

#include <iostream>
#include <string>

using Catch::Matchers::WithinAbs;

namespace {

/// The ratio of the largest to the smallest singular value.
double condition_of(const falcon::matrix<double>& A) {
  Eigen::Matrix3d m;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) m(i, j) = A(std::size_t(i), std::size_t(j));
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> square(m.transpose() * m,
                                                              Eigen::EigenvaluesOnly);
  return std::sqrt(square.eigenvalues()[2] / square.eigenvalues()[0]);
}

// The whole chain in a constant expression: counts to position and back.
constexpr auto centre = falcon::forward(falcon::to_angles<double>({-300, 200, -100}));
static_assert(centre && centre.steps <= 8);
static_assert(falcon::to_counts(falcon::inverse(centre.position).value) ==
              falcon::counts{-300, 200, -100});
static_assert(falcon::forward(falcon::to_angles<float>({-300, 200, -100})));
static_assert(!falcon::inverse(falcon::point<double>{{0.2, 0.0, 0.1}}));

}  // namespace

TEST_CASE("the Falcon's angles, positions, torques and words are those of the vectors",
          "[falcon][vectors]") {
  double angle = 0.0, back = 0.0, place = 0.0, place_float = 0.0, torque = 0.0, printed = 0.0;
  int wrong_words = 0, refused = 0, steps = 0;
  for (const auto& v : falcon_vectors()) {
    falcon::matrix<double> A;
    if (v.has_counts) {
      const auto theta = falcon::to_angles<double>(v.counts);
      for (std::size_t i = 0; i < 3; ++i) {
        const long double formula = (35 + 5.13L / 140.8L * v.counts[i]) * std::acos(-1.0L) / 180;
        angle = std::max(angle, double(std::abs(formula - static_cast<long double>(theta[i]))));
      }
      const auto pose = falcon::forward(theta);
      const auto pose_float = falcon::forward(falcon::to_angles<float>(v.counts));
      refused += !pose + !pose_float;
      place = std::max(place, distance(pose.position, v.position));
      place_float = std::max(place_float, distance(in_double(pose_float.position), v.position));
      back = std::max(back, distance(falcon::inverse(pose.position).value, theta));
      steps = std::max(steps, pose.steps);
      A = pose.rates;
      const auto tau = falcon::torques_for(A, v.force);
      torque = std::max(torque, distance(tau, v.torque));
    } else {
      const auto theta = falcon::inverse(v.position);
      refused += !theta;
      A = falcon::rates(v.position, theta.value);
      printed = std::max(printed, distance(falcon::torques_for(A, v.force), v.torque));
      for (std::size_t i = 0; i < 3; ++i) {
        CHECK_THAT(theta.value[i], WithinAbs(v.theta[i], 1e-11));  // theirs have twelve decimals
      }
    }
    const auto tau = falcon::torques_for(A, v.force);
    const auto words = falcon::encode(tau, 1e4);
    for (std::size_t i = 0; i < 3; ++i) wrong_words += std::lround(-1e4 * tau[i]) != v.words[i];
    if (std::all_of(v.words.begin(), v.words.end(), [](int w) { return std::abs(w) <= 4095; })) {
      for (std::size_t i = 0; i < 3; ++i) wrong_words += words[i] != v.words[i];
    }
  }
  std::cout << falcon_vectors().size() << " vectors: theta " << angle << " rad, there and back "
            << back << " rad, xyz " << place << " m (float " << place_float << "), tau " << torque
            << " N m (from printed xyz " << printed << "), at most " << steps << " steps\n";
  CHECK(refused == 0);
  CHECK(angle <= 1e-15);
  CHECK(back <= 1e-12);
  CHECK(place <= 1e-11);  // the vectors have twelve decimals
  CHECK(place_float <= 2e-7);
  CHECK(torque <= 1e-11);
  CHECK(printed <= 1e-9);
  CHECK(wrong_words == 0);
}

TEST_CASE("the Falcon's Jacobian is the derivative of its position", "[falcon]") {
  random_source random(11);
  double worst = 0.0;
  constexpr double h = 2e-5;  // [rad]
  for (int n = 0; n < 1000; ++n) {
    const auto theta = falcon::inverse(in_workspace(random)).value;
    const auto pose = falcon::forward(theta);
    const auto J = falcon::jacobian(pose.rates);
    for (std::size_t j = 0; j < 3; ++j) {
      auto more = theta, less = theta;
      more[j] += h;
      less[j] -= h;
      const auto difference = falcon::forward(more, pose.position).position -
                              falcon::forward(less, pose.position).position;
      for (std::size_t i = 0; i < 3; ++i) {
        worst = std::max(worst, std::abs(difference[i] / (2 * h) - J(i, j)));
      }
    }
  }
  std::cout << "Jacobian against central differences: " << worst << " m\n";
  CHECK(worst <= 1e-7);
}

TEMPLATE_TEST_CASE("forward undoes inverse all over the workspace", "[falcon]", float, double) {
  random_source random(12);
  double worst = 0.0, condition = 0.0, frobenius = 0.0, low = 1e9, high = -1e9;
  int refused = 0, steps = 0;
  for (int n = 0; n < 100000; ++n) {
    const auto exact = in_workspace(random);
    const falcon::point<TestType> p{{TestType(exact[0]), TestType(exact[1]), TestType(exact[2])}};
    const auto theta = falcon::inverse(p);
    const auto pose = falcon::forward(theta.value);
    refused += !theta + !pose;
    worst = std::max(worst, distance(pose.position, p));
    steps = std::max(steps, pose.steps);
    frobenius = std::max(frobenius, double(pose.condition));
    for (const auto t : theta.value.value) {
      low = std::min(low, double(t));
      high = std::max(high, double(t));
    }
    if constexpr (std::is_same_v<TestType, double>) {
      condition = std::max(condition, condition_of(pose.rates));
    }
  }
  std::cout << "100000 points: worst " << worst << " m, theta " << low << " to " << high
            << " rad, at most " << steps << " steps, cond (Frobenius) " << frobenius;
  if (condition > 0.0) std::cout << ", cond " << condition;
  std::cout << '\n';
  CHECK(refused == 0);
  CHECK(worst <= (std::is_same_v<TestType, double> ? 1e-14 : 5e-7));
  CHECK(condition < 3.1);
  CHECK(low > -0.31);
  CHECK(high < 1.19);
}

TEST_CASE("a warm start needs three steps", "[falcon]") {
  random_source random(13);
  for (int n = 0; n < 1000; ++n) {
    const auto p = in_workspace(random);
    const auto next = p + in_any_direction<falcon::point<double>>(random, 3e-4);
    const auto pose = falcon::forward(falcon::inverse(next).value, p);
    CHECK(pose.steps <= 3);
    CHECK(distance(pose.position, next) <= 1e-14);
  }
}

TEST_CASE("forward answers rightly or with a fault, whatever the counts", "[falcon][faults]") {
  random_source random(14);
  int solved = 0, refused = 0;
  const auto try_angles = [&](const falcon::angles<double>& theta,
                              const falcon::point<double>& start) {
    const auto pose = falcon::forward(theta, start);
    REQUIRE(falcon::is_finite(pose.position));
    if (!pose) {
      ++refused;
      return;
    }
    ++solved;
    const auto back = falcon::inverse(pose.position);
    REQUIRE(back);
    for (std::size_t i = 0; i < 3; ++i) {
      REQUIRE(std::abs(std::remainder(back.value[i] - theta[i], 2 * falcon::pi<double>)) < 1e-9);
    }
    REQUIRE(pose.condition <= falcon::largest_condition<double>);
    const auto A = falcon::rates(pose.position, theta);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        REQUIRE_THAT(A(i, j), WithinAbs(pose.rates(i, j), 1e-8 * falcon::frobenius_norm(A)));
      }
    }
  };
  for (int n = 0; n < 50000; ++n) {
    falcon::counts wild{}, likely{};
    for (std::size_t i = 0; i < 3; ++i) {
      wild[i] = static_cast<int>(random.uniform(-32768, 32768));
      likely[i] = static_cast<int>(random.uniform(-2500, 2000));
    }
    const auto start = in_any_direction<falcon::point<double>>(random, random.uniform(0.0, 0.3));
    try_angles(falcon::to_angles<double>(wild), start);
    try_angles(falcon::to_angles<double>(likely), start);
    try_angles(falcon::to_angles<double>(likely), falcon::workspace<double>.centre);
  }
  std::cout << "wild counts: " << solved << " solved, " << refused << " refused\n";
  CHECK(solved > 10000);
  CHECK(refused > 10000);

  CHECK(falcon::forward(falcon::angles<double>{{not_a_number, 0, 0}}).fault ==
        falcon::pose_fault::not_finite);
  CHECK(falcon::forward(falcon::angles<double>{{0, infinity, 0}}).fault ==
        falcon::pose_fault::not_finite);
  const auto home = falcon::to_angles<double>({0, 0, 0});
  CHECK(falcon::forward(home, falcon::point<double>{{not_a_number, 0, infinity}}));
  CHECK(falcon::forward(home, falcon::point<double>{{1e200, 0, -1e200}}));
}

TEST_CASE("inverse names what it cannot reach", "[falcon][faults]") {
  CHECK(falcon::inverse(falcon::point<double>{{not_a_number, 0, 0.1}}).fault ==
        falcon::pose_fault::not_finite);
  CHECK(falcon::inverse(falcon::point<double>{{0, 0, 0.3}}).fault ==
        falcon::pose_fault::out_of_reach);
  CHECK(falcon::inverse(falcon::point<double>{{0.2, 0, 0.1}}).fault ==
        falcon::pose_fault::out_of_reach);
  CHECK(falcon::inverse(falcon::point<double>{{1e300, -1e300, 1e300}}).fault ==
        falcon::pose_fault::out_of_reach);
  CHECK(std::string(to_string(falcon::pose_fault::out_of_reach)) == "out of reach");
}

TEST_CASE("counts and angles belong together", "[falcon]") {
  for (int n = -3000; n <= 3000; ++n) {
    REQUIRE(falcon::to_counts(falcon::to_angles<double>({n, -n, 0})) == falcon::counts{n, -n, 0});
    REQUIRE(falcon::to_counts(falcon::to_angles<float>({n, -n, 0})) == falcon::counts{n, -n, 0});
  }
}
