// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/curved.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <random>

using Catch::Matchers::WithinAbs;
using Eigen::Vector3d;

namespace {

/// A closed body: nothing of it is on a rim, so it is covered everywhere.
ph::patch<d3, 4> tetrahedron(const std::array<Vector3d, 4>& corners) {
  ph::patch<d3, 4> p;
  for (std::size_t i = 0; i < 4; ++i) p.nodes[i] = corners[i];
  p.node_count = 4;
  p.triangles = {{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  p.triangle_count = 4;
  p.stiffness = 500;
  REQUIRE(p.prepare());
  return p;
}
/// Inside all four faces: an independent answer to "which side".
bool in_tetrahedron(const std::array<Vector3d, 4>& c, const Vector3d& x) {
  const auto volume = [](const Vector3d& p, const Vector3d& q, const Vector3d& r,
                         const Vector3d& s) { return (q - p).cross(r - p).dot(s - p); };
  return volume(x, c[1], c[2], c[3]) > 0 && volume(c[0], x, c[2], c[3]) > 0 &&
         volume(c[0], c[1], x, c[3]) > 0 && volume(c[0], c[1], c[2], x) > 0;
}

}  // namespace

TEST_CASE("a patch tells inside from outside at faces, edges and nodes, in acute wedges too",
          "[geometry][curved]") {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> in(-0.02, 0.02);
  const auto anywhere = [&]() -> Vector3d { return {in(random), in(random), in(random)}; };
  int inside = 0, outside = 0, single_plane_is_wrong = 0;
  for (int body = 0; body < 200; ++body) {
    std::array<Vector3d, 4> c{anywhere(), anywhere(), anywhere(), anywhere()};
    const double volume = (c[1] - c[0]).cross(c[2] - c[0]).dot(c[3] - c[0]);
    if (std::abs(volume) < 1e-7) continue;
    if (volume < 0) std::swap(c[1], c[2]);
    const auto p = tetrahedron(c);
    for (int i = 0; i < 100; ++i) {
      Vector3d x = anywhere();
      if (i % 2 == 0) {  // near a corner or an edge
        const double s = i % 4 == 0 ? 0.0 : 0.4;
        x = c[random() % 4] * (1 - s) + c[random() % 4] * s + 0.05 * anywhere();
      }
      const auto seen = p.at(x);
      REQUIRE(seen.covered());
      CHECK_THAT(seen.outward().norm(), WithinAbs(1.0, 1e-12));
      if (std::abs(seen.depth) < 1e-10) continue;
      const bool truth = in_tetrahedron(c, x);
      INFO("body " << body << ", point " << i << ", depth " << seen.depth);
      REQUIRE((seen.depth > 0) == truth);
      (truth ? inside : outside)++;
      const Vector3d foot = x + seen.outward() * seen.depth;  // the closest point, on the surface
      CHECK(std::abs(p.at(foot).depth) < 1e-9);
      for (const auto& t : p.triangles) {  // the control: whose planes disagree on the side
        const Vector3d a = p.nodes[t[0]], b = p.nodes[t[1]], d = p.nodes[t[2]];
        const auto on = ph::detail::closest_on_triangle<d3>(a, b, d, x);
        if ((on.point - foot).norm() > 1e-9) continue;
        single_plane_is_wrong += ((a - x).dot((b - a).cross(d - a)) > 0) != truth;
      }
    }
  }
  CHECK(inside > 500);
  CHECK(outside > 5000);
  CHECK(single_plane_is_wrong > 100);
}

TEMPLATE_TEST_CASE("a patch covers what is closest to its inside, not to its rim",
                   "[geometry][curved]", d3, f3) {
  using S = TestType;
  auto p = curved::saddle<S>();
  REQUIRE(p.prepare());
  CHECK(p.at(curved::of<S>({0, 0, -0.001})).covered());           // the node in the middle
  CHECK(p.at(curved::of<S>({0.004, 0.0005, -0.001})).covered());  // an edge to it
  CHECK(p.at(curved::of<S>({0.003, 0.003, -0.001})).covered());   // a face
  CHECK_FALSE(p.at(curved::of<S>({0.02, 0.003, -0.001})).covered());
  CHECK_FALSE(p.at(curved::of<S>({0.02, 0, -0.004})).covered());  // a node of the rim
  p.thickness = typename S::scalar(0.002);
  REQUIRE(p.prepare());
  CHECK(p.at(curved::of<S>({-0.003, 0.001, -0.0015})).covered());
  CHECK_FALSE(p.at(curved::of<S>({-0.003, 0.001, -0.004})).covered());
  const auto nan = std::numeric_limits<typename S::scalar>::quiet_NaN();
  const auto nowhere = p.at({nan, nan, nan});
  CHECK_FALSE(nowhere.covered());
  CHECK(nowhere.depth < 0);
  CHECK(S::norm(nowhere.outward()) == 1);
}

TEST_CASE("a contact without depth has the normal of its feature", "[geometry][curved]") {
  auto p = curved::saddle<d3>();
  REQUIRE(p.prepare());
  const d3::vector pseudo_normal = p.pseudo_normals[0];
  CHECK(p.at({0, 0, 0}).outward() == pseudo_normal);
  for (const double height : {1e-19, -1e-19}) {  // of the node or of a face there, never rounding's
    const auto seen = p.at({0, 0, height});
    CHECK(seen.outward().dot(pseudo_normal) > 0.95);
    CHECK(std::abs(seen.depth) <= 1e-19);
  }
}

TEMPLATE_TEST_CASE("a patch that cannot be used is refused", "[geometry][curved]", d3, f3) {
  using S = TestType;
  using scalar = typename S::scalar;
  const auto refused = [](const auto& change) {
    auto p = curved::saddle<S, 6>();
    change(p);
    return !p.prepare();
  };
  CHECK_FALSE(refused([](auto& /*p*/) {}));
  CHECK(refused([](auto& p) { p.triangle_count = 0; }));
  CHECK(refused([](auto& p) { p.triangle_count = 7; }));
  CHECK(refused([](auto& p) { p.node_count = 9; }));
  CHECK(refused([](auto& p) { p.triangles[2][1] = 5; }));  // nodes 0 to 4 exist
  const auto numbered_5 = [](auto& p) {  // a sound patch, if only node 5 is counted
    p.nodes[5] = p.nodes[4];
    for (auto& triangle : p.triangles) std::replace(triangle.begin(), triangle.end(), 4, 5);
  };
  CHECK(refused(numbered_5));
  CHECK_FALSE(refused([&](auto& p) {
    numbered_5(p);
    p.node_count = 6;
  }));
  CHECK(refused([](auto& p) { p.triangles[2][1] = p.triangles[2][0]; }));
  CHECK(refused([](auto& p) { p.nodes[1] = p.nodes[0]; }));
  CHECK(refused([](auto& p) { std::swap(p.triangles[2][1], p.triangles[2][2]); }));
  CHECK(refused([](auto& p) {
    p.triangles[4] = {0, 1, 3};  // a third one at the edge 0 1
    p.triangle_count = 5;
  }));
  CHECK_FALSE(refused([](auto& p) {
    p.triangles[4] = {1, 2, 3};
    std::swap(p.triangles[4][0], p.triangles[4][1]);  // the same edge 1 2 the other way round
    p.triangle_count = 5;
  }));
  for (const scalar bad : {std::numeric_limits<scalar>::quiet_NaN(),
                           std::numeric_limits<scalar>::infinity(), scalar(0), scalar(-1)}) {
    CHECK(refused([&](auto& p) { p.stiffness = bad; }));
    CHECK(refused([&](auto& p) { p.thickness = bad; }));
    CHECK(refused([&](auto& p) {  // a node of no triangle, which around() counts
            p.nodes[p.node_count++] = {scalar(0.002), scalar(0.01), bad};
          }) == !std::isfinite(bad));
    CHECK(refused([&](auto& p) {
            p.nodes[2] = {scalar(0.002), scalar(0.01), bad};
          }) == !std::isfinite(bad));
  }
}

TEST_CASE("the ball around a patch is about the mean of its nodes and reaches the farthest",
          "[geometry][curved]") {
  auto p = curved::saddle<d3>();
  for (std::size_t turn = 0; turn < p.node_count; ++turn) {
    std::rotate(p.nodes.begin(), p.nodes.begin() + 1, p.nodes.begin() + long(p.node_count));
    Vector3d mean = Vector3d::Zero();
    for (std::size_t i = 0; i < p.node_count; ++i) mean += Vector3d(p.nodes[i]) / 5.0;
    double farthest = 0.0;
    for (std::size_t i = 0; i < p.node_count; ++i) {
      farthest = std::max(farthest, (Vector3d(p.nodes[i]) - mean).norm());
    }
    CHECK_THAT((Vector3d(p.around().centre) - mean).norm(), WithinAbs(0.0, 1e-15));
    CHECK_THAT(p.around().radius, WithinAbs(farthest, 1e-15));
  }
}

namespace {

/// A floor, z = 0 where x > 0, and a wall on it, x = 0 where z > 0: what is behind either is inside.
ph::patch<d3, 2> floor_and_wall(bool floor_first = true) {
  ph::patch<d3, 2> p;
  p.nodes = {{{0, -1, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}}};
  p.node_count = 4;
  p.triangles = {{{1, 0, 2}, {0, 1, 3}}};
  if (!floor_first) std::swap(p.triangles[0], p.triangles[1]);
  p.triangle_count = 2;
  p.stiffness = 500;
  p.thickness = 0.125;
  REQUIRE(p.prepare());
  return p;
}

}  // namespace

TEST_CASE("a patch ends just at its thickness, and of two faces as near the first counts",
          "[geometry][curved]") {
  const auto p = floor_and_wall();
  CHECK(p.at({0.25, 0, 0.25}).outward() == d3::vector(0, 0, 1));
  CHECK(floor_and_wall(false).at({0.25, 0, 0.25}).outward() == d3::vector(1, 0, 0));
  CHECK(p.at({0.25, 0, -0.125}).depth == 0.125);
  CHECK(p.at({0.25, 0, -0.125}).covered());  // under the floor
  CHECK(p.at({-0.125, 0, 0}).depth == 0.125);
  CHECK(p.at({-0.125, 0, 0}).covered());  // behind the edge
  CHECK_FALSE(p.at({-0.126, 0, 0}).covered());
  CHECK(p.at({1.5, 0, 0}).depth == -0.5);  // beyond the rim, level with the floor
  CHECK_FALSE(p.at({1.5, 0, 0}).covered());
}

TEST_CASE("over the middle of a gap the edge of the first triangle counts", "[geometry][curved]") {
  ph::patch<d3, 4> p;
  p.nodes = {{{1, -1, 0}, {2, 0, 0}, {1, 1, 0}, {-1, 1, 0}, {-2, 0, 0}, {-1, -1, 0}}};
  p.node_count = 6;
  p.triangles = {{{0, 1, 2}, {3, 4, 5}}};
  p.triangle_count = 2;
  p.stiffness = 500;
  REQUIRE(p.prepare());
  CHECK(p.at({0, 0, 0.5}).outward().x() < 0.0);  // from the edge at x = 1
  std::swap(p.triangles[0], p.triangles[1]);
  REQUIRE(p.prepare());
  CHECK(p.at({0, 0, 0.5}).outward().x() > 0.0);
}

TEST_CASE("an edge has its own normal within 64 epsilon of the size of its triangle",
          "[geometry][curved]") {
  const auto p = floor_and_wall();
  const d3::vector across = d3::vector(1, 0, 1).normalized();
  const double noise = std::ldexp(1.0, -45);  // 64 ε · 2 m, and 64 ε of itself
  for (const double away : {1e-14, 2.5e-14, noise * (1 + std::ldexp(1.0, -46))}) {
    CHECK((p.at({-away, 0, 0}).outward() - across).norm() < 1e-15);
  }
  CHECK((p.at({-3e-14, 0, 0}).outward() - d3::vector(1, 0, 0)).norm() < 1e-15);
}

TEST_CASE("a patch of one triangle or of all its nodes is one, and knows no node beyond",
          "[geometry][curved]") {
  auto p = curved::saddle<d3, 6>();
  p.nodes[5] = {9, 9, std::nan("")};
  CHECK(p.prepare());
  p.nodes[5] = {9, 9, 9};
  CHECK(p.around().radius < 0.02);
  CHECK(d3::vector(p.around().centre).norm() < 0.02);
  p.node_count = 8;
  CHECK(p.prepare());
  p.triangle_count = 1;
  CHECK(p.prepare());
  CHECK_FALSE(p.at({0, 0, 0}).covered());  // its rim
  p.triangle_count = 4;
  REQUIRE(p.prepare());
  CHECK(p.at({0, 0, 0}).covered());  // which was closed
}
