// SPDX-License-Identifier: BSD-3-Clause
// The curvature that is seen in the tangent planes of a surface, and what it is worth.
#include "support/catch.hpp"
#include <passive_haptics/compositions.hpp>
#include <passive_haptics/constraint_geometry/quadric.hpp>
#include <passive_haptics/contact/bending.hpp>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace ph = passive_haptics;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {
using volume = ph::space<double, 3>;
using vector = volume::vector;
using plane = ph::half_space<volume>;

/// What bends as it is told by planes, to a device at the places of each.
struct told {
  ph::bending<volume> seen;
  plane last{};
  vector x = vector::Zero();
  int heard = 0;

  [[nodiscard]] double sag(const vector& normal, const vector& at) const {
    return seen.at(normal, at).sag;
  }
  [[nodiscard]] vector turned(const vector& normal, const vector& at) const {
    return seen.at(normal, at).normal;
  }
  void operator()(const plane& now, const vector& at, double ages = 0.0) {
    if (heard++ > 0) seen.hear(last, now, at, vector(at - x), 0.01, 0.01 * ages);
    last = now;
    x = at;
  }
};
/// The tangent plane of a ball of that radius about the origin, and a device at that angle, 1 mm below its surface.
plane on_ball(double radius, double angle) {
  const vector n(std::sin(angle), 0.0, std::cos(angle));
  return {vector(radius * n), n, 1000.0};
}
vector below(double radius, double angle) {
  return (radius - 1e-3) * vector(std::sin(angle), 0.0, std::cos(angle));
}
double tremor(int n) {
  return 0.05 * std::sin(0.9 * n) + 0.03 * std::sin(0.23 * n);
}
}  // namespace

TEST_CASE("a ball and a hollow are seen in their tangent planes", "[contact]") {
  for (const double radius : {0.01, 0.04, 3.0}) {
    for (const double side : {1.0, -1.0}) {
      INFO("radius " << side * radius);
      told ball;
      double angle = 0.0;
      for (int n = 0; n < 40; ++n) {
        angle = tremor(n);
        plane p = on_ball(radius, angle);
        p.normal = vector(side * vector(p.normal));
        ball(p, below(radius, angle));
        CHECK((n >= 2) == ball.seen.is_curved());
      }
      const double next = angle + 0.04;
      const vector normal = ball.last.normal, x = below(radius, next);
      const vector truth = side * vector(std::sin(next), 0.0, std::cos(next));
      CHECK((ball.turned(normal, x) - truth).norm() < 0.005);
      CHECK((normal - truth).norm() > 0.039);
      const double flat = ball.last.at(x).depth, depth = side * 1e-3;
      CHECK(std::abs(flat - ball.sag(normal, x) - depth) < 0.12 * std::abs(flat - depth));
      // A way of the device turns a normal in the same way, and one along the normal does not.
      CHECK((ball.seen.onwards(normal, vector(x - below(radius, angle))) - ball.turned(normal, x))
                .norm() < 1e-9);
      CHECK((ball.seen.onwards(normal, normal) - normal).norm() < 1e-12);
    }
  }
}

TEST_CASE("an edge, noise, and a plane that turns by itself bend nothing", "[contact]") {
  std::mt19937 random(4);
  const auto noise = [&] { return std::normal_distribution<>(0.0, 0.02)(random); };
  const std::vector<std::pair<const char*, std::function<plane(int)>>> worlds{
      {"flat",
       [](int) {
         return plane{{0, 0, 0}, {0, 0, 1}, 1000.0};
       }},
      {"a plane that heaves",
       [](int n) {
         return plane{{0, 0, 1e-3 * std::sin(0.4 * n)}, {0, 0, 1}, 1000.0};
       }},
      {"an edge",
       [](int n) {
         return plane{{0, 0, 0}, {n % 40 < 20 ? 0.2 : -0.2, 0, 1}, 1000.0};
       }},
      {"noise", [&](int n) {
         return plane{{1e-4 * n, 0, 0}, {noise(), noise(), 1}, 1000.0};
       }}};
  for (const auto& [name, world] : worlds) {
    INFO(name);
    told seen;
    double most = 0.0;
    for (int n = 0; n < 400; ++n) {
      plane p = world(n);
      REQUIRE(p.prepare());
      seen(p, {1e-4 * n, 0.0, -1e-3});
      const vector normal = p.normal;
      if (n % 40 > 2) {
        const vector on(1e-4 * (n + 1), 0.0, -1e-3);
        most = std::max(most, (seen.turned(normal, on) - normal).norm());
      }
    }
    CHECK(most < 0.02);
  }
  told turns;
  for (int n = 0; n < 400; ++n) {
    plane p{{0, 0, 0}, {std::sin(0.1 * n), 0, 1}, 1000.0};
    REQUIRE(p.prepare());
    turns(p, {1e-6 * std::sin(2.0 * n), 0.0, -1e-3});
    const vector normal = p.normal;
    CHECK((turns.turned(normal, vector(1e-6, 0, -1e-3)) - normal).norm() < 1e-3);
  }
}

TEST_CASE("planes told by any other point than the one touched bend about the device",
          "[contact]") {
  const vector elsewhere(0.1, 0.05, -0.2);
  told ball;
  double angle = 0.0;
  for (int n = 0; n < 40; ++n) {
    angle = tremor(n);
    plane p = on_ball(0.04, angle);
    const vector normal = p.normal;
    p.point = vector(elsewhere + normal * normal.dot(vector(vector(p.point) - elsewhere)));
    ball(p, below(0.04, angle));
  }
  const vector normal = ball.last.normal;
  CHECK(ball.sag(normal, below(0.04, angle)) == 0.0);
  const double next = angle + 0.02;
  const vector truth(std::sin(next), 0.0, std::cos(next));
  CHECK((ball.turned(normal, below(0.04, next)) - truth).norm() < 0.004);

  // Late news are of where the device was: their own point says so, if the way since may be so long.
  for (const auto& [late, ages, believed] :
       {std::tuple(1, 0.0, true), std::tuple(8, 0.0, false), std::tuple(8, 8.0, true)}) {
    told behind;
    for (int n = 0; n < 40; ++n)
      behind(on_ball(0.04, 5e-3 * (n - late)), below(0.04, 5e-3 * n), ages);
    const vector now = below(0.04, 5e-3 * 39), n = behind.last.normal;
    const vector there(std::sin(5e-3 * 39), 0.0, std::cos(5e-3 * 39));
    const double off = (behind.turned(n, now) - there).norm();
    CHECK((off < 2e-3) == believed);
    CHECK(off < 5e-3 * late + 1e-3);
  }
}

TEST_CASE("a surface bends no farther than what was seen of it, and forgets what is no number",
          "[contact]") {
  told ball;
  for (int n = 0; n < 40; ++n) ball(on_ball(0.04, 5e-3 * n), below(0.04, 5e-3 * n));
  const vector normal = ball.last.normal, along(normal.z(), 0.0, -normal.x());
  const vector from = ball.last.point;
  const double most = 2.0 * 5e-3 * 0.039, K = 1.0 / 0.04;
  for (const double s : {1e-3, 0.1, 1e6, 1e100}) {
    INFO(s << " m");
    CHECK((ball.turned(normal, vector(from + s * along)) - normal).norm() <= 1.01 * K * most);
    CHECK(ball.sag(normal, vector(from + s * along)) <= 1.01 * K * most * s);
  }
  ball({vector(1e200, 0, 0), vector(0, 0, 1), 1000.0}, vector(1e200, 0, 0));
  CHECK_FALSE(ball.seen.is_curved());
  for (int n = 0; n < 60; ++n) ball(on_ball(0.04, tremor(n)), below(0.04, tremor(n)));
  const vector x = below(0.04, tremor(59) + 0.02), last = ball.last.normal;
  CHECK_THAT((ball.turned(last, x) - last).norm(), WithinAbs(0.02, 0.002));
}

namespace {
/// A bowl of 50 mm and 800 N/m, told ten times a second, `late` [s] late, under a device that strokes it to and fro.
/// `elsewhere`: by a point of the plane that is not the one touched; `motion`: what is told of it.
template <class Surface>
double error_in_bowl(double late, bool elsewhere = false,
                     const ph::surface_motion<volume>& motion = {}, int bursts = 1) {
  auto touch = ph::make_touch<volume, Surface>(
      {.mass = 0.1, .damping = 0.03, .force_limit = 9.0, .longest_tick = 1e-3},
      ph::known_hand{.force = 5.0});
  const auto at = [](double t) {
    const double u = 0.3 * std::tanh(1.2 * std::sin(3.0 * t)), v = 0.1 * std::sin(2.3 * t);
    const double r = 0.0525 - 6.5e-3 * std::max(0.0, 1.0 - t / 0.4);
    return vector(r * std::sin(u), r * std::sin(v),
                  -r * std::sqrt(1.0 - std::pow(std::sin(u), 2) - std::pow(std::sin(v), 2)));
  };
  const auto bowl = [elsewhere](const vector& x) {
    const vector inward = -x.normalized();
    Surface s{};
    s.point = vector(-0.05 * inward);
    s.normal = inward;
    s.stiffness = 800.0;
    if constexpr (requires { s.thickness; }) s.thickness = 0.02;
    const vector other(0.1, 0.05, -0.2);
    if (elsewhere) s.point = vector(other + inward * inward.dot(vector(vector(s.point) - other)));
    return s;
  };
  double sum = 0.0;
  for (int n = 0; n < 4000; ++n) {
    const double t = 1e-3 * n;
    if (n % 100 < bursts) REQUIRE(touch.update(bowl(at(std::max(0.0, t - late))), motion));
    const auto tick = touch.tick(at(t), ph::seconds{1e-3});
    CHECK(tick.energy >= 0.0);
    const vector truth = 800.0 * std::max(0.0, at(t).norm() - 0.05) * -at(t).normalized();
    if (n >= 500) sum += (vector(tick.force) - truth).squaredNorm();
  }
  return std::sqrt(sum / 3500);
}
}  // namespace

TEST_CASE("a bowl told by its planes ten times a second is felt as a bowl", "[contact]") {
  // The control is told that it is flat. Late, it pushes aside a hand that strokes, until the ledger is used up.
  for (const auto& [late, most, flat] :
       {std::tuple(0.0, 0.008, 0.03), std::tuple(0.02, 0.01, 0.8), std::tuple(0.05, 0.02, 1.2)}) {
    INFO(late << " s late");
    CHECK(error_in_bowl<plane>(late) < most);
    CHECK(error_in_bowl<ph::quadric<volume>>(late) > flat);
  }
}

TEST_CASE("late planes of any point are bent from where the device was, if their age is told",
          "[contact]") {
  const vector still = vector::Zero();
  for (const double late : {0.02, 0.05}) {
    INFO(late << " s late");
    CHECK(error_in_bowl<plane>(late, true, {.age = late}) < 0.06);
    CHECK(error_in_bowl<plane>(late, true, {.velocity = still, .age = late}) < 0.06);
    CHECK(error_in_bowl<plane>(late, true, {.age = late}, 2) < 0.06);
    CHECK(error_in_bowl<plane>(late, true) > 0.3);  // as it was
  }
}

TEST_CASE("a point of the plane beside the one touched does not lift a surface off the finger",
          "[contact]") {
  // The point of each plane straight below the finger, on a slope: the ball would have fallen away by κ|s|²/2 there.
  told ball;
  double flat = 0.0, bent = 0.0;
  for (int n = 0; n < 40; ++n) {
    const double angle = 0.4 + 2.0 * tremor(n);
    plane p = on_ball(0.0165, angle);
    const vector normal = p.normal, x = (0.0165 - 3e-3) * normal;
    const double up = normal.dot(vector(vector(p.point) - x)) / normal.z();
    p.point = vector(x + vector(0, 0, up));
    ball(p, x);
    if (n < 8) continue;
    flat = std::max(flat, std::abs(p.at(x).depth - 3e-3));
    bent = std::max(bent, std::abs(p.at(x).depth - ball.sag(normal, x) - 3e-3));
  }
  CHECK(flat < 1e-12);
  CHECK(bent < 1e-5);
}
