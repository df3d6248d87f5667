// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/constraint_geometry/triangle_point.hpp>

#include <algorithm>
#include <array>
#include <random>

using Catch::Matchers::WithinAbs;

namespace {

ph::triangle<d3> right_triangle() {
  ph::triangle<d3> t{.a = {0, 0, 0}, .b = {0.02, 0, 0}, .c = {0, 0.02, 0}, .stiffness = 1000};
  REQUIRE(t.prepare());
  return t;
}

/// Barycentric inside test of the projection: an independent way.
bool inside_by_areas(const d3::vector& a, const d3::vector& b, const d3::vector& c,
                     const d3::vector& n, const d3::vector& x) {
  const d3::vector p = x + n * (a - x).dot(n);
  const double area = d3::cross(b - a, c - a).dot(n);
  const double u = d3::cross(c - b, p - b).dot(n) / area;
  const double v = d3::cross(a - c, p - c).dot(n) / area;
  return u >= 0 && v >= 0 && 1 - u - v >= 0;
}

}  // namespace

TEST_CASE("triangle's outward normal follows its nodes' order", "[geometry]") {
  const auto t = right_triangle();
  CHECK(t.at({0, 0, 0}).outward() == d3::vector(0, 0, 1));
  CHECK(t.at({0, 0, -0.001}).depth == 0.001);
  CHECK(t.at({0, 0, 0.001}).depth == -0.001);
}

TEST_CASE("triangle covers what lies behind it, whatever the height (2.20-2.23, A14-A16)",
          "[geometry]") {
  std::mt19937 seed(11);
  std::normal_distribution<double> gauss;
  int in = 0, out = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto random = [&]() -> d3::vector {
      return d3::vector(gauss(seed), gauss(seed), gauss(seed));
    };
    const d3::vector a = random(), b = random(), c = random(), x = 0.5 * random();
    ph::triangle<d3> t{.a = a, .b = b, .c = c, .stiffness = 1};
    if (!t.prepare()) continue;
    const d3::vector n = t.at(x).outward();
    const bool inside = inside_by_areas(a, b, c, n, x);
    if (t.at(x).covered() != inside) FAIL("case " << i);
    if (t.at(x + 3.0 * n).covered() != inside) FAIL("case " << i << " raised");
    (inside ? in : out)++;
  }
  CHECK(in > 1000);
  CHECK(out > 1000);
}

TEST_CASE("the edge test with P in place of P' gives the same answer (A15)", "[geometry]") {
  std::mt19937 seed(12);
  std::normal_distribution<double> gauss;
  for (int i = 0; i < 20000; ++i) {
    const auto random = [&]() -> d3::vector {
      return d3::vector(gauss(seed), gauss(seed), gauss(seed));
    };
    const d3::vector a = random(), b = random(), c = random(), x = random();
    const d3::vector n = d3::cross(b - a, c - a).normalized();
    const d3::vector projected = x + n * (a - x).dot(n);
    const auto side = [&](const d3::vector& p) {
      return d3::cross(a - b, a - p).dot(d3::cross(a - b, a - c));  // (2.21)
    };
    if (std::abs(side(projected)) < 1e-9) continue;
    if ((side(x) >= 0) != (side(projected) >= 0)) FAIL("case " << i);
  }
  SUCCEED();
}

TEST_CASE("triangle ends at its thickness (A18)", "[geometry]") {
  auto t = right_triangle();
  const d3::vector deep(0.005, 0.005, -0.03);
  CHECK(t.at(deep).covered());
  t.thickness = 0.01;
  REQUIRE(t.prepare());
  CHECK_FALSE(t.at(deep).covered());
  CHECK(t.at({0.005, 0.005, -0.009}).covered());
  CHECK(t.at({0.005, 0.005, -0.01}).covered());
  for (const d3::vector& node : {d3::vector(t.a), d3::vector(t.b), d3::vector(t.c)}) {
    CHECK(t.at(node).covered());  // nodes and edges are its own: two triangles leave no gap
  }
}

TEMPLATE_TEST_CASE("degenerate and useless constraints are refused (A17)", "[geometry]", d3, f3) {
  using scalar = typename TestType::scalar;
  const scalar nan = std::numeric_limits<scalar>::quiet_NaN();
  const scalar inf = std::numeric_limits<scalar>::infinity();
  const auto usable = [](ph::triangle<TestType> t) { return t.prepare(); };
  const ph::triangle<TestType> good{.a = {0, 0, 0}, .b = {1, 0, 0}, .c = {0, 1, 0}, .stiffness = 1};
  CHECK(usable(good));
  auto t = good;
  t.c = {2, 0, 0};
  CHECK_FALSE(usable(t));  // collinear
  t.c = t.b = t.a;
  CHECK_FALSE(usable(t));  // a point
  const scalar huge = std::pow(ph::kernels::largest<scalar>(), scalar(0.3));
  t = {.a = {0, 0, 0}, .b = {huge, 0, 0}, .c = {0, huge, 0}, .stiffness = 1};
  CHECK_FALSE(usable(t));  // finite, and the square of its area is not
  for (const scalar off : {scalar(4096), scalar(-4096)}) {  // large enough, wherever it is
    CHECK(usable({.a = {off, 0, 0}, .b = {off + 1, 0, 0}, .c = {off, 1, 0}, .stiffness = 100}));
    CHECK(usable({.a = {0, off, 0}, .b = {1, off, 0}, .c = {0, off + 1, 0}, .stiffness = 100}));
  }
  for (const scalar bad : {nan, inf, -inf}) {
    t = good;
    t.b = {bad, 0, 0};
    CHECK_FALSE(usable(t));
    t = good;
    t.stiffness = bad;
    CHECK_FALSE(usable(t));
  }
  for (const scalar K : {scalar(0), scalar(-5)}) {
    t = good;
    t.stiffness = K;
    CHECK_FALSE(usable(t));
  }
}

TEST_CASE("of a triangle no point is closer than the closest, whatever side it is seen from",
          "[geometry]") {
  std::mt19937 seed(13);
  std::normal_distribution<double> gauss;
  const auto random = [&]() -> d3::vector {
    return d3::vector(gauss(seed), gauss(seed), gauss(seed));
  };
  std::array<int, 4> parts{};  // corners that have a part in it: a corner, an edge, the face
  for (int i = 0; i < 3000; ++i) {
    const std::array<d3::vector, 3> corner{random(), random(), random()};
    const d3::vector x = 2.0 * random();
    const auto found = ph::detail::closest_on_triangle<d3>(corner[0], corner[1], corner[2], x);
    d3::vector sum = d3::zero();
    double all = 0.0;
    std::size_t have = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      REQUIRE(found.weights[k] >= 0.0);
      have += found.weights[k] > 0.0 ? 1 : 0;
      all += found.weights[k];
      sum += corner[k] * found.weights[k];
    }
    ++parts[have];
    REQUIRE_THAT(all, WithinAbs(1.0, 1e-12));
    REQUIRE((sum - found.point).norm() < 1e-9);
    for (const d3::vector& one : corner) {  // no way to a corner leads nearer, so no way at all
      REQUIRE((x - found.point).dot(one - found.point) < 1e-9);
    }
  }
  CHECK(std::min({parts[1], parts[2], parts[3]}) > 100);
}

TEST_CASE("nodes follow the lines of Fig. 2.5 where those meet the new plane", "[geometry]") {
  const auto own = right_triangle();
  auto target = own;
  target.a = {0.001, 0, 0.004};
  target.b = {0.021, 0, 0.004};
  target.c = {0.001, 0.02, 0.004};
  REQUIRE(target.prepare());
  const d3::vector x(0.004, 0.004, -0.001);
  const auto moved = own.toward(target, x, {0, 0, 1}, 0.003);  // plane at z = 0.002, half way
  const d3::vector a = moved.a, b = moved.b, c = moved.c;
  CHECK((a - d3::vector(0.0005, 0, 0.002)).norm() < 1e-15);
  CHECK((b - d3::vector(0.0205, 0, 0.002)).norm() < 1e-15);
  CHECK((c - d3::vector(0.0005, 0.02, 0.002)).norm() < 1e-15);
  CHECK_THAT(moved.at(x).depth, WithinAbs(0.003, 1e-15));
}

TEST_CASE("a constraint that starts from its target is shifted as in (2.33)", "[geometry]") {
  const auto target = right_triangle();
  const d3::vector x(0.004, 0.004, -0.005);  // dVE = 5 mm, allowed 2 mm
  const auto moved = target.toward(target, x, target.at(x).outward(), 0.002);
  const d3::vector a = moved.a, b = moved.b, c = moved.c;
  const d3::vector down(0, 0, -0.003);  // −(dVE − dmax) n
  CHECK((a - down).norm() < 1e-15);
  CHECK((b - d3::vector(0.02, 0, 0) - down).norm() < 1e-15);
  CHECK((c - d3::vector(0, 0.02, 0) - down).norm() < 1e-15);
}

TEST_CASE("clamped and projected nodes keep the triangle whole where bare lines flip it (A22)",
          "[geometry]") {
  std::mt19937 seed(22);
  std::normal_distribution<double> gauss;
  int outside = 0, bare_flips = 0, flips = 0, cases = 0;
  const auto own = right_triangle();
  for (int i = 0; i < 20000; ++i) {
    const auto noise = [&]() -> d3::vector {
      return 1.5e-3 * d3::vector(gauss(seed), gauss(seed), gauss(seed));
    };
    auto target = own;
    target.a = d3::vector(own.a) + noise();
    target.b = d3::vector(own.b) + noise();
    target.c = d3::vector(own.c) + noise();
    if (!target.prepare()) continue;
    ++cases;
    const d3::vector n = ph::turn_limited::on<d3>({.rate = 8.7})
                             .step(own.normal, target.normal,
                                   1e-3);  // 0.5 degrees
    const d3::vector x(0.006, 0.006, -0.002);
    const d3::vector p = x + n * 0.002;
    bool out = false;
    std::array<d3::vector, 3> bare{x, x, x};
    const std::array<d3::vector, 3> from{own.a, own.b, own.c}, to{target.a, target.b, target.c};
    for (std::size_t k = 0; k < 3; ++k) {
      const d3::vector line = to[k] - from[k];
      const double t = (p - from[k]).dot(n) / line.dot(n);
      out = out || t < 0 || t > 1;
      bare[k] = from[k] + t * line;
    }
    outside += out ? 1 : 0;
    const auto flipped = [&n](const d3::vector& a, const d3::vector& b, const d3::vector& c) {
      return d3::cross(b - a, c - a).dot(n) <= 0;
    };
    bare_flips += flipped(bare[0], bare[1], bare[2]) ? 1 : 0;
    const auto moved = own.toward(target, x, n, 0.002);
    flips += flipped(moved.a, moved.b, moved.c) ? 1 : 0;
    for (const auto& stored : {moved.a, moved.b, moved.c}) {
      const d3::vector node = stored;
      if (std::abs((p - node).dot(n)) > 1e-15) FAIL("a node left the plane");
    }
  }
  CHECK(flips == 0);
  CHECK(outside > cases / 3);  // the control: 48 % of these cases leave the segment,
  CHECK(bare_flips > 20);      // and some triangles flip
}

TEST_CASE("a triangle is lost in rounding from its longest edge on, whichever that is",
          "[geometry]") {
  const auto usable = [](double height) {
    std::array<d3::vector, 3> corner{d3::vector(0, 0, 0), d3::vector(1, 0, 0),
                                     d3::vector(0.5, height, 0)};
    int count = 0;
    for (int turn = 0; turn < 3; ++turn) {
      count += ph::detail::facing_of<d3>(corner[0], corner[1], corner[2]).usable ? 1 : 0;
      std::rotate(corner.begin(), corner.begin() + 1, corner.end());
    }
    return count;
  };
  CHECK(usable(1e-14) == 3);
  CHECK(usable(16 * std::numeric_limits<double>::epsilon()) == 0);
  CHECK(usable(2e-15) == 0);
  auto plate = right_triangle();
  plate.thickness = 0.0;
  CHECK_FALSE(plate.prepare());
}

TEST_CASE("to no number the first corner is closest", "[geometry]") {
  const double nan = std::nan("");
  const auto found =
      ph::detail::closest_on_triangle<d3>({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {nan, nan, nan});
  CHECK(found.point == d3::vector(1, 0, 0));
  CHECK(found.weights == std::array<double, 3>{1, 0, 0});
}

TEST_CASE("a node stays where its line is along the plane but for rounding, and is shifted to it",
          "[geometry]") {
  const double eps = std::numeric_limits<double>::epsilon();
  const auto node = [](const d3::vector& to, double height) -> d3::vector {
    const d3::coordinates a =
        ph::detail::node_on_plane<d3>({0, 0, 0}, to, {0, 0, height}, {0, 0, 1});
    const d3::coordinates b =
        ph::detail::call_node_on_plane<d3>({0, 0, 0}, to, {0, 0, height}, {0, 0, 1});
    CHECK(d3::vector(a) == d3::vector(b));
    return a;
  };
  CHECK(node({1, 0, 0}, 0.25) == d3::vector(0, 0, 0.25));
  for (const double side : {1.0, -1.0}) {
    CHECK(node({1, 0, side * eps}, side * eps / 2) == d3::vector(0, 0, side * eps / 2));
    CHECK(node({1, 0, side * 2 * eps}, side * eps) == d3::vector(0.5, 0, side * eps));
    const double low = side * std::ldexp(1.0, -50);  // of a line of 2^-7, above ε times that
    CHECK(node({std::ldexp(1.0, -7), 0, low}, low / 2) ==
          d3::vector(std::ldexp(1.0, -8), 0, low / 2));
  }
}
