// SPDX-License-Identifier: BSD-3-Clause
// What is foreseen of news, and what is not.
#include "support/catch.hpp"
#include <passive_haptics/base/foresight.hpp>

#include <cmath>
#include <limits>
#include <random>

namespace ph = passive_haptics;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {
/// The ways of one number, and what is foreseen of the next.
template <class Scalar = double>
struct told {
  ph::foresight<Scalar> sees;
  Scalar last{}, older{};

  Scalar operator()(Scalar way) {
    sees.hear(way * way, way * last, way * older);
    older = last;
    last = way;
    return sees.last() * last + sees.before() * older;
  }
};
}  // namespace

TEST_CASE("a steady motion and a sine are foreseen, what begins is not", "[base]") {
  for (const double phase : {0.3, 0.5, 0.7, 1.2, 1.57, 1.9}) {
    told<> next;
    CHECK(next(0.0) == 0.0);
    CHECK(next(std::sin(phase)) == 0.0);
    double foreseen = 0.0, error = 0.0, all = 0.0;
    for (int n = 2; n < 400; ++n) {
      const double way = std::sin(phase * n);
      if (n > 30) {
        error += (foreseen - way) * (foreseen - way);
        all += way * way;
      }
      foreseen = next(way);
    }
    INFO("phase " << phase);
    // The best guess from the last way alone errs by the sine.
    CHECK(std::sqrt(error / all) < 0.6 * std::sin(phase));
  }
  told<> steady;
  for (int n = 0; n < 12; ++n) (void)steady(2.0);
  CHECK_THAT(steady(2.0), WithinRel(2.0, 0.02));
  CHECK(steady.sees.is_steady());
  CHECK_THAT(steady.sees.share(), WithinRel(1.0, 0.02));
}

TEST_CASE("what jumps, what swings from one news to the next, and noise are not foreseen",
          "[base]") {
  told<> jumps;
  for (int n = 0; n < 5; ++n) CHECK(jumps(0.0) == 0.0);
  CHECK(jumps(1.0) == 0.0);
  CHECK(jumps(0.0) == 0.0);
  told<> swings;
  for (int n = 0; n < 30; ++n) {
    const double foreseen = swings(n % 2 == 0 ? 1.0 : -1.0);
    if (n > 4) CHECK_THAT(foreseen, WithinAbs(0.0, 0.02));
  }
  CHECK(swings.sees.share() <= 0.02);
  CHECK_FALSE(swings.sees.is_steady());
  told<> seldom;  // less than three times a period
  for (int n = 0; n < 60; ++n) {
    const double foreseen = seldom(std::sin(2.3 * n));
    if (n > 20) CHECK(foreseen == 0.0);
  }
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  told<> noise;
  double foreseen = 0.0, worse = 0.0, nothing = 0.0;
  for (int n = 0; n < 4000; ++n) {
    const double way = normal(random);
    worse += (way - foreseen) * (way - foreseen);
    nothing += way * way;
    foreseen = noise(way);
  }
  CHECK(worse < 1.06 * nothing);  // by a; it would be 1.13
}

TEST_CASE("nothing is foreseen faster than it went, whatever news come", "[base]") {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  for (int draw = 0; draw < 200; ++draw) {
    told<> next;
    double likely = 0.0, before = 0.0, last = 0.0, squares = 0.0;
    for (int n = 0; n < 60; ++n) {
      const double power = std::pow(10.0, 4.0 * number(random) * (draw % 4));
      const double way = power * (std::sin(0.02 * draw * n) + 0.3 * number(random));
      const double onwards = way * last > 0.0 ? std::abs(last) : 0.0;
      const double most = 2.0 * std::max({std::abs(likely), std::abs(before), onwards});
      before = likely;
      likely = std::abs(way) > most ? std::copysign(most, way) : way;
      last = way;
      squares = 0.875 * squares + likely * likely;
      const double bound = std::max({std::abs(likely), std::abs(before), std::sqrt(squares / 4.0)});
      REQUIRE(std::abs(next(way)) <= bound * (1.0 + 1e-9));
    }
  }
}

TEST_CASE("what is gone back again is told from what goes on, soon", "[base]") {
  told<> next;
  for (int n = 0; n < 40; ++n) {
    (void)next(1.0);
    CHECK_FALSE(next.sees.goes_back());
  }
  for (int n = 0; n < 4; ++n) (void)next(n % 2 == 0 ? -1.0 : 1.0);
  CHECK(next.sees.goes_back());
  for (int n = 0; n < 6; ++n) (void)next(1.0);
  CHECK_FALSE(next.sees.goes_back());
  told<> stops;
  for (const double way : {1.0, 0.0, 0.0}) {
    (void)stops(way);
    CHECK_FALSE(stops.sees.goes_back());
  }
}

TEST_CASE("one bad update costs no foresight later", "[base]") {
  told<> next;
  double foreseen = 0.0, error = 0.0;
  for (int n = 0; n < 60; ++n) {
    const double way = std::sin(0.4 * n);
    if (n > 33) error = std::max(error, std::abs(foreseen - way));
    foreseen = next(n == 30 ? 1000.0 : way);
  }
  CHECK(error < 1.2);  // of 1, no more than without any foresight
}

TEST_CASE("an update beyond all numbers costs no foresight later either", "[base][fault]") {
  const auto sees_again = [](auto absurd) {
    using scalar = decltype(absurd);
    told<scalar> next;
    scalar foreseen{}, error{}, all{};
    for (int n = 0; n < 200; ++n) {
      const scalar way = std::sin(scalar(0.4) * scalar(n));
      if (n > 60) {
        error += (foreseen - way) * (foreseen - way);
        all += way * way;
      }
      foreseen = next(n == 30 ? absurd : way);
    }
    return std::sqrt(error / all) < scalar(0.6) * std::sin(scalar(0.4));
  };
  CHECK(sees_again(1e200));
  CHECK(sees_again(1e30F));
  CHECK(sees_again(1e100));
  CHECK(sees_again(1e12F));
}

TEST_CASE("no news make a foresight that is no number", "[base][fault]") {
  constexpr double most = std::numeric_limits<double>::max();
  constexpr double inf = std::numeric_limits<double>::infinity();
  for (const double bad : {most, -most, inf, -inf, 1e100, 1e-200, std::nan("")}) {
    ph::foresight<double> sees;
    for (int n = 0; n < 10; ++n) sees.hear(1.0, 1.0, 1.0);
    sees.hear(bad * bad, bad, bad);
    for (int n = 0; n < 30; ++n) {
      REQUIRE(std::isfinite(sees.last()));
      REQUIRE(std::isfinite(sees.before()));
      REQUIRE(std::isfinite(sees.share()));
      sees.hear(1.0, 1.0, 1.0);
    }
    CHECK_THAT(sees.last() + sees.before(), WithinRel(1.0, 0.02));  // and it sees again
  }
}
