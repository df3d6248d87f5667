// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/base/samples.hpp>
#include <passive_haptics/contact/proxy.hpp>

using Catch::Matchers::WithinRel;

namespace {

/// Random contacts of one device: directions, depths of either sign, stiffnesses, and (S1) for them.
template <class Space, int Capacity>
struct random_set {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr auto inner = [](const vector& a, const vector& b) { return Space::dot(a, b); };

  ph::proxy_problem<vector, scalar, Capacity> problem{};
  std::array<scalar, static_cast<std::size_t>(Capacity)> depth{}, stiffness{};
  scalar coupling{};

  random_set(ph::laws::samples& random, int count, bool equal = false) {
    scalar stiffest(0);
    for (int i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      stiffness[at] = equal ? scalar(1000) : scalar(1000) * (scalar(1.1) + random.number<scalar>());
      stiffest = std::max(stiffest, stiffness[at]);
      depth[at] = random.number<scalar>() * scalar(2e-3);
      problem.add(random.direction<Space>(), depth[at], scalar(1) / stiffness[at], scalar(0));
    }
    coupling = stiffest / scalar(0.95);
    problem.couple(coupling);
  }
  [[nodiscard]] vector force() const {
    vector sum = Space::zero();
    for (std::size_t i = 0; i < problem.count; ++i) sum += problem.row[i] * problem.pressed[i];
    return sum;
  }
  /// (Aλ − d')_i times K_c [N]: 0 where a contact presses, ≥ 0 where it does not.
  [[nodiscard]] scalar gap(std::size_t i) const {
    const scalar own = problem.own[i] - Space::dot(problem.row[i], problem.row[i]);
    return Space::dot(problem.row[i], force()) + own * problem.pressed[i] - problem.wish[i];
  }
};

}  // namespace

TEMPLATE_TEST_CASE("of up to three contacts exactly those press that must", "[proxy]", d2, d3, f3) {
  using scalar = typename TestType::scalar;
  ph::laws::samples random(1);
  const scalar slack = sizeof(scalar) == 4 ? scalar(2e-4) : scalar(1e-12);
  int pressing[4] = {};
  for (int n = 0; n < 6000; ++n) {
    random_set<TestType, 3> set(random, 1 + n % 3);
    ph::solve(set.problem, set.inner, 1);
    int pressed = 0;
    for (std::size_t i = 0; i < set.problem.count; ++i) {
      const scalar lambda = set.problem.pressed[i], gap = set.gap(i);
      CAPTURE(n, i, lambda, gap);
      CHECK(lambda >= scalar(0));
      CHECK(gap >= -slack);
      CHECK((lambda == scalar(0) || std::abs(gap) <= slack));
      if (lambda > scalar(0)) ++pressed;
    }
    ++pressing[pressed];
  }
  for (const int times : pressing) CHECK(times > 50);  // all cases have been met
}

TEMPLATE_TEST_CASE("sweeps arrive where the closed form is", "[proxy]", d3, f3) {
  using scalar = typename TestType::scalar;
  ph::laws::samples random(2);
  for (int n = 0; n < 300; ++n) {
    random_set<TestType, 4> exact(random, 3);
    auto swept = exact;
    ph::solve(exact.problem, exact.inner, 1);
    ph::detail::solve_by_sweeps(swept.problem, swept.inner, 3000);
    CHECK((swept.force() - exact.force()).norm() <= scalar(2e-4));
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
  const double depth = ph::damped_depth(spring, 1e-3, 0.01);
  one.add(1.0, depth, spring.compliance, 0.0);
  one.couple(500.0 / 0.95);
  ph::solve(
      one, [](double a, double b) { return a * b; }, 1);
  CHECK_THAT(one.pressed[0], WithinRel(0.5 - 2.0 * std::sqrt(50.0) * 0.01, 1e-12));
}

TEST_CASE("on the way in the damper asks for twice what the spring does at most", "[proxy]") {
  const auto s = ph::sampled_spring<double>::of(1000.0, 10.0);
  CHECK(ph::damped_depth(s, 1e-3, -1.0) == 3e-3);
  CHECK(ph::damped_depth(s, 1e-3, -0.05) == 1.5e-3);
  CHECK(ph::damped_depth(s, 1e-3, 0.05) == 0.5e-3);
  CHECK(ph::damped_depth(s, -1e-3, -1.0) == -1e-3);  // outside there is nothing to damp
  CHECK(ph::damped_depth(s, 1e-12, -1.0) < 1e-11);   // so nothing steps at the touch
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
    random_set<d3, 8> here(random, count, true);
    auto there = here;
    const d3::vector move = random.vector<d3>() * 1e-5;
    double sum = 0.0;
    for (std::size_t i = 0; i < here.problem.count; ++i) {
      const double along = -d3::dot(here.problem.row[i], move);
      there.problem.wish[i] += here.coupling * along;
      if (here.depth[i] > 1e-4) sum += 1000.0 * along * along;
    }
    ph::solve(here.problem, here.inner, 4000);
    ph::solve(there.problem, there.inner, 4000);
    const double slope = (there.force() - here.force()).norm() / move.norm();
    steepest = std::max(steepest, slope / here.coupling);
    of_the_sum = std::max(of_the_sum, sum / move.squaredNorm() / here.coupling);
  }
  CHECK(steepest <= 1.0 + 1e-9);
  CHECK(steepest > 0.9);
  CHECK(of_the_sum > 2.0);  // springs that are added are steeper
}
