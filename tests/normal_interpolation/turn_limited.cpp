// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"

#include <random>

using Catch::Matchers::WithinAbs;

namespace {

template <class Space>
typename Space::vector unit(const typename Space::vector& v) {
  return v / v.norm();
}

/// The angle without acos near 0 or π: 2 atan2(|a − b|, |a + b|).
template <class Vector>
auto angle_between(const Vector& a, const Vector& b) {
  return 2 * std::atan2((a - b).norm(), (a + b).norm());
}

}  // namespace

TEST_CASE("turn_limited is Rodrigues' rotation of the thesis (2.28-2.32)", "[normal]") {
  std::mt19937 seed(7);
  std::normal_distribution<double> gauss;
  const ph::turn_limited::on<d3> limit({.rate = 4.0});
  for (int i = 0; i < 1000; ++i) {
    const d3::vector from = unit<d3>(d3::vector(gauss(seed), gauss(seed), gauss(seed)));
    const d3::vector to = unit<d3>(d3::vector(gauss(seed), gauss(seed), gauss(seed)));
    const double theta = std::acos(std::min(1.0, std::max(-1.0, from.dot(to))));
    if (theta < 0.01 || theta > 3.1) continue;
    const d3::vector mu = unit<d3>(d3::cross(from, to));
    const d3::vector thesis = std::cos(4e-3) * from + std::sin(4e-3) * d3::cross(mu, from);
    const d3::vector ours = limit.step(from, to, 1e-3);
    CHECK((ours - thesis).norm() < 1e-8);  // φ³/12 = 5e-9
    CHECK(angle_between(ours, from) <= 4e-3 + 1e-15);
    CHECK(angle_between(ours, to) < theta);
  }
}

TEMPLATE_TEST_CASE("turn_limited reaches any normal from any other, antiparallel included (A19)",
                   "[normal]", d2, f2, d3, f3) {
  using scalar = typename TestType::scalar;
  using vector = typename TestType::vector;
  const ph::turn_limited::on<TestType> limit({.rate = 4.0});
  const scalar dt = scalar(0.001);
  vector start = TestType::zero();
  start(0) = scalar(1);
  const scalar tiny = std::numeric_limits<scalar>::epsilon();
  std::vector<vector> targets{vector(-start)};
  for (const scalar off : {tiny / 4, tiny, 16 * tiny, scalar(1e-4), scalar(2e-3)}) {
    for (const scalar side : {scalar(-1), scalar(1)}) {
      vector nearly = -start;
      nearly(1) = off * side;
      targets.push_back(unit<TestType>(nearly));
      nearly = start;
      nearly(1) = off * side;
      targets.push_back(unit<TestType>(nearly));
    }
  }
  for (const vector& target : targets) {
    vector now = start;
    const auto whole = static_cast<double>(angle_between(start, target));
    const int least = static_cast<int>(std::ceil(whole / 4e-3 - 1e-3));
    int ticks = 0;
    while (now != target && ticks < 2000) {
      const vector next = limit.step(now, target, dt);
      REQUIRE(next.allFinite());
      REQUIRE_THAT(static_cast<double>(next.norm()),
                   WithinAbs(1.0, 8.0 * static_cast<double>(tiny)));
      REQUIRE(angle_between(next, now) <= scalar(4) * dt * (1 + 16 * tiny) + tiny);
      now = next;
      ++ticks;
    }
    CHECK(now == target);
    CHECK(ticks >= least);
    CHECK(ticks <= least + 3);
  }
}

TEST_CASE("acos of the thesis fails where turn_limited does not (A19)", "[normal]") {
  const double dot = 1.0 + 2.3e-16;  // what n·n of a unit vector can round to
  REQUIRE(dot > 1.0);
  CHECK(std::isnan(std::acos(dot)));
  const d3::vector n(0, 0, 1);
  CHECK(ph::turn_limited::on<d3>({.rate = 4}).step(n, n, 1e-3) == n);
}

TEST_CASE("turn_limited turns by rate times dt, so a tick of 4 ms turns four times as far (A20)",
          "[normal]") {
  const d3::vector from(0, 0, 1), to(1, 0, 0);
  const ph::turn_limited::on<d3> limit({.rate = 2.0});
  const double one = angle_between(limit.step(from, to, 1e-3), from);
  const double four = angle_between(limit.step(from, to, 4e-3), from);
  CHECK_THAT(four / one, WithinAbs(4.0, 1e-4));
  CHECK_THAT(one, WithinAbs(2e-3, 1e-9));
}

TEST_CASE("turn_limited refuses a rate it cannot keep", "[normal]") {
  CHECK_FALSE(ph::turn_limited{.rate = 1}.check());
  for (const double rate : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    const auto fault = ph::turn_limited{.rate = rate}.check();
    REQUIRE(fault);
    CHECK(std::string(fault.parameter) == "rate");
  }
}

TEMPLATE_TEST_CASE("however fast a normal may turn, and however long a tick is, it stays a normal",
                   "[normal][fault]", d2, f2, d3, f3) {
  using scalar = typename TestType::scalar;
  using vector = typename TestType::vector;
  vector from = TestType::zero(), to = TestType::zero();
  from(0) = to(1) = scalar(1);
  const vector opposite = vector(-from);
  for (const double rate : {2.0, 1e9, 1e30, 1e100, 1e160, 1.7e308}) {
    for (const double dt : {1e-3, 1.0, 1e30, 1e160}) {
      CAPTURE(rate, dt);
      const ph::turn_limited::on<TestType> limit({.rate = rate});
      const scalar T = ph::detail::number<scalar>(dt);
      CHECK_THAT(double(limit.step(from, to, T).norm()), WithinAbs(1.0, 1e-6));
      CHECK_THAT(double(limit.step(from, opposite, T).norm()), WithinAbs(1.0, 1e-6));
      if (rate * dt > 10.0) CHECK(limit.step(from, to, T) == to);
    }
  }
}
