// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/base/samples.hpp>
#include <passive_haptics/contact/proxy_solver.hpp>

#include <algorithm>
#include <array>
#include <cmath>

using Catch::Matchers::WithinRel;

namespace {

/// Random contacts of one device: directions, depths of either sign, stiffnesses, and (S1) for them.
template <class Space, int Capacity>
struct random_set {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr scalar softness = scalar(0.05);

  ph::proxy_problem<vector, scalar, Capacity> problem{};
  std::array<scalar, static_cast<std::size_t>(Capacity)> depth{};
  scalar stiffest{};

  random_set(ph::laws::samples& random, int count, bool equal = false,
             scalar reach = scalar(2e-3)) {
    for (int i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const scalar power = equal ? scalar(0) : random.number<scalar>();  // 100 N/m to 10 kN/m
      const auto s = ph::sampled_spring<scalar>::of(std::pow(scalar(10), 3 + power), scalar(0));
      stiffest = std::max(stiffest, s.stiffness);
      depth[at] = random.number<scalar>() * reach;
      problem.add(random.direction<Space>(), s.compliance, s, depth[at], scalar(0), scalar(0));
    }
  }
  [[nodiscard]] scalar inner(std::size_t i, std::size_t j) const {
    return (scalar(1) - softness) * Space::dot(problem.row[i], problem.row[j]) *
           std::min(problem.compliance[i], problem.compliance[j]);
  }
  void solve() {
    ph::solve(problem, [this](std::size_t i, std::size_t j) { return inner(i, j); });
  }
  void solve_by_sets() {
    ph::detail::solve_by_sets(problem,
                              [this](std::size_t i, std::size_t j) { return inner(i, j); });
  }
  [[nodiscard]] vector force() const {
    vector sum = Space::zero();
    for (std::size_t i = 0; i < problem.count; ++i) sum += problem.row[i] * problem.pressed[i];
    return sum;
  }
  /// (Aλ − d')_i over A_ii [N]: 0 where a contact presses, ≥ 0 where it does not.
  [[nodiscard]] scalar gap(std::size_t i) const {
    scalar sum = problem.own[i] * problem.pressed[i] - problem.wish[i];
    for (std::size_t j = 0; j < problem.count; ++j) {
      if (j != i) sum += inner(i, j) * problem.pressed[j];
    }
    return sum / problem.own[i];
  }
  /// Is this the one λ ≥ 0 that (S1) has?
  void check() const {
    const scalar slack = sizeof(scalar) == 4 ? scalar(1e-3) : scalar(1e-11);
    for (std::size_t i = 0; i < problem.count; ++i) {
      const scalar lambda = problem.pressed[i], off = gap(i);
      CAPTURE(i, lambda, off);
      CHECK(lambda >= scalar(0));
      CHECK(off >= -slack);
      CHECK((lambda == scalar(0) || std::abs(off) <= slack));
    }
  }
};

}  // namespace

TEMPLATE_TEST_CASE("of up to three contacts exactly those press that must", "[proxy]", d2, d3, f3) {
  ph::laws::samples random(1);
  int pressing[4] = {};
  for (int n = 0; n < 4000; ++n) {
    random_set<TestType, 3> set(random, 1 + n % 3);
    for (std::size_t i = 0; i < 3; ++i) {  // with what they pressed before, and what is beyond them
      if (i < set.problem.count) set.problem.pressed[i] = typename TestType::scalar(n / 3 % 2);
      if (i >= set.problem.count) set.problem.wish[i] = typename TestType::scalar(n / 3 % 2);
    }
    set.solve();
    CAPTURE(n);
    set.check();
    int pressed = 0;
    for (std::size_t i = 0; i < set.problem.count; ++i) {
      if (set.problem.pressed[i] > 0) ++pressed;
    }
    ++pressing[pressed];
  }
  for (const int times : pressing) CHECK(times > 50);  // all cases have been met
}

TEST_CASE(
    "a third contact that two others just leave nothing to press never pulls, however it rounds",
    "[proxy]") {
  ph::laws::samples random(6);
  std::array<int, 3> rounded{};  // to more than nothing
  for (int n = 0; n < 20000; ++n) {
    random_set<f3, 3> set(random, 3);
    const std::size_t k = static_cast<std::size_t>(n % 3), i = (k + 1) % 3, j = (k + 2) % 3;
    const float press[2]{std::abs(random.number<float>()), std::abs(random.number<float>())};
    set.problem.wish[i] = set.problem.own[i] * press[0] + set.inner(i, j) * press[1];
    set.problem.wish[j] = set.problem.own[j] * press[1] + set.inner(i, j) * press[0];
    set.problem.wish[k] = set.inner(i, k) * press[0] + set.inner(j, k) * press[1];
    set.solve();
    for (const float lambda : set.problem.pressed) REQUIRE(lambda >= 0.0F);
    rounded[k] += set.problem.pressed[k] > 0.0F ? 1 : 0;
  }
  CHECK(std::min({rounded[0], rounded[1], rounded[2]}) > 20);
}

TEMPLATE_TEST_CASE(
    "a contact that another just leaves nothing to press takes no force away, however it rounds",
    "[proxy]", d3, f3) {
  using scalar = typename TestType::scalar;
  ph::laws::samples random(7);
  int lost = 0;
  for (int n = 0; n < 60000; ++n) {
    random_set<TestType, 3> set(random, 2 + n % 2);
    auto& p = set.problem;
    const auto i = static_cast<std::size_t>(n / 2 % 2), j = 1 - i;
    const scalar press = std::abs(random.number<scalar>()) + scalar(0.1);  // [N]
    p.wish[i] = p.own[i] * press;
    p.wish[j] = set.inner(i, j) * press;
    for (int off = n / 4 % 3; off > 0; --off)
      p.wish[j] = std::nextafter(p.wish[j], n % 8 < 4 ? scalar(1) : scalar(-1));
    p.wish[2] = scalar(-1);  // [m]: where there is a third contact it is far away
    set.solve();
    lost += std::abs(p.pressed[i] - press) < scalar(1e-4) * press ? 0 : 1;
  }
  CHECK(lost == 0);
}

TEST_CASE("of contacts none of which is entered none presses, though one is touched", "[proxy]") {
  // All three rows at once would be pressed with A⁻¹d', which is more than 0 in the one that is touched.
  for (const std::size_t touched : {0U, 1U, 2U}) {
    ph::proxy_problem<double, double, 3> p{};
    p.count = 3;
    for (std::size_t i = 0; i < 3; ++i) {
      p.own[i] = 1.0;
      p.wish[i] = i == touched ? 0.0 : -1.0;
    }
    ph::solve(p, [touched](std::size_t i, std::size_t j) {
      return i == touched || j == touched ? 0.5 : 0.0;
    });
    for (const double lambda : p.pressed) CHECK(lambda == 0.0);
  }
}

TEMPLATE_TEST_CASE("of sixteen contacts, too, from whatever they pressed with before", "[proxy]",
                   d2, d3, f3) {
  using scalar = typename TestType::scalar;
  ph::laws::samples random(2);
  for (int n = 0; n < 300; ++n) {
    random_set<TestType, 16> set(random, 4 + n % 13, n % 2 == 0);
    if (n % 3 != 0) {  // a good guess, a bad one, none
      for (std::size_t i = 0; i < set.problem.count; ++i) {
        set.problem.pressed[i] = std::max(random.number<scalar>() * scalar(3), scalar(0));
      }
    }
    set.solve();
    CAPTURE(n);
    set.check();
  }
}

TEST_CASE("with each change of a set the energy falls, and none of it ever pulls", "[proxy]") {
  ph::laws::samples random(6);
  int stopped = 0;
  for (int n = 0; n < 200; ++n) {
    random_set<d3, 8> set(random, 8);
    auto& p = set.problem;
    for (std::size_t i = 0; i < p.count; ++i) {
      p.pressed[i] = std::max(random.number<double>() * 3.0, 0.0);
    }
    const auto energy = [&] {  // ½ λᵀAλ − d'ᵀλ [J]
      double sum = 0.0;
      for (std::size_t i = 0; i < p.count; ++i) {
        sum += 0.5 * p.pressed[i] * (set.gap(i) * p.own[i] - p.wish[i]);
      }
      return sum;
    };
    ph::detail::active_set<d3::vector, double, 8> pressing(p);
    double last = energy();
    for (int step = 0; step < 9; ++step) {
      const bool whole = pressing.step([&](auto i, auto j) { return set.inner(i, j); });
      CAPTURE(n, step);
      REQUIRE(energy() <= last + 1e-15);
      REQUIRE(*std::min_element(p.pressed.begin(), p.pressed.end()) >= 0.0);
      last = energy();
      if (whole) break;
      ++stopped;
    }
  }
  CHECK(stopped > 100);
}

TEST_CASE("copies of one wall are that wall, and need no more than its own set", "[proxy]") {
  ph::laws::samples random(3);
  random_set<d3, 16> copies(random, 0);
  const auto s = ph::sampled_spring<double>::of(1000.0, 0.0);
  for (int i = 0; i < 16; ++i) {
    copies.problem.add(d3::vector(0, 0, 1), s.compliance, s, 1e-3, 0.0, 0.0);
  }
  copies.solve();
  copies.check();
  CHECK(copies.force()(2) > 1.0);  // K d, ε softer together
  CHECK(copies.force()(2) < 1.0 / 0.95);
}

TEMPLATE_TEST_CASE("the sets arrive where the closed form is", "[proxy]", d3, f3) {
  using scalar = typename TestType::scalar;
  ph::laws::samples random(2);
  for (int n = 0; n < 300; ++n) {
    random_set<TestType, 4> exact(random, 3);
    auto by_sets = exact;
    exact.solve();
    by_sets.solve_by_sets();
    CHECK((by_sets.force() - exact.force()).norm() <= scalar(2e-4));
    // Whatever pressed in the last tick: a λ that rounding has left of one stops no other.
    const scalar least = std::numeric_limits<scalar>::denorm_min();
    for (const scalar left : {least, scalar(9) * least, scalar(1e-30), scalar(1)}) {
      auto from_there = by_sets;
      for (std::size_t i = 0; i < 3; ++i) from_there.problem.pressed[i] = i == 0 ? left : 1;
      from_there.solve_by_sets();
      CHECK((from_there.force() - exact.force()).norm() <= scalar(2e-4));
    }
  }
}

TEST_CASE("a wall that does not press is not felt, however stiff", "[proxy]") {
  ph::laws::samples random(5);
  for (int n = 0; n < 200; ++n) {
    random_set<d3, 3> two(random, 2, false);
    auto three = two;
    const auto hard = ph::sampled_spring<double>::of(1e5, 0.0);
    three.problem.add(random.direction<d3>(), hard.compliance, hard, -0.05, 0.0, 0.0);
    two.solve();
    three.solve();
    CHECK(three.force() == two.force());
  }
}

TEST_CASE("one contact alone is the spring and the damper that it asks for", "[proxy]") {
  ph::proxy_spring::at<double> rule({.mass = 0.1});
  rule.adopt(1e-3);
  const auto spring = rule.sampled(500.0);
  CHECK(spring.stiffness == 500.0);
  CHECK_THAT(spring.settling, WithinRel(2.0 * std::sqrt(50.0) / 500.0, 1e-12));
  CHECK(rule.sampled(1e9).stiffness == 0.95 * 0.1 * 0.1 / 1e-6);  // (1 − ε) κ m/T²
  ph::proxy_problem<double, double, 1> one;
  one.add(1.0, spring.compliance, spring, 1e-3, 0.01, 0.0);
  ph::solve(one, [](std::size_t, std::size_t) { return 0.0; });
  CHECK_THAT(one.pressed[0], WithinRel(0.5 - 2.0 * std::sqrt(50.0) * 0.01, 1e-12));
}

TEST_CASE("on the way in the damper asks for twice what the spring does at most", "[proxy]") {
  const auto s = ph::sampled_spring<double>::of(1000.0, 10.0);
  CHECK(ph::damped_depth(s, 1e-3, -1.0, 0.0) == 3e-3);
  CHECK(ph::damped_depth(s, 1e-3, -0.05, 0.0) == 1.5e-3);
  CHECK(ph::damped_depth(s, 1e-3, 0.05, 0.0) == 0.5e-3);
  CHECK(ph::damped_depth(s, -1e-3, -1.0, 0.0) == -1e-3);  // what is not touched is not felt
  CHECK(ph::damped_depth(s, 1e-12, -1.0, 0.0) < 1e-11);   // so nothing steps at the touch
  CHECK(ph::damped_depth(s, -1e-3, -1.0, 3.0) == 1e-3);   // the others press it: 2 mm of its 3 N
  CHECK(ph::damped_depth(s, -1e-3, 0.05, 3.0) == -1.5e-3);
}

TEST_CASE("what settles is what the circle condition says, and what rings is refused", "[proxy]") {
  STATIC_REQUIRE(ph::settles(0.1, 5.0));  // the default, by a factor of 3
  STATIC_REQUIRE(ph::settles(0.327, 5.0));
  STATIC_REQUIRE_FALSE(ph::settles(0.328, 5.0));
  STATIC_REQUIRE_FALSE(ph::settles(0.1, 1.0));
  STATIC_REQUIRE_FALSE(ph::settles(0.1, 5.0, 1));
  CHECK_FALSE(ph::settles(0.1, 1.0));  // damped by less than a tick of its own force
  CHECK_FALSE(ph::settles(0.0, 5.0));
  CHECK_FALSE(ph::settles(0.1, 5.0, -1));
  CHECK(ph::settles(0.0972, 5.0, 1));
  CHECK_FALSE(ph::settles(0.0974, 5.0, 1));
  CHECK(ph::settles(0.0215, 5.0, 3));
  CHECK_FALSE(ph::settles(0.0217, 5.0, 3));
  CHECK((ph::proxy_spring{.mass = 0.1, .stiffness_fraction = 1.0}.check().parameter ==
         std::string_view("stiffness_fraction")));
  CHECK_FALSE(ph::proxy_spring{.mass = 0.1, .damping_ratio = 0.0}.check());  // asked for
  CHECK_FALSE(ph::proxy_spring{.mass = 0.1, .softness = 0.001}.check());     // the least there is
}

TEST_CASE("a contact comes to rest where it does beside others, which are stiffer by 1/(1 − ε)",
          "[proxy]") {
  constexpr double T = 1e-3, m = 0.1;
  std::array<int, 2> met{};
  for (const int late : {0, 1, 3}) {
    for (const double softness : {0.001, 0.1, 0.5}) {
      for (double fraction = 0.05; fraction < 1.0; fraction *= 1.1) {
        ph::proxy_spring::at<double> rule({.mass = m,
                                           .stiffness_fraction = fraction,
                                           .damping_ratio = 0.5,
                                           .damping_fraction = 0.8,
                                           .softness = softness});
        rule.adopt(T, late);
        for (double K = 1e3; K < 1e6; K *= 1.5) {
          const auto s = rule.sampled(K);
          const double others = s.stiffness / (1.0 - softness);
          const bool rests = ph::settles(others * T * T / m, s.settling / T, late);
          CAPTURE(late, softness, fraction, K);
          CHECK(rule.settles(K) == rests);
          ++met[rests ? 1 : 0];
        }
      }
    }
  }
  CHECK(met[0] > 100);
  CHECK(met[1] > 100);
}

TEST_CASE("a contact that is hardly damped is damped as much as a late loop needs", "[proxy]") {
  constexpr double T = 1e-3, m = 0.1;
  int accepted = 0;
  for (int late = 0; late <= 4; ++late) {
    for (double fraction = 0.01; fraction < 0.7; fraction *= 1.4) {
      for (const double ratio : {0.1, 0.2, 0.4, 1.0, 3.0}) {
        for (const double damping : {0.02, 0.1, 0.5, 1.0}) {
          const ph::proxy_spring p{.mass = m,
                                   .stiffness_fraction = fraction,
                                   .damping_ratio = ratio,
                                   .damping_fraction = damping};
          if (p.check()) continue;
          ++accepted;
          ph::proxy_spring::at<double> rule(p);
          rule.adopt(T, late);
          CAPTURE(late, fraction, ratio, damping);
          CHECK(rule.settles(1e9));
          CHECK(rule.settles(0.3 * rule.sampled(1e9).stiffness));
        }
      }
    }
  }
  CHECK(accepted > 300);
  CHECK_FALSE(ph::settles(0.05, 1.2, 1));  // the control: what on time is enough
  CHECK(ph::settles(0.05, 1.2));
  ph::proxy_spring::at<double> undamped({.mass = m, .damping_ratio = 0.0});
  undamped.adopt(T, 1);
  CHECK(undamped.sampled(1e4).settling == 0.0);
  CHECK_FALSE(undamped.settles(1e4));
}

TEST_CASE("a contact of any stiffness settles, however late", "[proxy]") {
  constexpr double T = 1e-3, m = 0.1;
  for (int late = 0; late <= 16; ++late) {
    ph::proxy_spring::at<double> rule({.mass = m});
    rule.adopt(T, late);
    double stiffest = 0.0;
    for (double K = 1.0; K < 1e6; K *= 1.5) {
      const auto s = rule.sampled(K);
      CAPTURE(late, K, s.stiffness, s.settling);
      CHECK(ph::settles(s.stiffness * T * T / m, s.settling / T, late));
      CHECK(rule.settles(K));
      stiffest = std::max(stiffest, s.stiffness);
    }
    if (late > 0) {  // no more than a factor of 2.5 is given away at that damping
      CHECK_FALSE(ph::settles(2.5 * stiffest * T * T / m, 2.25 * (late + 1), late));
    }
  }
}

TEST_CASE("where the motors end a contact is the secant", "[proxy]") {
  const ph::proxy_spring::at<double> rule({.mass = 0.1, .force_limit = 5.0});
  const auto s = ph::sampled_spring<double>::of(1000.0, 20.0);
  CHECK_FALSE(rule.saturates(s, 4e-3));
  CHECK(rule.saturates(s, 0.05));
  const auto deep = rule.saturated(s, 0.05);
  CHECK_THAT(deep.stiffness * 0.05, WithinRel(5.0, 1e-12));
  CHECK_THAT(deep.settling * 100.0, WithinRel(2.0 * std::sqrt(100.0 * 0.1), 1e-12));
}

TEST_CASE("however many planes, the force changes by no more than the coupling allows", "[proxy]") {
  ph::laws::samples random(3);
  double steepest = 0.0, of_the_sum = 0.0;
  for (int n = 0; n < 2000; ++n) {
    const int count = 2 + n % 7;
    random_set<d3, 8> here(random, count);
    auto there = here;
    const d3::vector move = random.vector<d3>() * 1e-7;
    double sum = 0.0;
    for (std::size_t i = 0; i < here.problem.count; ++i) {
      const double along = -d3::dot(here.problem.row[i], move);
      there.problem.wish[i] += along;
      if (here.depth[i] > 1e-4) sum += along * along / here.problem.compliance[i];
    }
    here.solve();
    there.solve();
    double stiffest = 0.0;  // of those that press
    for (const auto* set : {&here, &there}) {
      for (std::size_t i = 0; i < set->problem.count; ++i) {
        if (set->problem.pressed[i] > 0.0) {
          stiffest = std::max(stiffest, 1.0 / set->problem.compliance[i]);
        }
      }
    }
    if (stiffest == 0.0) continue;
    const double coupling = stiffest / (1.0 - random_set<d3, 8>::softness);
    const double slope = (there.force() - here.force()).norm() / move.norm();
    steepest = std::max(steepest, slope / coupling);
    of_the_sum = std::max(of_the_sum, sum / move.squaredNorm() / coupling);
  }
  CHECK(steepest <= 1.0 + 1e-6);
  CHECK(steepest > 0.9);
  CHECK(of_the_sum > 2.0);  // springs that are added are steeper
}

TEST_CASE("a spring for slots is what its parameters say, in numbers that nothing rounds",
          "[proxy]") {
  ph::proxy_spring p{.mass = 2.0,
                     .stiffness_fraction = 0.25,
                     .damping_ratio = 0.5,
                     .damping_fraction = 0.5,
                     .softness = 0.5,
                     .force_limit = 4.0,
                     .most = 1000.0};
  const auto rule = [&p] {
    ph::proxy_spring::at<double> made(p);
    made.adopt(1.0 / 64.0);
    return made;
  };
  const auto told = rule().parameters();
  CHECK(told.mass == 2.0);
  CHECK(told.stiffness_fraction == 0.25);
  CHECK(told.damping_ratio == 0.5);
  CHECK(told.damping_fraction == 0.5);
  CHECK(told.softness == 0.5);
  CHECK(told.force_limit == 4.0);
  CHECK(told.most == 1000.0);
  CHECK(rule().softness() == 0.5);
  // (1 − ε) κ m/T² is 1024 N/m, 2ζ√(Km) of 512 N/m is 32 N·s/m, and β m/T 64
  CHECK(rule().sampled(512.0).stiffness == 512.0);
  CHECK(rule().sampled(512.0).settling == 1.0 / 16.0);
  CHECK(rule().sliding(rule().sampled(512.0)) == 1.0 / 16.0);
  CHECK(rule().sampled(2000.0).stiffness == 1000.0);
  CHECK(rule().softener(1000.0) == ph::softened_by::coupling);
  CHECK(rule().softener(1001.0) == ph::softened_by::encoder_steps);
  p.most = 1024.0;
  CHECK(rule().softener(2000.0) == ph::softened_by::encoder_steps);
  p.most = 1025.0;
  CHECK(rule().sampled(2000.0).stiffness == 1024.0);
  CHECK(rule().softener(2000.0) == ph::softened_by::mass_and_tick);
  using spring = ph::sampled_spring<double>;
  CHECK_FALSE(rule().saturates(spring::of(1024.0, 8.0), 1.0 / 256.0));  // just 4 N
  CHECK(rule().saturates(spring::of(1024.0, 8.0), 1.01 / 256.0));
  const auto deep = rule().saturated(spring::of(1024.0, 64.0), 1.0 / 32.0);
  CHECK(deep.stiffness == 128.0);
  CHECK(deep.settling == 16.0 / 128.0);
  CHECK(rule().saturated(spring::of(1024.0, 8.0), 1.0 / 32.0).settling == 8.0 / 128.0);
}

TEST_CASE("what a spring for slots may not be told is refused with its name, up to the very limit",
          "[proxy]") {
  const auto refused = [](double ph::proxy_spring::*member, double value) {
    ph::proxy_spring p{.mass = 0.1};
    p.*member = value;
    const auto fault = p.check();
    return std::string_view(fault ? fault.parameter : "");
  };
  using p = ph::proxy_spring;
  CHECK(refused(&p::mass, 0.0) == "mass");
  CHECK(refused(&p::stiffness_fraction, 0.0) == "stiffness_fraction");
  CHECK(refused(&p::stiffness_fraction, 1.5) == "stiffness_fraction");
  CHECK(refused(&p::damping_ratio, -0.1) == "damping_ratio");
  CHECK(refused(&p::damping_fraction, -0.1) == "damping_fraction");
  CHECK(refused(&p::damping_fraction, 0.0).empty());
  CHECK(refused(&p::damping_fraction, 1.0).empty());
  CHECK(refused(&p::damping_fraction, 1.1) == "damping_fraction");
  CHECK(refused(&p::softness, 0.0) == "softness");
  CHECK(refused(&p::softness, 1.0) == "softness");
  CHECK(refused(&p::force_limit, 0.0) == "force_limit");
  CHECK(refused(&p::most, 0.0) == "most");
  const ph::detail::late_limits<double> late(1);  // 0.2 and 0.9/2 over (k + 1)²
  CHECK(late.stiffness == 0.05);
  CHECK(late.ticks == 4.5);
  CHECK(late.least_ticks == 3.0);
  CHECK_THAT(late.damping, WithinRel(0.225, 1e-15));
  CHECK(ph::detail::late_limits<double>(1, 6.0).ticks == 12.0);
  CHECK(ph::detail::late_limits<double>(0).ticks == 5.0);
  CHECK(ph::detail::late_limits<double>(0).least_ticks == 0.0);
}

namespace {

/// Contacts that do not feel each other: A is the identity, so each is to press with λ = d'.
ph::proxy_problem<double, double, 4> unrelated(const std::array<double, 4>& wish,
                                               const std::array<double, 4>& pressed) {
  ph::proxy_problem<double, double, 4> p{};
  p.count = 4;
  p.own = {1.0, 1.0, 1.0, 1.0};
  p.wish = wish;
  p.pressed = pressed;
  return p;
}
constexpr auto nothing_between = [](std::size_t, std::size_t) { return 0.0; };
using unrelated_set = ph::detail::active_set<double, double, 4>;

}  // namespace

TEST_CASE("contacts that a step brings to nothing together leave together", "[proxy]") {
  auto p = unrelated({-1.0, 2.0, -1.0, 3.0}, {0.5, 1.0, 0.5, 1.0});
  unrelated_set set(p);
  CHECK_FALSE(set.step(nothing_between));  // a third of the way
  CHECK_FALSE(set.has(0));
  CHECK_FALSE(set.has(2));
  CHECK(p.pressed[0] == 0.0);
  CHECK(p.pressed[2] == 0.0);
  CHECK(p.pressed[1] == Approx(4.0 / 3.0));
  CHECK(set.step(nothing_between));
  CHECK(p.pressed == std::array<double, 4>{0.0, 2.0, 0.0, 3.0});
}

TEST_CASE("a contact that is to press with nothing leaves, and one that is to press stays",
          "[proxy]") {
  auto p = unrelated({0.0, 2.0, -1.0, 3.0}, {1.0, 1.0, 0.0, 1.0});
  unrelated_set set(p);
  CHECK(set.step(nothing_between));
  CHECK(p.pressed == std::array<double, 4>{0.0, 2.0, 0.0, 3.0});
  CHECK_FALSE(set.has(0));
  CHECK(set.has(1));
  auto q = unrelated({0.5, 2.0, -1.0, 3.0}, {0.0, 1.0, 0.0, 1.0});
  unrelated_set two(q);
  two.join(0);
  two.join(2);  // which is to pull, and stops all of the step
  CHECK_FALSE(two.step(nothing_between));
  CHECK(two.has(0));
  CHECK_FALSE(two.has(2));
  CHECK(two.step(nothing_between));
  CHECK(q.pressed == std::array<double, 4>{0.5, 2.0, 0.0, 3.0});
}

TEST_CASE("contacts that all have to change places do, in more steps than there are contacts",
          "[proxy]") {
  auto p = unrelated({-1.0, -2.0, 2.0, 3.0}, {0.5, 2.0, 0.0, 0.0});
  ph::solve(p, nothing_between);
  CHECK(p.pressed == std::array<double, 4>{0.0, 0.0, 2.0, 3.0});
}

TEST_CASE(
    "what rounding left of a contact leaves, and neither one that is to press nor a larger one",
    "[proxy]") {
  for (const double wanted : {0.5, 5.0}) {
    auto p = unrelated({-0.5, -0.1, wanted, -1.0}, {1.0, 4e-323, 5e-324, 0.5});
    unrelated_set set(p);
    CHECK_FALSE(set.step(nothing_between));  // a share of 4e-322, which is no step at all
    CHECK(set.has(0));
    CHECK_FALSE(set.has(1));
    CHECK(set.has(2));
    CHECK(set.has(3));
  }
  auto p = unrelated({0.4, -1.4, -1.0, 5.0}, {5e-324, 1e-323, 0.5, 1.0});
  unrelated_set set(p);
  CHECK_FALSE(set.step(nothing_between));  // after which the first two are 5e-324
  CHECK(set.has(0));
  CHECK_FALSE(set.has(1));
  CHECK(set.has(2));
  CHECK(set.has(3));
}

TEST_CASE("what a contact lacks by rounding of the largest depth does not make it press",
          "[proxy]") {
  const double slack = ph::kernels::rounding<double>();
  for (const std::size_t deepest : {0U, 2U}) {
    for (const double depth : {1.0, 4.0}) {
      std::array<double, 4> wish{-0.25, -0.25, -0.25, -0.25};
      wish[deepest] = depth;
      for (const double lack : {0.5, 1.0, 1.5}) {
        wish[1] = lack * slack * depth;
        auto p = unrelated(wish, {});
        ph::solve(p, nothing_between);
        CAPTURE(deepest, depth, lack);
        CHECK(p.pressed[1] == (lack > 1.0 ? wish[1] : 0.0));
        CHECK(p.pressed[deepest] == depth);
      }
    }
  }
}

TEMPLATE_TEST_CASE("what is far away takes nothing from what is pressed", "[proxy]", d3, f3) {
  using scalar = typename TestType::scalar;
  using plane = ph::half_space<TestType>;
  const auto force = [](scalar far) {
    ph::passive_port port{
        TestType{},
        ph::contact_set{ph::proxy_spring{.mass = 0.1}, ph::pursuit{}, ph::slots<plane, 4>{}},
        ph::no_observer{}, ph::no_bound{}, ph::loop_limits{.longest_tick = 1e-3}};
    port.source().update(0, plane{{0, 0, scalar(1e-3)}, {0, 0, 1}, 1000});
    port.source().update(1, plane{{scalar(1e-3), 0, 0}, {1, 0, 0}, 1000});
    port.source().update(2, plane{{0, -1, 0}, {0, 1, 0}, 1000});
    port.source().update(3, plane{{0, -far, 0}, {0, 1, 0}, 1000});
    typename TestType::vector f = TestType::zero();
    for (int n = 0; n < 200; ++n) f = port.tick(TestType::zero(), ph::seconds{scalar(1e-3)}).force;
    return f;
  };
  const auto near = force(1);
  CHECK(near.norm() > scalar(1.4));
  for (const scalar far : {scalar(1e4), scalar(1e12), scalar(1e17)}) {
    CAPTURE(far);
    CHECK((force(far) - near).norm() == scalar(0));
  }
}
