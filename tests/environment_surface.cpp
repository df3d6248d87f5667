// SPDX-License-Identifier: BSD-3-Clause
// The surface of a mesh: its topology, the closest point, the side, the contact that is held.

#include "support/catch.hpp"
#include <passive_haptics/environment/ball.hpp>
#include <passive_haptics/environment/contact_tracker.hpp>
#include <passive_haptics/environment/mesh.hpp>
#include <passive_haptics/environment/msh_reader.hpp>
#include <passive_haptics/environment/surface.hpp>
#include <passive_haptics/environment/triangle.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace env = passive_haptics::environment;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using Eigen::Vector3d;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

// Six tetrahedra per cube around its diagonal; cubes where solid() says so. Upright, conforming.
template <class Solid>
env::tetrahedral_mesh blocks(int n, Solid solid) {
  env::tetrahedral_mesh mesh;
  std::map<std::array<int, 3>, int> numbers;
  const auto node = [&](int i, int j, int k) {
    const auto [at, added] = numbers.try_emplace({i, j, k}, static_cast<int>(mesh.nodes.size()));
    if (added) mesh.nodes.emplace_back(i, j, k);
    return at->second;
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < n; ++k) {
        if (!solid(i, j, k)) continue;
        std::array<int, 3> axis{0, 1, 2};
        do {
          std::array<int, 3> corner{i, j, k};
          std::array<int, 4> t{};
          t[0] = node(i, j, k);
          for (std::size_t s = 0; s < 3; ++s) {
            ++corner[static_cast<std::size_t>(axis[s])];
            t[s + 1] = node(corner[0], corner[1], corner[2]);
          }
          if (env::signed_volume(mesh, t) < 0.0) std::swap(t[2], t[3]);
          mesh.tetrahedra.push_back(t);
        } while (std::next_permutation(axis.begin(), axis.end()));
      }
    }
  }
  return mesh;
}

double volume(const env::tetrahedral_mesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.tetrahedra) sum += env::signed_volume(mesh, t);
  return sum;
}

void check_closed(const env::tetrahedral_mesh& mesh, int euler) {
  const auto surface = env::boundary(mesh);
  std::set<int> nodes;
  std::map<std::pair<int, int>, int> directed;
  double enclosed = 0.0;  // divergence theorem: V = ⅓ ∮ x·n dA
  for (const auto& t : surface) {
    const auto shape = env::corners(t, mesh.nodes);
    enclosed += env::area_vector(shape).dot((shape[0] + shape[1] + shape[2]) / 3.0) / 3.0;
    for (std::size_t k = 0; k < 3; ++k) {
      nodes.insert(t.nodes[k]);
      ++directed[{t.nodes[k], t.nodes[(k + 1) % 3]}];
    }
  }
  for (const auto& [edge, times] : directed) {
    CHECK(times == 1);
    CHECK(directed.count({edge.second, edge.first}) == 1);
  }
  CHECK_THAT(enclosed, WithinRel(volume(mesh), 1e-12));
  const auto edges = static_cast<int>(directed.size()) / 2;
  CHECK(static_cast<int>(nodes.size()) - edges + static_cast<int>(surface.size()) == euler);
}

Vector3d anywhere(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> in(-size, size);
  const double x = in(random);
  const double y = in(random);
  return {x, y, in(random)};
}

// Inside the union of the elements: an independent answer to "which side".
bool in_elements(const env::tetrahedral_mesh& mesh, const Vector3d& x) {
  for (const auto& t : mesh.tetrahedra) {
    auto moved = mesh;
    bool inside = true;
    for (std::size_t k = 0; k < 4 && inside; ++k) {
      const auto at = static_cast<std::size_t>(t[k]);
      const Vector3d kept = std::exchange(moved.nodes[at], x);
      inside = env::signed_volume(moved, t) > 0.0;
      moved.nodes[at] = kept;
    }
    if (inside) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("boundary closes the surface and turns it outward", "[environment][surface]") {
  check_closed(env::ball(0.05), 2);
  check_closed(blocks(1, [](int, int, int) { return true; }), 2);
  check_closed(blocks(3, [](int, int, int) { return true; }), 2);
  // A ring has a hole, and a box with a cavity has two surfaces.
  check_closed(blocks(3, [](int i, int j, int k) { return k == 0 && !(i == 1 && j == 1); }), 0);
  check_closed(blocks(3, [](int i, int j, int k) { return i != 1 || j != 1 || k != 1; }), 4);
}

TEST_CASE("boundary refuses a face with too many owners", "[environment][surface]") {
  env::tetrahedral_mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}},
                             {{0, 1, 2, 3}, {0, 2, 1, 4}}};
  CHECK(env::boundary(mesh).size() == 6);
  mesh.nodes.emplace_back(0.1, 0.1, -2.0);
  mesh.tetrahedra.push_back({0, 2, 1, 5});
  CHECK_THROWS_AS(env::boundary(mesh), env::mesh_error);
  mesh.tetrahedra.erase(mesh.tetrahedra.begin());  // two owners, but on the same side
  CHECK_THROWS_AS(env::boundary(mesh), env::mesh_error);
}

TEST_CASE("closest_weights finds the closest point of a triangle", "[environment][surface]") {
  std::mt19937 random(1);
  for (int run = 0; run < 2000; ++run) {
    env::triangle t{anywhere(random, 1), anywhere(random, 1), anywhere(random, 1)};
    if (run % 4 == 0) t[2] = t[0] + 0.3 * (t[1] - t[0]) + 1e-7 * anywhere(random, 1);  // a needle
    if (run % 16 == 1) t[2] = t[1];
    if (run % 64 == 2) t[2] = t[1] = t[0];
    const Vector3d p = anywhere(random, 2);
    const Vector3d w = env::closest_weights(t, p);
    REQUIRE_THAT(w.sum(), WithinAbs(1.0, 1e-12));
    REQUIRE(w.minCoeff() >= 0.0);
    const double found = (env::point_at(t, w) - p).norm();
    constexpr int steps = 40;
    double sampled = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; i + j <= steps; ++j) {
        const Vector3d s = Vector3d(i, j, steps - i - j) / steps;
        sampled = std::min(sampled, (env::point_at(t, s) - p).norm());
      }
    }
    REQUIRE(found <= sampled + 1e-12);
    REQUIRE(sampled - found < 4.0 / steps);
  }
}

TEST_CASE("closest_weights are exact at corners and edges", "[environment][surface]") {
  const env::triangle t{Vector3d{0, 0, 0}, Vector3d{1, 0, 0}, Vector3d{0, 1, 0}};
  CHECK(env::closest_weights(t, {-1, -1, 3}) == Vector3d(1, 0, 0));
  CHECK(env::closest_weights(t, {3, -1, 0}) == Vector3d(0, 1, 0));
  CHECK(env::closest_weights(t, {0.25, -2, 1}) == Vector3d(0.75, 0.25, 0));
  CHECK(env::closest_weights(t, {0.25, 0.25, -7}) == Vector3d(0.5, 0.25, 0.25));
}

TEST_CASE("closest_point tells inside from outside at faces, edges and nodes",
          "[environment][surface]") {
  // A sharp wedge: its acute edge is where the side of one triangle is the wrong answer.
  const env::tetrahedral_mesh wedge{{{0, 0, 0}, {4, 0, 0}, {2, 3, 0.3}, {2, 3, -0.3}},
                                    {{0, 1, 2, 3}}};
  std::vector<env::tetrahedral_mesh> shapes{
      env::oriented(wedge), env::ball(1.0),
      blocks(2, [](int i, int j, int k) { return i + j + k != 0; }),
      blocks(3, [](int i, int j, int k) { return i != 1 || j != 1 || k != 1; })};
  std::mt19937 random(2);
  for (int star = 0; star < 5;
       ++star) {  // spikes and saddles: every surface node at its own radius
    shapes.push_back(env::ball(1.0));
    for (auto& node : shapes.back().nodes)
      node *= 0.3 + 0.7 * (0.5 + 0.5 * anywhere(random, 1.0).x());
  }
  int single_plane_is_wrong = 0;
  for (const auto& mesh : shapes) {
    REQUIRE_NOTHROW(env::check(mesh));
    const auto surface = env::boundary(mesh);
    int inside = 0;
    for (int run = 0; run < 3000; ++run) {
      Vector3d x = anywhere(random, 4.0);
      if (run % 2 == 0) {  // near a node or an edge
        const auto t = env::corners(surface[random() % surface.size()], mesh.nodes);
        x = t[0] + (run % 4 == 0 ? 0.0 : 0.4) * (t[1] - t[0]) + 0.05 * anywhere(random, 1.0);
      }
      const auto found = env::closest_point(surface, mesh.nodes, x);
      REQUIRE(found);
      if (found->distance < 1e-9) continue;
      const bool truth = in_elements(mesh, x);
      INFO("x = " << x.transpose() << ", distance " << found->distance);
      REQUIRE((found->depth > 0.0) == truth);
      REQUIRE(env::is_inside(surface, mesh.nodes, x) == truth);
      inside += truth ? 1 : 0;
      for (int i = 0; i < static_cast<int>(surface.size()); ++i) {
        const auto other = env::point_on(surface, mesh.nodes, i, x);
        REQUIRE(other->distance >= found->distance - 1e-12);
        if (other->distance <= found->distance && (other->depth > 0.0) != truth) {
          ++single_plane_is_wrong;
        }
      }
    }
    CHECK(inside > 50);
    CHECK(inside < 2950);
  }
  CHECK(single_plane_is_wrong > 100);  // the test can fail: equally close triangles do disagree
}

TEST_CASE("closest_point never returns a degenerate triangle", "[environment][surface]") {
  const std::vector<env::surface_triangle> surface{{{0, 1, 2}}, {{3, 4, 5}}};
  std::vector<Vector3d> nodes{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 9}, {1, 0, 9}, {0, 1, 9}};
  const Vector3d x{0.2, 0.2, 1};
  REQUIRE(env::closest_point(surface, nodes, x));
  CHECK(env::closest_point(surface, nodes, x)->triangle == 0);
  nodes[2] = {2, 0, 0};  // collapsed to a line (A17)
  CHECK(env::closest_point(surface, nodes, x)->triangle == 1);
  CHECK(env::match_normal(surface, nodes, {0, 0, 0}, x)->triangle == 1);
  nodes[5] = nodes[4];
  CHECK_FALSE(env::closest_point(surface, nodes, x));
  CHECK_FALSE(env::match_normal(surface, nodes, {0, 0, 0}, x));
  nodes[5] = {not_a_number, 0, 0};
  CHECK_FALSE(env::closest_point(surface, nodes, x));
  nodes[5] = {0, 1, 9};
  CHECK(env::closest_point(surface, nodes, x));
  CHECK_FALSE(env::closest_point(surface, nodes, {not_a_number, 0, 0}));
}

TEST_CASE("contact_tracker holds its triangle under dither and leaves it beyond the margin",
          "[environment][surface]") {
  // A roof: triangle 0 faces −x, triangle 1 faces +x, the ridge runs along y.
  const std::vector<env::surface_triangle> roof{{{0, 2, 1}}, {{0, 1, 3}}};
  const std::vector<Vector3d> nodes{{0, -5, 0}, {0, 5, 0}, {-5, 0, -5}, {5, 0, -5}};
  constexpr double margin = 1e-3;
  env::contact_tracker tracker(margin);
  CHECK(tracker.find(roof, nodes, {0.5, 0, -1})->triangle == 1);
  int flips = 0;
  for (int tick = 0; tick < 100; ++tick) {  // 0.1 mm either side of the ridge, 1 m deep
    const Vector3d x{tick % 2 == 0 ? 1e-4 : -1e-4, 0, -1};
    flips += env::closest_point(roof, nodes, x)->triangle == 0 ? 1 : 0;
    CHECK(tracker.find(roof, nodes, x)->triangle == 1);
  }
  CHECK(flips == 50);  // without hysteresis: every other tick
  // At x = −a the other side is closer by √2 a.
  CHECK(tracker.find(roof, nodes, {-0.99 * margin / std::numbers::sqrt2, 0, -1})->triangle == 1);
  CHECK(tracker.find(roof, nodes, {-1.01 * margin / std::numbers::sqrt2, 0, -1})->triangle == 0);
  CHECK(tracker.find(roof, nodes, {0, 0, -1})->triangle == 0);
  tracker.reset();
  CHECK(tracker.find(roof, nodes, {1e-6, 0, -1})->triangle == 1);
  CHECK_FALSE(tracker.find(roof, nodes, {not_a_number, 0, 0}));
  CHECK(tracker.triangle() == 1);
  for (const double bad : {-1e-3, not_a_number}) {
    CHECK_THROWS_AS(env::contact_tracker(bad), std::invalid_argument);
  }
}

TEST_CASE("contact_tracker tells inside from outside whatever it holds", "[environment][surface]") {
  const auto mesh = env::ball(1.0);
  const auto surface = env::boundary(mesh);
  env::contact_tracker tracker(0.2);
  std::mt19937 random(3);
  Vector3d x{0, 0, 1.1};
  int held = 0;
  for (int tick = 0; tick < 5000; ++tick) {
    x = (x + 0.1 * anywhere(random, 1.0)).cwiseMax(-1.2).cwiseMin(1.2);
    const auto found = tracker.find(surface, mesh.nodes, x);
    const auto closest = env::closest_point(surface, mesh.nodes, x);
    REQUIRE(found);
    REQUIRE((found->depth > 0.0) == (closest->depth > 0.0));
    REQUIRE(found->distance <= closest->distance + 0.2);
    held += found->triangle != closest->triangle ? 1 : 0;
  }
  CHECK(held > 100);
}

TEST_CASE("match_normal agrees with the closest point on a ball only", "[environment][surface]") {
  const auto agreement = [](const std::vector<Vector3d>& nodes,
                            const std::vector<env::surface_triangle>& surface) {
    std::mt19937 random(4);
    int same = 0;
    for (int run = 0; run < 1000; ++run) {
      const Vector3d x = 1.3 * anywhere(random, 1.0).normalized();
      same += env::match_normal(surface, nodes, {0, 0, 0}, x)->triangle ==
              env::closest_point(surface, nodes, x)->triangle;
    }
    return same / 1000.0;
  };
  const auto mesh = env::ball(1.0);
  const auto surface = env::boundary(mesh);
  CHECK(agreement(mesh.nodes, surface) > 0.95);
  auto flattened = mesh.nodes;
  for (auto& x : flattened) x.z() *= 0.3;
  CHECK(agreement(flattened, surface) < 0.8);  // A26
}

TEST_CASE("force_shares: barycentric conserves force and moment, by_distance the force only",
          "[environment][surface]") {
  const env::triangle t{Vector3d{0, 0, 0}, Vector3d{1, 0, 0}, Vector3d{0.5, std::sqrt(0.75), 0}};
  using enum env::force_split;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double mean = 0.0;
  double worst = 0.0;
  constexpr int runs = 100000;
  for (int run = 0; run < runs; ++run) {
    double a = unit(random);
    double b = unit(random);
    if (a + b > 1.0) {
      a = 1.0 - a;
      b = 1.0 - b;
    }
    const Vector3d weights(a, b, 1.0 - a - b);
    const Vector3d point = env::point_at(t, weights);
    const Vector3d right = env::force_shares(barycentric, t, weights);
    const Vector3d thesis = env::force_shares(by_distance, t, weights);
    REQUIRE_THAT(right.sum(), WithinAbs(1.0, 1e-14));
    REQUIRE_THAT(thesis.sum(), WithinAbs(1.0, 1e-14));
    REQUIRE((env::point_at(t, right) - point).norm() < 1e-14);
    const double shift = (env::point_at(t, thesis) - point).norm();
    mean += shift / runs;
    worst = std::max(worst, shift);
  }
  CHECK_THAT(mean, WithinAbs(0.10, 0.01));   // of an edge (A25)
  CHECK_THAT(worst, WithinAbs(0.19, 0.01));  // of an edge (A25)
  // 22 % to the far node for a contact in the middle of an edge; all to a node for a contact there.
  CHECK_THAT(env::force_shares(by_distance, t, {0.5, 0.5, 0})[2], WithinAbs(0.224, 1e-3));
  CHECK(env::force_shares(by_distance, t, {0, 1, 0}) == Vector3d(0, 1, 0));
  CHECK(env::force_shares(by_distance, t, {1e-14, 1, 0}) == Vector3d(0, 1, 0));
}

TEST_CASE("ball is what Euler allows: 11 nodes, 16 tetrahedra, 10 on the sphere, 16 faces",
          "[environment][ball]") {
  constexpr double radius = 0.05;
  const auto mesh = env::ball(radius);
  CHECK(env::find_fault(mesh) == std::nullopt);
  CHECK(mesh.nodes.size() == 11);
  CHECK(mesh.tetrahedra.size() == 16);
  for (std::size_t i = 0; i < 10; ++i) CHECK_THAT(mesh.nodes[i].norm(), WithinRel(radius, 1e-12));
  CHECK(mesh.nodes[10].norm() == 0.0);
  CHECK(mesh.nodes[0] == Vector3d(0, 0, radius));
  CHECK(mesh.nodes[9] == Vector3d(0, 0, -radius));
  const auto surface = env::boundary(mesh);
  CHECK(surface.size() == 16);
  for (const auto& t : surface) {
    const auto shape = env::corners(t, mesh.nodes);
    CHECK(env::unit_normal(shape).dot(shape[0] + shape[1] + shape[2]) > 0.0);
  }
  for (const int node : env::ball_fixed_nodes()) CHECK(mesh.nodes[std::size_t(node)].z() < 0.0);
  for (const double bad : {0.0, -1.0, not_a_number})
    CHECK_THROWS_AS(env::ball(bad), std::invalid_argument);
}

TEST_CASE("a real liver reads as one closed body", "[environment][reader]") {
#ifdef PASSIVE_HAPTICS_SHARED_DATA
  const auto path = std::filesystem::path(PASSIVE_HAPTICS_SHARED_DATA) / "liver.msh";
#else
  const std::filesystem::path path;
#endif
  if (!std::filesystem::exists(path)) {
    WARN("skipped: PASSIVE_HAPTICS_SHARED_DATA has no liver.msh");
    return;
  }
  const auto mesh = env::read_msh(path);
  CHECK(mesh.nodes.size() == 181);
  CHECK(mesh.tetrahedra.size() == 596);
  check_closed(mesh, 2);
}
