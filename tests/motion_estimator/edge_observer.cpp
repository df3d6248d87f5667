// SPDX-License-Identifier: BSD-3-Clause
// The estimator for encoders on a device with dry friction: what it knows at an edge, what it makes of a
// motion in between, and what the force that follows from it costs a ledger that is sure.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/laws.hpp>
#include <passive_haptics/motion_estimator/edge_observer.hpp>
#include <passive_haptics/port/last_difference.hpp>

#include <cmath>
#include <numbers>

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double q = 60e-6, T = 1e-3;

double shown(double x) {
  return q * std::floor(x / q);
}

/// A motion estimator behind encoders that cut off.
template <class Motion>
struct seeing {
  ph::part_at<Motion, d1> motion;
  double last = 0.0;
  bool known = false;

  explicit seeing(const Motion& parameters) : motion(parameters) {}
  auto at(double x) {
    const double now = shown(x), way = known ? now - last : 0.0;
    last = now;
    return motion.estimate(last, way, 0.0, T, std::exchange(known, true));
  }
};

/// What a swing into a wall K costs the certificate that counts on no friction, over K q for each metre
/// of the way: Σ f Δx̂ + ½ q |change of f|, f = −K x.
template <class Motion>
double cost_of_a_swing(const Motion& parameters, double depth, double frequency) {
  seeing<Motion> seen(parameters);
  double f = 0.0, last = 0.0, cost = 0.0, way = 0.0;
  for (int n = 0; n < 20000; ++n) {
    const double x = 5e-3 + depth / 2 * std::sin(2 * std::numbers::pi * frequency * n * T);
    const double before = seen.known ? seen.last : shown(x);
    const double next = -seen.at(x).position;  // of a wall of 1 N/m
    if (n >= 10000) {
      cost += f * (seen.last - before) + q / 2 * std::abs(next - f);
      way += std::abs(x - last);
    }
    f = next;
    last = x;
  }
  return cost / (q * way);
}

/// The middle of the step that is shown.
struct middle {
  [[nodiscard]] constexpr ph::parameter_fault check() const noexcept { return {}; }
  template <class P>
  struct on {
    constexpr explicit on(const middle& /*p*/) noexcept {}
    struct seen {
      double position;
    };
    constexpr seen estimate(double x, double /*dx*/, double /*f*/, double /*dt*/,
                            bool /*known*/) const noexcept {
      return {x + q / 2};
    }
  };
};

}  // namespace

TEST_CASE("edge_observer does not move for a device that chatters at an edge", "[motion]") {
  seeing eyes(ph::edge_observer{q});
  for (int n = 0; n < 200; ++n) (void)eyes.at(n * 1e-6);  // comes at 1 mm/s and stops past an edge
  for (int n = 0; n < 40; ++n) (void)eyes.at(n % 2 == 0 ? 178e-6 : 182e-6);
  for (int n = 0; n < 40; ++n) {
    const auto now = eyes.at(n % 3 == 0 ? 178e-6 : 182e-6);
    CHECK_THAT(now.position, WithinAbs(3 * q, 1e-9));
    CHECK(std::abs(now.along(1.0)) == 0.0);
  }
}

TEST_CASE("edge_observer stays within the step shown, wherever it goes", "[motion]") {
  seeing eyes(ph::edge_observer{q});
  CHECK_THAT(eyes.at(0.3 * q).position, WithinRel(q / 2, 1e-12));  // it may be anywhere in it
  ph::laws::samples random(1);
  double x = 0.0;
  for (int n = 0; n < 5000; ++n) {
    x += random.number<double>() * (n % 100 < 50 ? 2e-5 : 4e-4);
    const double seen = eyes.at(x).position;
    REQUIRE(seen >= shown(x));
    REQUIRE(seen <= shown(x) + q);
  }
}

TEST_CASE("edge_observer follows an even motion better than its steps do", "[motion]") {
  for (const double v : {2e-3, 8e-3, -31e-3, 0.11, -0.4}) {
    seeing eyes(ph::edge_observer{q});
    double square = 0.0, of_steps = 0.0, speed = 0.0;
    for (int n = 0; n < 1000; ++n) {
      const double x = v * n * T;
      const auto now = eyes.at(x);
      if (n < 200) continue;
      square += (now.position - x) * (now.position - x) / 800;
      of_steps += (shown(x) + q / 2 - x) * (shown(x) + q / 2 - x) / 800;
      speed += now.velocity / 800;
    }
    CAPTURE(v, square, of_steps);
    CHECK(square < (std::abs(v) * T < q ? 0.5 : 1.3) * of_steps);
    CHECK_THAT(speed, WithinRel(v, 0.05));
  }
}

TEST_CASE("an edge brings the speed nearer to what the way says, a quarter for each tick or step",
          "[motion]") {
  // In steps and ticks: so many of the one every so many of the other, and then one edge more.
  const auto speed = [](int ticks, int steps, int then_ticks, int then_steps) {
    const double width = 0x1p-14, dt = 0x1p-10;  // so that ways and times are exact
    auto eyes = at<d1>(ph::edge_observer{width});
    double x = 0.0, seen = eyes.estimate(x, 0.0, 0.0, dt, false).velocity;
    const auto go = [&](int wait, int by) {
      for (int n = 1; n < wait; ++n) (void)eyes.estimate(x, 0.0, 0.0, dt, true);
      x += by * width;
      seen = eyes.estimate(x, by * width, 0.0, dt, true).velocity / (width / dt);
    };
    for (int n = 0; n < 20; ++n) go(ticks, steps);
    CHECK_THAT(seen, WithinRel(1.0 * steps / ticks, 1e-9));
    go(then_ticks, then_steps);
    return seen;
  };
  for (const int d : {1, -1}) {
    CAPTURE(d);
    CHECK_THAT(d * speed(3, d, 2, d), WithinRel(1.0 / 3 + 2.0 / 4 * (1.0 / 2 - 1.0 / 3), 1e-9));
    CHECK_THAT(d * speed(1, d, 1, 2 * d), WithinRel(1 + 1.0 / 4 * (2 - 1), 1e-9));
    CHECK_THAT(d * speed(1, 2 * d, 1, 3 * d), WithinRel(2 + 2.0 / 4 * (3 - 2), 1e-9));
    // and never past it: four ticks, or steps, say it alone
    CHECK_THAT(d * speed(2, d, 4, d), WithinRel(1.0 / 4, 1e-9));
    CHECK_THAT(d * speed(1, d, 1, 4 * d), WithinRel(4.0, 1e-9));
    CHECK_THAT(d * speed(1, 7 * d, 1, d), WithinRel(1.0, 1e-9));
    // an edge back: 4/5 of the speed at the last, or of four steps in the time since
    CHECK_THAT(d * speed(3, d, 1, -d), WithinRel(-0.8 / 3, 1e-9));
    CHECK_THAT(d * speed(1, 3 * d, 2, -d), WithinRel(-0.8 * 2, 1e-9));
    CHECK_THAT(d * speed(1, 3 * d, 1, -2 * d), WithinRel(-2.0, 1e-9));  // no mere turn
  }
}

TEST_CASE("between edges it is no faster than a step in the time since the last", "[motion]") {
  for (const int d : {1, -1}) {
    seeing eyes(ph::edge_observer{q});
    double x = q / 2;
    (void)eyes.at(x);
    for (int n = 0; n < 10; ++n) (void)eyes.at(x += d * q);
    for (int n = 1; n < 20; ++n) CHECK_THAT(d * eyes.at(x).velocity, WithinRel(q / (n * T), 1e-9));
  }
}

TEST_CASE("edge_observer stays within the step shown where positions come in smaller ones",
          "[motion]") {
  auto eyes = at<d1>(ph::edge_observer{q});
  ph::laws::samples random(1);
  double x = 0.0;
  (void)eyes.estimate(x, 0.0, 0.0, T, false);
  for (int n = 0; n < 1000; ++n) {
    const double way = 0.4 * q * random.number<double>();
    const double seen = eyes.estimate(x += way, way, 0.0, T, true).position;
    REQUIRE(seen >= x);
    REQUIRE(seen <= x + q);
  }
}

TEST_CASE("edge_observer begins anew where a speed is no number", "[motion]") {
  auto eyes = at<d2>(ph::edge_observer{q});
  (void)eyes.estimate(d2::vector(0, 3), d2::zero(), d2::zero(), T, false);
  const d2::vector far(0, 1e300);
  const auto now = eyes.estimate(far, far, d2::zero(), 1e-9, true);
  CHECK(now.velocity == d2::zero());
  CHECK(now.position == d2::vector(q / 2, 1e300));
}

TEST_CASE("edge_observer damps no motion that is slower than an eighth of a step a tick",
          "[motion]") {
  for (const double v : {0.005, 0.1}) {
    seeing eyes(ph::edge_observer{q});
    double along = 0.0;
    for (int n = 0; n < 400; ++n) along = eyes.at(v * n * T).along(-1.0);
    CHECK_THAT(along, WithinAbs(-std::max(0.0, v - q / (8 * T)), 0.1 * v));
  }
}

TEST_CASE("a swing seen by edge_observer costs a sure ledger 5/6 of what it does seen by its steps",
          "[motion]") {
  for (const double depth : {0.5e-3, 1e-3}) {
    for (const double frequency : {1.0, 3.0}) {
      CAPTURE(depth, frequency);
      CHECK_THAT(cost_of_a_swing(middle{}, depth, frequency), WithinAbs(1.0, 0.15));
      CHECK_THAT(cost_of_a_swing(ph::edge_observer{q}, depth, frequency),
                 WithinAbs(5.0 / 6.0, 0.05));
    }
  }
}

TEST_CASE("edge_observer rests in the middle of a step that nothing moves in", "[motion]") {
  seeing eyes(ph::edge_observer{q});
  double x = 0.0;
  for (int n = 0; n < 100; ++n) (void)eyes.at(x += 0.7 * q / 10);  // seven steps
  for (int n = 0; n < 90; ++n) (void)eyes.at(x);
  CHECK_THAT(eyes.at(x).position, WithinAbs(shown(x) + q * 2 / 3, 0.01 * q));
  for (int n = 0; n < 209; ++n) (void)eyes.at(x);  // so far it waited for 100 ms, then 200 ms
  CHECK_THAT(eyes.at(x).position, WithinAbs(shown(x) + q / 2 + q / 6 * std::exp(-1.0), 0.02 * q));
  for (int n = 0; n < 1500; ++n) (void)eyes.at(x);
  CHECK_THAT(eyes.at(x).position, WithinAbs(shown(x) + q / 2, 1e-3 * q));
  x += q;
  CHECK_THAT(eyes.at(x).position, WithinAbs(shown(x), 0.1 * q));  // and is at the next edge
}

namespace {

/// How far x goes in the last second of a swing of that amplitude at 8.7 Hz about 20.3 steps.
template <class Motion>
double seen_swing(const Motion& parameters, double amplitude, double* mean = nullptr) {
  seeing<Motion> eyes(parameters);
  double least = 1.0, most = 0.0, sum = 0.0;
  for (int n = -1000; n < 3000; ++n) {
    const double in = n < 0 ? 1.0 + n * 1e-3 : 1.0;
    const double x =
        in * 20.3 * q + (n < 0 ? 0.0 : amplitude * std::sin(2 * std::numbers::pi * 8.7 * n * T));
    const double now = eyes.at(x).position;
    if (n < 2000) continue;
    least = std::min(least, now);
    most = std::max(most, now);
    sum += now / 1000;
  }
  if (mean != nullptr) *mean = sum;
  return most - least;
}

}  // namespace

TEST_CASE("edge_observer rests within what elastic friction holds, and nowhere else", "[motion]") {
  const double p = 1.5 * q;  // a swing of four steps
  const ph::edge_observer held{.quantum = q, .presliding = p};
  double mean = 0.0;
  CHECK(seen_swing(held, 1.9 * q, &mean) < 1e-3 * q);
  CHECK_THAT(mean, WithinAbs(20.3 * q, 0.6 * q));
  CHECK(seen_swing(ph::edge_observer{q}, 1.9 * q) > 2.0 * q);
  CHECK_THAT(seen_swing(held, 4.0 * q), WithinRel(seen_swing(ph::edge_observer{q}, 4.0 * q), 1e-9));
  const ph::edge_observer not_so_far{.quantum = q, .presliding = q / 2};
  CHECK_THAT(seen_swing(not_so_far, 0.9 * q),
             WithinRel(seen_swing(ph::edge_observer{q}, 0.9 * q), 1e-9));
}

TEST_CASE("edge_observer sees the mirror image of a motion as that of what it saw", "[motion]") {
  const ph::edge_observer held{.quantum = q, .presliding = 1.5 * q};
  auto right = at<d1>(held), left = at<d1>(held);
  double x = 0.0;
  (void)right.estimate(0.0, 0.0, 0.0, T, false);
  (void)left.estimate(-q, 0.0, 0.0, T, false);
  for (int n = 1; n < 400; ++n) {  // two steps back and forth, from the first edge on
    const double way = n % 20 != 0 ? 0.0 : n / 20 % 4 < 2 ? q : -q;
    x += way;
    const double seen = right.estimate(x, way, 0.0, T, true).position;
    CAPTURE(n);
    REQUIRE_THAT(left.estimate(-x - q, -way, 0.0, T, true).position, WithinAbs(-seen, 1e-12));
  }
}

TEST_CASE("edge_observer leaves a rest with the first step beyond what it swung over", "[motion]") {
  seeing eyes(ph::edge_observer{.quantum = q, .presliding = 1.5 * q});
  const auto turn_between = [&eyes](double a, double b) {
    for (int n = 0; n < 6; ++n) {
      for (int k = 0; k < 20; ++k) (void)eyes.at(n % 2 == 0 ? a : b);
    }
    return eyes.at(b).position;
  };
  const double rest = turn_between(10.5 * q, 11.5 * q);
  CHECK_THAT(rest, WithinAbs(11 * q, 0.2 * q));
  CHECK_THAT(eyes.at(12.5 * q).position, WithinAbs(rest, 1e-9));  // one step more may be a tremor's
  CHECK_THAT(eyes.at(13.5 * q).position, WithinAbs(13 * q, 0.5 * q));
  (void)turn_between(13.5 * q, 14.5 * q);
  for (int n = 0; n < 120; ++n) (void)eyes.at(14.5 * q);  // and one that no edge confirms is over
  CHECK(eyes.at(14.5 * q).position >= 14 * q);
  CHECK(eyes.at(15.5 * q).position >= 15 * q);
}

TEST_CASE("edge_observer of exact positions is the last difference", "[motion]") {
  ph::part_at<ph::edge_observer, d3> edges(ph::edge_observer{});
  ph::part_at<ph::last_difference, d3> difference(ph::last_difference{});
  d3::vector x = d3::zero();
  (void)edges.estimate(x, d3::zero(), d3::zero(), T, false);
  for (int n = 1; n < 50; ++n) {
    const d3::vector dx{1e-5 * std::sin(n), n % 5 == 0 ? 0.0 : 1e-6, -1e-4};
    x += dx;
    const auto a = edges.estimate(x, dx, d3::zero(), T, true);
    const auto b = difference.estimate(x, dx, d3::zero(), T, true);
    CHECK((a.position - x).norm() < 1e-15);
    CHECK_THAT(a.along(d3::vector(0.6, 0.8, 0.0)),
               WithinAbs(b.along(d3::vector(0.6, 0.8, 0.0)), 1e-12));
  }
}

namespace {

/// An axis of edge_observer a second time, from what its header says of it.
struct plain_edges {
  double q, p;
  double x = 0.0, v = 0.0;              ///< v is |v| in the direction `to`
  double way = 0.0, t = 0.0, to = 0.0;  ///< since the last edge, and which way that was
  double at_edge = 0.0;                 ///< |v| there
  double low = 0.0, high = 0.0;         ///< steps of the last turns
  int turns = 0;

  void start(double step) {
    *this = {.q = q, .p = p, .x = step + q / 2, .low = step, .high = step};
  }
  void see(double step, double travel, double dt) {
    way += travel;
    t += dt;
    const double most = 2 * p + 1.01 * q;
    if (std::abs(way) >= q / 2) {
      const double now = way < 0.0 ? -1.0 : 1.0, size = std::abs(way);
      if (2 * p > q) {
        if (now * to < 0.0) {
          (now > 0.0 ? low : high) = step - way;
          turns = high - low <= most ? std::min(turns + 1, 2) : 0;
        }
        const double beyond = std::max({low - step, step - high, 0.0});
        if (high - low + beyond > most || beyond > 1.01 * q) turns = 0;
      }
      const double mean = size / t, share = std::max(t / dt, v * t / q) / 4;
      if (to != now && size <= 1.5 * q) {
        v = 0.8 * std::min(at_edge, 4 * q / t);
      } else if (to != now || v == 0.0 || size >= 4 * q || share >= 1.0) {
        v = mean;
      } else {
        v += share * (mean - v);
      }
      at_edge = v;
      if (turns < 2) x = (now > 0.0 ? step : step + q) + now * std::min(v * dt, q) / 2;
      to = now;
      way = t = 0.0;
    } else if (t > 0.1) {
      if (turns == 2) x = step + q / 2;
      turns = 0;
      x = std::clamp(x, step, step + q);
      x += (step + q / 2 - x) * std::min(dt / 0.2, 1.0);
    } else if (turns == 2) {
      x += ((low + high) / 2 + q / 2 - x) * std::min(dt / 0.05, 1.0);
    } else {
      v = std::min(v, q / t);
      const double farthest = to > 0.0 ? step + q * 2 / 3 : step + q / 3;
      if (to * (farthest - x) > 0.0) x += to * std::min(v * dt, std::abs(farthest - x));
      x = std::clamp(x, step, step + q);
    }
  }
};

}  // namespace

TEST_CASE("edge_observer shows what its formulas say, wherever an axis goes and rests",
          "[motion]") {
  constexpr double step = 0x1p-14, tick = 0x1p-10;  // so that ways and times are exact
  const std::pair<double, double> steps_and_springs[]{{step, 0.0},         {step, 0.5 * step},
                                                      {step, 0.75 * step}, {step, 1.5 * step},
                                                      {step, 2.0 * step},  {0.0, 1.5 * step}};
  for (const auto& [width, p] : steps_and_springs) {
    ph::laws::samples random(5);
    const auto one_of = [&](std::initializer_list<double> numbers) {
      return numbers.begin()[static_cast<int>((random.number<double>() + 1.0) * 0.5 *
                                              static_cast<double>(numbers.size()))];
    };
    auto eyes = at<d2>(ph::edge_observer{.quantum = width, .presliding = p});
    plain_edges plain[2]{{width, p}, {width, p}};
    d2::vector x = d2::zero();
    int rested = 0, swung = 0, left[2]{0, 0}, moves[2]{0, 0};
    double goes[2]{0.0, 0.0}, by[2]{0.0, 0.0}, part[2]{1.0, 1.0};
    for (int n = 0; n < 3500; ++n) {
      d2::vector travel = d2::zero();
      for (int i = 0; i < 2; ++i) {
        if (left[i]-- <= 0) {  // another kind of motion: so many ticks, or back and forth
          left[i] = static_cast<int>(one_of({1, 3, 8, 30, 130}));
          goes[i] = one_of({0, 0, 1, 2, 3, 4, 5, 6});
          by[i] = one_of({-1, 1});
          part[i] = one_of({1, 1, 1, 0.25, 0.5});
        }
        if (n % static_cast<int>(goes[i] + 1) == 0) {
          travel(i) = goes[i] == 0.0 ? 0.0 : by[i] * step * part[i] * one_of({1, 1, 1, 2, 3, 4, 5});
        }
        if (goes[i] == 2.0 || goes[i] == 6.0) by[i] = one_of({1, 1, -1, -1, -by[i]});
        if (goes[i] > 2.0 && goes[i] < 6.0 &&
            travel(i) != 0.0) {  // one, two or three steps to and fro
          travel(i) = by[i] * step;
          if (++moves[i] % (static_cast<int>(goes[i]) - 2) == 0) by[i] = -by[i];
        }
      }
      x += travel;
      const bool known = n % 191 != 0;
      const double dt = tick * one_of({1, 1, 1, 1, 1, 1, 0.5, 0.5, 2, 64, 0.1 / tick, 0.25 / tick});
      // Where nothing rests the turns are forgotten; with the same numbers nothing is.
      if (n % 499 == 300) {
        eyes.set({.quantum = width});
        eyes.set({.quantum = width, .presliding = p});
        plain[0].turns = plain[1].turns = 0;
      } else if (n % 7 == 0) {
        eyes.set({.quantum = width, .presliding = p});
      }
      const auto now = eyes.estimate(x, travel, d2::zero(), dt, known);
      REQUIRE(eyes.position() == now.position);
      for (int i = 0; i < 2; ++i) {
        plain_edges& one = plain[i];
        if (!known) {
          one.start(x(i));
        } else {
          one.see(x(i), travel(i), dt);
        }
        CAPTURE(p, n, i, x(i) / step, travel(i) / step, dt / tick);
        REQUIRE_THAT(now.position(i), WithinAbs(one.x, 1e-9 * step));
        REQUIRE_THAT(now.velocity(i), WithinAbs(one.v * one.to, 1e-9 * step / tick));
        rested += one.t > 0.1 ? 1 : 0;
        swung += one.turns == 2 ? 1 : 0;
      }
      const double along = now.velocity(0), least = width / (8 * dt);
      REQUIRE_THAT(now.along(d2::vector(1, 0)),
                   WithinAbs(std::copysign(std::max(std::abs(along) - least, 0.0), along),
                             1e-9 * step / tick));
    }
    CAPTURE(width, p, rested, swung);
    CHECK((width > 0.0 ? rested > 200 : rested == 0));
    CHECK((2 * p > width ? swung > 100 : swung == 0));
  }
}

TEST_CASE("edge_observer that is reset is as it was made", "[motion]") {
  const ph::edge_observer held{.quantum = q, .presliding = 1.5 * q};
  auto used = at<d1>(held), fresh = at<d1>(held);
  double x = 0.0;
  const auto go = [&](auto& eyes, double way) {
    const auto now = eyes.estimate(x, way, 0.0, T, true);
    return std::pair{now.position, now.velocity};
  };
  for (int n = 0; n < 60; ++n) {
    const double way = n % 20 < 10 ? q : -q;
    x += way;
    (void)go(used, way);
  }
  used.reset();
  CHECK(used.position() == 0.0);
  for (int n = 0; n < 200; ++n) {
    const double way = n % 7 != 3 ? 0.0 : n % 2 == 0 ? q : -q;
    x += way;
    REQUIRE(go(used, way) == go(fresh, way));
  }
}

TEST_CASE("edge_observer begins anew after a sample that was lost, and takes new parameters",
          "[motion]") {
  seeing eyes(ph::edge_observer{q});
  for (int n = 0; n < 100; ++n) (void)eyes.at(n * 2e-5);
  eyes.known = false;
  const auto now = eyes.at(5e-3);
  CHECK_THAT(now.position, WithinRel(shown(5e-3) + q / 2, 1e-12));
  CHECK(now.along(1.0) == 0.0);
  eyes.motion.set(ph::edge_observer{2 * q});
  CHECK(eyes.motion.parameters().quantum == 2 * q);
  eyes.motion.set({.quantum = q, .presliding = 2 * q});
  CHECK(eyes.motion.parameters().presliding == 2 * q);
  CHECK(ph::edge_observer{.quantum = q, .presliding = -1.0}.check());
  CHECK(ph::edge_observer{-1.0}.check());
  CHECK(ph::edge_observer{std::nan("")}.check());
  CHECK_FALSE(ph::edge_observer{}.check());
}
