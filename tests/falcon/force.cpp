// SPDX-License-Identifier: BSD-3-Clause
// From a force to motor words and back; and what another driver makes of the same force.
#include "falcon/poses.hpp"

#include <iostream>

using Catch::Matchers::WithinAbs;

namespace {

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

// Force to words in a constant expression.
constexpr auto centre = falcon::forward(falcon::to_angles<double>({-300, 200, -100}));
static_assert(falcon::encode(falcon::torques_for(centre.rates, falcon::force<double>{{5, -2, 3}}),
                             1e4) == falcon::dac_words{-2993, 3419, -2102});

}  // namespace

TEST_CASE("the forces of another driver are ours with two errors in them", "[falcon][vectors]") {
  // Both errors are put in by hand: proof that the vectors judge what they should.
  int differing = 0, reproduced = 0, all = 0;
  for (const auto& v : falcon_vectors()) {
    if (!v.has_counts) continue;
    const auto pose = falcon::forward(falcon::to_angles<double>(v.counts));
    const auto J = falcon::jacobian(with_wrong_column(pose.rates, v));
    const auto tau = with_wrong_transpose(J, v.force);
    for (std::size_t i = 0; i < 3; ++i) {
      ++all;
      reproduced += std::abs(-1e4 * tau[i] - v.other_words[i]) <= 1.5;
      differing += std::abs(v.words[i] - v.other_words[i]) > 2;
    }
  }
  CHECK(reproduced == all);
  CHECK(2 * differing >= all);
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
  for (const auto& vector : falcon_vectors()) {
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
  CHECK(control > 0);
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
