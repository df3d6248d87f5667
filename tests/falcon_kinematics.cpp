// SPDX-License-Identifier: BSD-3-Clause
// The Falcon's kinematics and motor words: against vectors computed apart, against differences and
// against themselves. No device, no thread, no transport.

#include "support/catch.hpp"
#include "support/falcon_vectors.hpp"
#include <passive_haptics/eigen_space.hpp>
#include <passive_haptics/falcon/force.hpp>
#include <passive_haptics/simulation/schedule.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <string>

namespace ph = passive_haptics;
namespace falcon = passive_haptics::falcon;
using Catch::Matchers::WithinAbs;
using random_source = ph::simulation::random_source;

namespace {

using room = ph::space<double, 3>;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

const std::vector<falcon_vector>& vectors() {
#ifdef PASSIVE_HAPTICS_SHARED_DATA
  static const auto all = read_falcon_vectors(PASSIVE_HAPTICS_SHARED_DATA "/falcon_vectors.csv");
#else
  static const std::vector<falcon_vector> all;
#endif
  if (all.empty()) WARN("skipped: PASSIVE_HAPTICS_SHARED_DATA has no falcon_vectors.csv");
  return all;
}

template <class Triple>
double distance(const Triple& a, const Triple& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < 3; ++i) most = std::max(most, std::abs(double(a[i]) - double(b[i])));
  return most;
}

template <class Kind>
falcon::triple<double, Kind> in_double(const falcon::triple<float, Kind>& a) {
  return {{double(a[0]), double(a[1]), double(a[2])}};
}

falcon::point<double> in_workspace(random_source& random) {
  falcon::point<double> p;
  do {
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = falcon::workspace<double>.centre[i] + random.uniform(-0.04, 0.04);
    }
  } while (!falcon::workspace<double>.contains(p));
  return p;
}

template <class Triple>
Triple in_any_direction(random_source& random, double length) {
  const room::vector d = random.direction<room>() * length;
  return {{d[0], d[1], d[2]}};
}

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

/// A of the other driver: sin²θ2 stands where sinθ2 sinθ3 belongs.
falcon::matrix<double> with_wrong_column(falcon::matrix<double> A, const falcon_vector& v) {
  for (std::size_t i = 0; i < 3; ++i) A.row[i][2] *= std::sin(v.theta2[i]) / std::sin(v.theta3[i]);
  return A;
}

/// τ of the other driver: J transposed in place, so that its lower half is lost.
falcon::torques<double> with_wrong_transpose(const falcon::matrix<double>& J,
                                             const falcon::force<double>& f) {
  falcon::matrix<double> symmetric = J;
  symmetric.row[0] = {J(0, 0), J(1, 0), J(2, 0)};
  symmetric.row[1] = {J(1, 0), J(1, 1), J(2, 1)};
  symmetric.row[2] = {J(2, 0), J(2, 1), J(2, 2)};
  return falcon::multiply<falcon::torques<double>>(symmetric, f);
}

/// ½ Σ |θ̇| / k [W]: what rounding three words to whole counts can add.
double power_of_rounding(const falcon::matrix<double>& A, const falcon::velocity<double>& v,
                         double gain) {
  const auto speed = falcon::multiply<falcon::angles<double>>(A, v);
  return 0.5 * (std::abs(speed[0]) + std::abs(speed[1]) + std::abs(speed[2])) / gain;
}

double power(const falcon::torques<double>& tau, const falcon::matrix<double>& A,
             const falcon::velocity<double>& v) {
  return falcon::dot(tau, falcon::multiply<falcon::angles<double>>(A, v));
}

// The whole chain in a constant expression: counts to position and back, force to words.
constexpr auto centre = falcon::forward(falcon::to_angles<double>({-300, 200, -100}));
static_assert(centre && centre.steps <= 8);
static_assert(falcon::to_counts(falcon::inverse(centre.position).value) ==
              falcon::counts{-300, 200, -100});
static_assert(falcon::encode(falcon::torques_for(centre.rates, falcon::force<double>{{5, -2, 3}}),
                             1e4) == falcon::dac_words{-2993, 3419, -2102});
static_assert(falcon::forward(falcon::to_angles<float>({-300, 200, -100})));
static_assert(!falcon::inverse(falcon::point<double>{{0.2, 0.0, 0.1}}));

}  // namespace

TEST_CASE("the Falcon's angles, positions, torques and words are those of the vectors",
          "[falcon][vectors]") {
  double angle = 0.0, back = 0.0, place = 0.0, place_float = 0.0, torque = 0.0, printed = 0.0;
  int wrong_words = 0, refused = 0, steps = 0;
  for (const auto& v : vectors()) {
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
        CHECK_THAT(theta.value[i], WithinAbs(v.theta[i], 3e-7));  // the other driver's are floats
      }
    }
    const auto tau = falcon::torques_for(A, v.force);
    const auto words = falcon::encode(tau, 1e4);
    for (std::size_t i = 0; i < 3; ++i) wrong_words += std::lround(-1e4 * tau[i]) != v.words[i];
    if (std::all_of(v.words.begin(), v.words.end(), [](int w) { return std::abs(w) <= 4095; })) {
      for (std::size_t i = 0; i < 3; ++i) wrong_words += words[i] != v.words[i];
    }
  }
  std::cout << vectors().size() << " vectors: theta " << angle << " rad, there and back " << back
            << " rad, xyz " << place << " m (float " << place_float << "), tau " << torque
            << " N m (from printed xyz " << printed << "), at most " << steps << " steps\n";
  CHECK(refused == 0);
  CHECK(angle <= 1e-15);
  CHECK(back <= 1e-12);
  CHECK(place <= 1e-10);  // the vectors have ten decimals
  CHECK(place_float <= 2e-7);
  CHECK(torque <= 1e-10);
  CHECK(printed <= 1e-8);
  CHECK(wrong_words == 0);
}

TEST_CASE("the forces of another driver are ours with two errors in them", "[falcon][vectors]") {
  // Both errors are put in by hand: proof that the vectors judge what they should.
  int differing = 0, reproduced = 0, all = 0;
  for (const auto& v : vectors()) {
    if (!v.has_counts) continue;
    const auto pose = falcon::forward(falcon::to_angles<double>(v.counts));
    const auto J = falcon::jacobian(with_wrong_column(pose.rates, v));
    const auto tau = with_wrong_transpose(J, v.force);
    for (std::size_t i = 0; i < 3; ++i) {
      ++all;
      reproduced += std::abs(-1e4 * tau[i] - v.library_words[i]) <= 1.5;
      differing += std::abs(v.words[i] - v.library_words[i]) > 2;
    }
  }
  CHECK(reproduced == all);
  CHECK(2 * differing >= all);
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

TEST_CASE("the words give back the force commanded, within rounding", "[falcon][force]") {
  random_source random(15);
  double worst = 0.0;
  for (int n = 0; n < 20000; ++n) {
    const auto pose = falcon::forward(falcon::inverse(in_workspace(random)).value);
    const double gain = random.uniform(2500.0, 10000.0);
    const auto f = in_any_direction<falcon::force<double>>(random, random.uniform(0.0, 4.0));
    const auto words = falcon::encode(falcon::torques_for(pose.rates, f), gain);
    const auto again = falcon::force_from(pose.rates, falcon::decode(words, gain));
    double doubt = 0.0;  // half a count on each motor
    for (std::size_t i = 0; i < 3; ++i) {
      doubt += 0.5 / gain *
               std::sqrt(pose.rates(i, 0) * pose.rates(i, 0) + pose.rates(i, 1) * pose.rates(i, 1) +
                         pose.rates(i, 2) * pose.rates(i, 2));
    }
    REQUIRE(falcon::norm(again - f) <= doubt * (1 + 1e-9));
    worst = std::max(worst, falcon::norm(again - f));
  }
  std::cout << "force from rounded words: within " << worst << " N\n";
}

TEST_CASE("a force beyond the motors keeps its direction and never wraps", "[falcon][force]") {
  random_source random(16);
  for (int n = 0; n < 20000; ++n) {
    const auto pose = falcon::forward(falcon::inverse(in_workspace(random)).value);
    const auto f =
        in_any_direction<falcon::force<double>>(random, std::pow(10.0, random.uniform(2.0, 150.0)));
    const auto tau = falcon::torques_for(pose.rates, f);
    const auto words = falcon::encode(tau, 3500.0);
    int largest = 0;
    for (const int w : words) largest = std::max(largest, std::abs(w));
    REQUIRE(largest == falcon::largest_word);
    const auto given = falcon::decode(words, 3500.0);
    const double scale = falcon::norm(given) / falcon::norm(tau);
    REQUIRE(falcon::norm(given - scale * tau) <= 1.0 / 3500.0);
  }
  SECTION("in float as well") {
    const auto words = falcon::encode(falcon::torques<float>{{-3e38F, 1e38F, 2e38F}}, 3500.0F);
    CHECK(words == falcon::dac_words{4095, -1365, -2730});
  }
  SECTION("what is no number gives no force") {
    const auto A = centre.rates;
    const falcon::dac_words none{};
    for (const double bad : {not_a_number, infinity, -infinity}) {
      CHECK(falcon::encode(falcon::torques<double>{{bad, 1, 1}}, 3500.0) == none);
      CHECK(falcon::encode(falcon::torques<double>{{0.1, 0.1, 0.1}}, bad) == none);
      const auto tau = falcon::torques_for(A, falcon::force<double>{{1, bad, 1}});
      CHECK(tau == falcon::torques<double>{});
      CHECK(falcon::limited(falcon::force<double>{{1, 1, bad}}, 5.0) == falcon::force<double>{});
    }
    CHECK(falcon::encode(falcon::torques<double>{{0.1, 0.1, 0.1}}, 0.0) == none);
    CHECK(falcon::encode(falcon::torques<double>{{0.1, 0.1, 0.1}}, -3500.0) == none);
    CHECK(falcon::encode(falcon::torques<double>{{0.1, 0.1, 0.1}}, 3500.0) != none);
  }
  SECTION("a norm limit") {
    const auto f = falcon::limited(falcon::force<double>{{6e300, 0, 8e300}}, 5.0);
    CHECK_THAT(f[0], WithinAbs(3.0, 1e-14));
    CHECK_THAT(f[2], WithinAbs(4.0, 1e-14));
    CHECK(falcon::limited(falcon::force<double>{{1, 2, 2}}, 3.0) ==
          falcon::force<double>{{1, 2, 2}});
    CHECK(falcon::limited(falcon::force<double>{{1, 2, 2}}, -1.0) == falcon::force<double>{});
    CHECK(falcon::limited(falcon::force<double>{}, 1.0) == falcon::force<double>{});
  }
}

TEST_CASE("a commanded damper takes energy in every pose", "[falcon][force][law]") {
  random_source random(17);
  constexpr double gain = falcon::cautious_gain<double>;
  int fed = 0, fed_beyond_rounding = 0;
  for (int n = 0; n < 100000; ++n) {
    const auto pose = falcon::forward(falcon::inverse(in_workspace(random)).value);
    const double speed = std::pow(10.0, random.uniform(-5.0, -0.3));  // [m/s]
    const auto v = in_any_direction<falcon::velocity<double>>(random, speed);
    const double b = random.uniform(0.1, 60.0);  // [N·s/m], far into saturation
    const falcon::force<double> damper{(-b * v).value};
    const auto exact = falcon::torques_for(pose.rates, damper);
    const auto tau = falcon::decode(falcon::encode(exact, gain), gain);
    const double taken = -power(tau, pose.rates, v);
    const double doubt = power_of_rounding(pose.rates, v, gain);
    REQUIRE(power(exact, pose.rates, v) < 0.0);
    fed += taken < 0.0;
    fed_beyond_rounding += taken < -doubt * (1 + 1e-9);
  }
  CHECK(fed > 0);  // slow enough, half a count is more than the damper
  std::cout << "damper: fed by rounding " << fed << " of 100000, beyond rounding "
            << fed_beyond_rounding << "\n";
  CHECK(fed_beyond_rounding == 0);

  // The control: a map with the other driver's errors does feed the hand.
  int control = 0, poses = 0;
  for (const auto& vector : vectors()) {
    if (!vector.has_counts) continue;
    const auto pose = falcon::forward(falcon::to_angles<double>(vector.counts));
    const auto J = falcon::jacobian(with_wrong_column(pose.rates, vector));
    bool feeds = false;
    for (int n = 0; n < 200; ++n) {
      const auto v = in_any_direction<falcon::velocity<double>>(random, 1.0);
      const auto tau = with_wrong_transpose(J, falcon::force<double>{(-1.0 * v).value});
      feeds = feeds || power(tau, pose.rates, v) > 0.0;
    }
    control += feeds;
    ++poses;
  }
  std::cout << "damper of another driver feeds the hand in " << control << " of " << poses
            << " poses\n";
  if (poses > 0) CHECK(control > 0);
}

TEST_CASE("force_over does the motors' work over the tick", "[falcon][force]") {
  random_source random(18);
  double plain = 0.0;
  for (int n = 0; n < 10000; ++n) {
    const auto here = in_workspace(random);
    const auto there = here + in_any_direction<falcon::point<double>>(random, 1e-3);
    const auto before = falcon::inverse(here).value;
    const auto after = falcon::inverse(there).value;
    const auto A = falcon::rates(there, after);
    const auto tau = falcon::torques_for(A, in_any_direction<falcon::force<double>>(random, 5.0));
    const auto f = falcon::force_from(A, tau);
    const double work = falcon::dot(tau, after - before);
    const auto over = falcon::force_over(f, tau, after - before, there - here);
    REQUIRE_THAT(falcon::dot(over, there - here), WithinAbs(work, 1e-15));
    REQUIRE(falcon::norm(over - f) <= 0.2);
    plain = std::max(plain, std::abs(falcon::dot(f, there - here) - work));
  }
  std::cout << "work of a pose's force over 1 mm is wrong by up to " << plain << " J\n";
  CHECK(plain > 1e-6);  // the control: without it the ledger would not close
  const falcon::force<double> f{{1, 2, 3}};
  CHECK(falcon::force_over(f, falcon::torques<double>{{1, 1, 1}}, falcon::angles<double>{},
                           falcon::point<double>{}) == f);
}

TEST_CASE("counts and angles belong together", "[falcon]") {
  for (int n = -3000; n <= 3000; ++n) {
    REQUIRE(falcon::to_counts(falcon::to_angles<double>({n, -n, 0})) == falcon::counts{n, -n, 0});
    REQUIRE(falcon::to_counts(falcon::to_angles<float>({n, -n, 0})) == falcon::counts{n, -n, 0});
  }
}
