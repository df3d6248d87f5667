// SPDX-License-Identifier: BSD-3-Clause
// What a mesh publishes at a contact: quadrics and patches.
#include "environment/shapes.hpp"
#include "support/curved.hpp"
#include <passive_haptics/environment/contact_surface.hpp>
#include <passive_haptics/environment/contact_tracker.hpp>
#include <passive_haptics/environment/deformable_body.hpp>

namespace {

struct mesh {
  std::vector<Vector3d> nodes;
  std::vector<env::surface_triangle> surface;

  explicit mesh(int times) {
    const auto ball = curved::icosphere(times);
    nodes = ball.nodes;
    for (const auto& t : ball.triangles) surface.push_back({t});
  }
  [[nodiscard]] env::surface_point closest(const Vector3d& x) const {
    const auto found = env::closest_point(surface, nodes, x);
    REQUIRE(found);
    return *found;
  }
};
/// A ball of 1280 triangles with a dent 6 mm deep at its pole +z.
mesh dented() {
  mesh m(3);
  for (auto& x : m.nodes) {
    const double away = (x - Vector3d(0, 0, curved::radius)).squaredNorm();
    x *= 1.0 - 0.12 * std::exp(-away / (2.0 * 0.012 * 0.012));
  }
  return m;
}
constexpr int ticks_over_the_dent = 1900;
/// A finger that goes across the dent, 1.5 mm below the surface.
Vector3d over_the_dent(const mesh& m, int tick) {
  const double angle = 0.3 * (tick - 950) / 950.0;
  const Vector3d way(std::sin(angle) * std::cos(0.3), std::sin(angle) * std::sin(0.3),
                     std::cos(angle));
  for (const auto& t : m.surface) {  // the one that the ray along `way` goes through
    const auto c = env::corners(t, m.nodes);
    const Vector3d n = env::area_vector(c);
    const Vector3d p = way * (n.dot(c[0]) / n.dot(way));
    const auto left_of = [&](const Vector3d& from, const Vector3d& to) {
      return (to - from).cross(p - from).dot(n) >= 0.0;
    };
    if (n.dot(way) > 0.0 && left_of(c[0], c[1]) && left_of(c[1], c[2]) && left_of(c[2], c[0])) {
      return p - way * 1.5e-3;
    }
  }
  FAIL("the ray misses the mesh");
  return way;
}
/// A surface at every 33rd tick of a stroke on the ball, felt at all of them.
template <class Next>
curved::feel felt(const mesh& m, const Next& next) {
  env::contact_tracker tracker(2e-4);
  auto now = next(m.closest(curved::stroke(0)));
  return curved::stroked(
      [&](int i, const Vector3d& x) {
        if (i % 33 == 0) {
          now = next(*tracker.find(m.surface, m.nodes, x));
          REQUIRE(now.prepare());
        }
        return curved::force<d3>(now, x);
      },
      3000);
}

}  // namespace

TEST_CASE("a mesh of 320 triangles that publishes quadrics feels like the ball it stands for",
          "[environment][curved]") {
  const mesh m(2);
  const auto quadrics = felt(m, [&](const env::surface_point& on) {
    return env::quadric_at(m.surface, m.nodes, on, curved::stiffness);
  });
  CHECK(quadrics.largest_step < 0.0038);
  CHECK(quadrics.mean_error < 0.0038);
  const auto planes = felt(m, [&](const env::surface_point& on) {  // the control
    return ph::half_space<d3>{on.point, on.normal, curved::stiffness};
  });
  CHECK(planes.largest_step > 0.3);
  CHECK(planes.mean_error > 0.2);
}

TEST_CASE("a quadric of a mesh that is sharp is kept from folding", "[environment][curved]") {
  const mesh ball(0);  // an icosahedron, 20/m
  const auto on = ball.closest({0.03, 0.02, 0.01});
  for (const double thickness : {0.005, 0.05, 0.5}) {
    auto q = env::quadric_at(ball.surface, ball.nodes, on, 500, {.thickness = thickness});
    CHECK(std::abs(q.curvature) <= 0.5 / thickness);
    CHECK(q.prepare());
  }
}

TEST_CASE("a patch of a dent loses no tick, a triangle of it does", "[environment][curved][long]") {
  const mesh m = dented();
  int triangle_lost = 0, patch_lost = 0, old_triangle_lost = 0;
  double largest_step = 0.0;
  Vector3d last = Vector3d::Zero();
  ph::patch<d3, 16> patch;
  ph::triangle<d3> kept;
  for (int i = 0; i < ticks_over_the_dent; ++i) {
    const Vector3d x = over_the_dent(m, i);
    const auto on = m.closest(x);
    REQUIRE(on.depth > 0.0);
    const auto t = env::corners(m.surface[static_cast<std::size_t>(on.triangle)], m.nodes);
    ph::triangle<d3> prism{.a = t[0], .b = t[1], .c = t[2], .stiffness = 500};
    REQUIRE(prism.prepare());
    if (i % 33 == 0) {
      patch = env::patch_at(m.surface, m.nodes, on, 500);
      REQUIRE(patch.prepare());
      REQUIRE(patch.triangle_count == 16);
      kept = prism;
    }
    const auto lost = [&](const auto& surface) {
      const auto seen = surface.at(x);
      return !seen.covered() || !(seen.depth > 0.0);
    };
    triangle_lost += lost(prism);
    old_triangle_lost += lost(kept);
    patch_lost += lost(patch);
    CHECK_THAT(patch.at(x).depth, WithinAbs((on.point - x).norm(), 1e-12));
    const Vector3d f = curved::force<d3>(patch, x);
    if (i > 0) largest_step = std::max(largest_step, (f - last).norm());
    last = f;
  }
  CHECK(patch_lost == 0);
  CHECK(triangle_lost > 40);       // the control: the nearest triangle of every tick
  CHECK(old_triangle_lost > 100);  // and of every 33rd
  CHECK(largest_step < 0.13);      // at the ridges: a patch is faceted
}

TEST_CASE("a patch is of whole edges, however the mesh is", "[environment][curved]") {
  const auto check = [](const auto& patch, int at_least) {
    auto p = patch;
    CHECK(p.prepare());
    CHECK(int(p.triangle_count) >= at_least);
  };
  const mesh ball(2);
  const auto on = ball.closest({0.03, 0.02, 0.01});
  check(env::patch_at<1>(ball.surface, ball.nodes, on, 500), 1);
  check(env::patch_at<40>(ball.surface, ball.nodes, on, 500), 40);
  const auto all =
      env::patch_at<30>(mesh(0).surface, mesh(0).nodes, mesh(0).closest({0, 0, 1}), 500);
  check(all, 20);  // the whole icosahedron
  CHECK_FALSE(all.triangle_count > 20);
  // Two cubes that share an edge have four triangles at it.
  const auto cubes = blocks(2, [](int i, int j, int k) { return i == j && k == 0; });
  const auto surface = env::boundary(cubes);
  for (int number = 0; number < static_cast<int>(surface.size()); ++number) {
    const auto t = env::corners(surface[static_cast<std::size_t>(number)], cubes.nodes);
    const auto middle =
        env::point_on(surface, cubes.nodes, number, env::point_at(t, Vector3d::Constant(1.0 / 3)));
    REQUIRE(middle);
    check(env::patch_at<40>(surface, cubes.nodes, *middle, 500), 12);
  }
}

TEST_CASE(
    "a surface that knows its neighbours gives the patch that looking through all of it gives",
    "[environment][curved]") {
  const auto same = [](const auto& surface, const auto& nodes, const env::surface_point& on) {
    const auto slow = env::patch_at<24>(env::surface_view(surface), nodes, on, 500);
    const auto fast = env::patch_at<24>(env::surface_graph(surface, nodes.size()), nodes, on, 500);
    REQUIRE(slow.triangle_count > 10);
    REQUIRE(fast.triangle_count == slow.triangle_count);
    REQUIRE(fast.node_count == slow.node_count);
    CHECK(fast.triangles == slow.triangles);
    for (std::size_t i = 0; i < slow.node_count; ++i) {
      CHECK(Vector3d(fast.nodes[i]) == Vector3d(slow.nodes[i]));
    }
  };
  const mesh ball(2);
  for (const auto& x : {Vector3d(0.03, 0.02, 0.01), Vector3d(0, 0, 1), Vector3d(-1, 0.3, 0.2)}) {
    same(std::vector(ball.surface.begin(), ball.surface.end()), ball.nodes, ball.closest(x));
  }
  // Ties of distance, and an edge of four triangles.
  const auto cubes = blocks(3, [](int i, int j, int k) { return (i + j + k) % 2 == 0; });
  const auto surface = env::boundary(cubes);
  for (int i = 0; i < static_cast<int>(surface.size()); i += 7) {
    const auto t = env::corners(surface[static_cast<std::size_t>(i)], cubes.nodes);
    same(surface, cubes.nodes,
         *env::point_on(surface, cubes.nodes, i, env::point_at(t, Vector3d::Constant(1.0 / 3))));
  }
}

TEST_CASE("a deformable body publishes a quadric and a patch of its contact, none before it",
          "[environment][curved]") {
  env::deformable_body body(env::ball(0.05), {.young = 2e4, .poisson = 0.3},
                            env::ball_fixed_nodes());
  CHECK_FALSE(env::quadric_at(body).prepare());
  CHECK_FALSE(env::patch_at(body).prepare());
  const Vector3d device(0.002, 0.001, 0.048);
  for (int i = 0; i < 20; ++i) body.update(device, {0, 0, 1});
  auto quadric = env::quadric_at(body);
  auto patch = env::patch_at(body);
  REQUIRE(quadric.prepare());
  REQUIRE(patch.prepare());
  CHECK(quadric.stiffness == body.contact().stiffness);
  CHECK(patch.stiffness == body.contact().stiffness);
  const auto seen = patch.at(device);
  CHECK(seen.covered());
  const double side = body.contact().depth > 0 ? 1.0 : -1.0;
  CHECK_THAT(seen.depth, WithinAbs(side * (body.contact().point - device).norm(), 1e-12));
}

TEST_CASE("where all nodes have gone NaN no surface is found, and none is published",
          "[environment][curved]") {
  const std::vector<env::surface_triangle> square{{{0, 1, 2}}, {{1, 3, 2}}};
  const std::vector<Vector3d> nodes(4, Vector3d::Constant(not_a_number));
  const env::surface_graph graph(square, nodes.size());
  const env::surface_view view = square;
  const auto none = env::closest_point(view, nodes, {0.5, 0.5, 0.1}).value_or(env::surface_point{});
  REQUIRE(none.triangle == -1);
  env::surface_point beyond;
  beyond.triangle = 2;
  for (const auto& on : {none, beyond}) {
    CHECK_FALSE(env::quadric_at(view, nodes, on, 500).prepare());
    CHECK_FALSE(env::quadric_at(graph, nodes, on, 500).prepare());
    CHECK_FALSE(env::patch_at(view, nodes, on, 500).prepare());
    CHECK_FALSE(env::patch_at(graph, nodes, on, 500).prepare());
    CHECK_THROWS_WITH(env::shape_at(graph, nodes, on.triangle, on.weights),
                      Catch::Matchers::Contains("triangle " + std::to_string(on.triangle) +
                                                " of 2; give a triangle that closest_point()"));
  }
}

TEST_CASE("a body is asked ahead of a finger by half of its last way, bounded", "[environment]") {
  env::ahead where({.periods = 0.5, .most = 1e-3});
  CHECK(where({0.01, 0, 0}) == Vector3d(0.01, 0, 0));
  CHECK(where({0.012, 0, 0}).isApprox(Vector3d(0.013, 0, 0), 1e-12));
  CHECK(where({0.012, 0, 0}) == Vector3d(0.012, 0, 0));                // it rests
  CHECK(where({0.112, 0, 0}).isApprox(Vector3d(0.113, 0, 0), 1e-12));  // by `most`
  CHECK(where({0, std::nan(""), 0}).hasNaN());
  CHECK(where({0.111, 0, 0}).isApprox(Vector3d(0.1105, 0, 0), 1e-12));  // as if it had not been
  CHECK(where({1e308, -1e308, 0}) == Vector3d(1e308, -1e308, 0));
  CHECK(where({-1e308, 1e308, 0}) == Vector3d(-1e308, 1e308, 0));
  where.reset();
  CHECK(where({0.3, 0, 0}) == Vector3d(0.3, 0, 0));
  for (const double odd : {-0.1, 1001.0, std::nan("")}) {
    CHECK_THROWS_AS(env::ahead({.periods = odd}), std::invalid_argument);
  }
  CHECK_THROWS_AS(env::ahead({.most = -1.0}), std::invalid_argument);
  CHECK_THROWS_AS(env::ahead({.most = HUGE_VAL}), std::invalid_argument);

  env::deformable_body body(env::ball(0.05), {.young = 2e4, .poisson = 0.3},
                            env::ball_fixed_nodes());
  env::ahead finger;
  CHECK_FALSE(
      env::yielding(body, finger, Vector3d::Constant(std::nan("")), Vector3d::Zero()).prepare());
  CHECK(env::yielding(body, finger, {0, 0, 0.044}, Vector3d::Zero()).prepare());
  const Vector3d before = body.contact().point;
  CHECK(env::yielding(body, finger, {0.002, 0, 0.044}, Vector3d::Zero()).prepare());
  env::deformable_body other(env::ball(0.05), {.young = 2e4, .poisson = 0.3},
                             env::ball_fixed_nodes());
  other.update({0, 0, 0.044}, Vector3d::Zero());
  other.update({0.003, 0, 0.044}, Vector3d::Zero());
  CHECK(body.contact().point == other.contact().point);  // asked at 3 mm
  CHECK(body.contact().point != before);
}
