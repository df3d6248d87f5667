// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"

#include <cmath>
#include <utility>

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

static_assert(ph::port<d1> && ph::port<d2> && ph::port<d3>);
static_assert(ph::port<f1> && ph::port<f2> && ph::port<f3>);
static_assert(ph::port<ph::space<long double, 1>>);
static_assert(!ph::port<double> && !ph::port<ph::spring>);
static_assert(std::same_as<ph::translation<double, 3>, d3>);
static_assert(std::is_trivially_copyable_v<d3::stored_pose>);
static_assert(!std::is_trivially_copyable_v<d3::pose>);  // the control: Eigen's are not

TEST_CASE("one dimension is plain numbers in constant expressions", "[space]") {
  static_assert(d1::between(0.25, 1.0) == 0.75);
  static_assert(d1::squared(-3.0) == 9.0);
  static_assert(d1::work(2.0, -3.0).joules == -6.0);
  static_assert(d1::work(2.0, -3.0).passed == 6.0);
  static_assert(d1::norm(-2.0) == 2.0);
  static_assert(d1::is_finite(1.0) && !d1::is_finite(std::numeric_limits<double>::infinity()));
  static_assert(std::same_as<d1::pose, double> && std::same_as<f1::stored_effort, float>);
  SUCCEED();
}

TEMPLATE_TEST_CASE("the work of an effort and the length of a motion are those of its components",
                   "[space]", d2, f3) {
  using scalar = typename TestType::scalar;
  typename TestType::vector f = TestType::zero(), from = TestType::zero(), to = TestType::zero();
  for (int i = 0; i < TestType::dof; ++i) {
    f(i) = scalar(i % 2 == 0 ? 2 : -3);
    to(i) = scalar(i + 1);
    from(i) = scalar(1);
  }
  const auto dx = TestType::between(from, to);  // 0, 1, 2
  CHECK(dx == to - from);
  CHECK(TestType::squared(dx) == dx.squaredNorm());
  const ph::work_done<scalar> work = TestType::work(f, dx);
  CHECK(work.joules == f.dot(dx));
  CHECK(work.passed == f.cwiseAbs().dot(dx.cwiseAbs()));
  CHECK(work.passed >= std::abs(work.joules));
  CHECK(TestType::scaled(f, scalar(2)) == f * 2);
  CHECK(TestType::zero().norm() == 0);
}

TEMPLATE_TEST_CASE("orthogonal gives the same unit vector across a normal, whichever it is",
                   "[space]", d2, f3) {
  using scalar = typename TestType::scalar;
  const auto eps = std::numeric_limits<scalar>::epsilon();
  for (int i = 0; i < TestType::dof; ++i) {
    for (const scalar side : {scalar(1), scalar(-1)}) {
      typename TestType::vector n = TestType::vector::Constant(scalar(0.1));
      n(i) = side;
      n /= n.norm();
      const typename TestType::vector u = TestType::orthogonal(n);
      CHECK(std::abs(u.dot(n)) <= 4 * eps);
      CHECK(std::abs(u.norm() - 1) <= 4 * eps);
      CHECK(u == TestType::orthogonal(n));
    }
  }
}

TEST_CASE("a stored vector converts to and from the vector it stores", "[space]") {
  const d3::vector v(1, 2, 3);
  const d3::coordinates stored = v;
  CHECK(stored[1] == 2);
  CHECK(d3::vector(stored) == v);
  const d3::coordinates of_expression = 2 * v + d3::vector(0, 0, 1);
  CHECK(of_expression[2] == 7);
  const f3::coordinates of_numbers{1, 2.5, 3};  // numbers of any kind
  CHECK(of_numbers[1] == 2.5F);
  CHECK(d3::vector(d3::coordinates{}) == d3::zero());
  d3::coordinates changed = stored;
  d3::component(changed, 0) = 9;
  CHECK(changed[0] == 9);
  CHECK(d3::component(changed, 2) == 3);
}

TEST_CASE("a vector with one component that is no number is no number", "[space]") {
  for (int i = 0; i < 3; ++i) {
    for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
      d3::vector v(1, 2, 3);
      CHECK(d3::is_finite(v));
      v(i) = bad;
      CHECK_FALSE(d3::is_finite(v));
    }
  }
}

TEST_CASE("the cross product is right-handed", "[space]") {
  const d3::vector x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  CHECK(d3::cross(x, y) == z);
  CHECK(d3::cross(y, z) == x);
  CHECK(d3::cross(y, x) == -z);
}

TEST_CASE("one dimension is plain numbers at run time, too", "[space]") {
  const auto of = [](double a, double b) {
    CHECK(d1::difference(a, b) == a - b);
    CHECK(d1::scaled(a, b) == a * b);
    CHECK(d1::between(a, b) == b - a);
    CHECK(d1::component(std::as_const(a), 0) == a);
    CHECK(d1::is_finite(a));
    CHECK(d1::work(a, b).joules == a * b);
    CHECK(d1::work(a, b).passed == std::abs(a * b));
    CHECK(d1::zero() == 0.0);
    d1::component(b, 0) = a;
    CHECK(b == a);
  };
  of(2.0, -3.0);
  of(0.5, 4.0);
  CHECK_FALSE(d1::is_finite(std::nan("")));
  const d3::coordinates stored(1, 2, 3);
  CHECK(d3::component(stored, 1) == 2);
}
