// SPDX-License-Identifier: BSD-3-Clause
// The surface of a mesh: its topology, the closest point, the side.
#include "environment/shapes.hpp"

namespace {

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
  check_closed(torus(1.0, 0.3, 12, 6), 0);
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

TEST_CASE("closest_point tells inside from outside at faces, edges and nodes",
          "[environment][surface][long]") {
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
    for (int run = 0; run < 1500; ++run) {
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
