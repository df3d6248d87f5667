// SPDX-License-Identifier: BSD-3-Clause
// The tree of boxes says what the linear search says, at ties too, and follows a body that deforms.
#include "environment/shapes.hpp"
#include <passive_haptics/environment/contact_surface.hpp>
#include <passive_haptics/environment/contact_tracker.hpp>
#include <passive_haptics/environment/curvature.hpp>
#include <passive_haptics/environment/surface_search.hpp>

namespace {

bool same(const std::optional<env::surface_point>& a, const std::optional<env::surface_point>& b) {
  if (a.has_value() != b.has_value()) return false;
  return !a || (a->triangle == b->triangle && a->point == b->point && a->weights == b->weights &&
                a->distance == b->distance && a->depth == b->depth && a->normal == b->normal);
}

std::vector<env::tetrahedral_mesh> shapes() {
  std::mt19937 random(21);
  std::vector<env::tetrahedral_mesh> all{
      env::ball(1.0), blocks(4, [](int, int, int) { return true; }), torus(1.0, 0.3, 20, 8),
      blocks(5, [](int i, int j, int k) { return (i + j + k) % 3 != 0 || k == 0; })};
  all.push_back(blocks(5, [](int, int, int) { return true; }));
  for (auto& x : all.back().nodes) x += 0.2 * anywhere(random, 1.0);
  return all;
}

}  // namespace

TEST_CASE("surface_search answers as the linear search does, bit by bit",
          "[environment][surface][long]") {
  std::mt19937 random(22);
  int ties = 0;
  for (const auto& mesh : shapes()) {
    const auto surface = env::boundary(mesh);
    auto nodes = mesh.nodes;
    env::surface_search search(surface, nodes);
    for (int run = 0; run < 600; ++run) {
      if (run % 100 == 50) {  // deformed, all or a few triangles of it
        std::vector<int> moved;
        for (int i = 0; i < 7; ++i) moved.push_back(static_cast<int>(random() % surface.size()));
        std::vector<int> around;
        for (const int i : moved) {
          for (const int node : surface[std::size_t(i)].nodes) {
            nodes[std::size_t(node)] += 0.3 * anywhere(random, 1.0);
            for (const int t : search.triangles_at(node)) around.push_back(t);
          }
        }
        if (run < 300) {
          search.refit(nodes, around);
        } else {
          search.refit(nodes);
        }
      }
      const auto& t = surface[random() % surface.size()];
      const auto shape = env::corners(t, nodes);
      Vector3d x = anywhere(random, 6.0);
      // On a node, an edge, a face, at the centre of a cube (ties), far away, anywhere.
      if (run % 6 == 1) x = shape[0];
      if (run % 6 == 2) x = 0.5 * (shape[0] + shape[1]) + 0.1 * anywhere(random, 1.0);
      if (run % 6 == 3) x = env::point_at(shape, {0.2, 0.3, 0.5});
      if (run % 6 == 4) x = mesh.nodes[random() % mesh.nodes.size()] + Vector3d::Constant(0.5);
      if (run % 60 == 5) x *= 1e6;
      const auto linear = env::closest_point(surface, nodes, x);
      REQUIRE(same(search.closest_point(nodes, x), linear));
      REQUIRE(same(search.closest_point(nodes, x, static_cast<int>(random() % surface.size())),
                   linear));
      int equal = 0;
      for (int i = 0; i < static_cast<int>(surface.size()); ++i) {
        const auto other = env::point_on(surface, nodes, i, x);
        equal += other && other->distance == linear->distance ? 1 : 0;
      }
      ties += equal > 1 ? 1 : 0;
    }
    CHECK_FALSE(search.closest_point(nodes, {0, not_a_number, 0}));
  }
  CHECK(ties > 500);
}

TEST_CASE("surface_search leaves out what cannot be touched", "[environment][surface]") {
  const std::vector<env::surface_triangle> surface{{{0, 1, 2}}, {{3, 4, 5}}};
  std::vector<Vector3d> nodes{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 9}, {1, 0, 9}, {0, 1, 9}};
  env::surface_search search(surface, nodes);
  const Vector3d x{0.2, 0.2, 1};
  CHECK(search.closest_point(nodes, x)->triangle == 0);
  nodes[2] = {2, 0, 0};
  search.refit(nodes);
  CHECK(search.closest_point(nodes, x)->triangle == 1);
  nodes[5] = {not_a_number, 0, 0};
  search.refit(nodes);
  CHECK_FALSE(search.closest_point(nodes, x));
  CHECK_FALSE(env::surface_search({}, nodes).closest_point(nodes, x));
}

TEST_CASE("a surface refuses nodes that are not its own, and a tree keeps its boxes",
          "[environment][surface]") {
  using Catch::Matchers::Contains;
  using surface = std::vector<env::surface_triangle>;
  const surface square{{{0, 1, 2}}, {{1, 3, 2}}};
  const std::vector<Vector3d> nodes{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  const std::vector<Vector3d> three(nodes.begin(), nodes.begin() + 3);
  const Vector3d x(0.9, 0.9, 0.1);
  for (const int node : {-1, 500}) {
    const surface bad{{{0, 1, 2}}, {{1, node, 2}}};
    const auto said = "names node " + std::to_string(node) + " of 4; count nodes from 0";
    CHECK_THROWS_WITH(env::surface_graph(bad, 4), Contains(said));
    CHECK_THROWS_WITH(env::surface_search(bad, nodes), Contains(said));
    CHECK_THROWS_WITH(env::closest_point(bad, nodes, x), Contains(said));
    CHECK_THROWS_WITH(env::patch_at(bad, nodes, {.triangle = 1}, 500), Contains(said));
  }
  env::surface_search search(square, nodes);
  const std::vector<int> moved{1};
  const std::string said = "news of 3 nodes for a surface of 4; make another surface_search";
  CHECK_THROWS_WITH(search.refit(three), Contains(said));
  CHECK_THROWS_WITH(search.refit(three, moved), Contains(said));
  CHECK_THROWS_WITH(search.closest_point(three, x), Contains(said));
  CHECK_THROWS_WITH(search.closest_near(three, x, 0, [](int) {}), Contains(said));
  CHECK(search.closest_point(nodes, x)->triangle == 1);
}

TEST_CASE("a contact that is followed is where the whole search finds it",
          "[environment][surface][long]") {
  const auto mesh = shapes().back();
  const auto surface = env::boundary(mesh);
  const env::surface_search search(surface, mesh.nodes);
  env::contact_tracker linear(1e-3), tree(1e-3), walking(1e-3);
  std::mt19937 random(23);
  Vector3d x{2.5, 2.5, 5.5};
  std::set<int> looked_at;
  std::size_t most = 0;
  int elsewhere = 0;
  for (int tick = 0; tick < 3000; ++tick) {
    x = (x + 0.03 * anywhere(random, 1.0))
            .cwiseMax(Vector3d(0.8, 0.8, 4.6))
            .cwiseMin(Vector3d(4.2, 4.2, 5.8));
    looked_at.clear();
    const auto a = linear.find(surface, mesh.nodes, x);
    REQUIRE(same(tree.find(search, mesh.nodes, x), a));
    const auto b = walking.follow(search, mesh.nodes, x, [&](int i) { looked_at.insert(i); });
    REQUIRE(b);
    elsewhere += same(a, b) ? 0 : 1;
    REQUIRE(b->distance >= a->distance - 1e-3);
    most = std::max(most, looked_at.size());
  }
  CHECK(elsewhere < 30);  // a valley of the shaken surface may hold it, for a while
  CHECK(most < surface.size() / 3);
}

TEST_CASE("the shape of a surface is the same by its graph", "[environment][surface]") {
  const auto mesh = shapes().back();
  const auto surface = env::boundary(mesh);
  const env::surface_search search(surface, mesh.nodes);
  for (int i = 0; i < static_cast<int>(surface.size()); i += 7) {
    const auto by_view = env::shape_at(surface, mesh.nodes, i, {0.2, 0.3, 0.5});
    const auto by_graph = env::shape_at(search, mesh.nodes, i, {0.2, 0.3, 0.5});
    CHECK(by_view.point == by_graph.point);
    CHECK(by_view.normal == by_graph.normal);
    CHECK(by_view.curvature == by_graph.curvature);
    CHECK(by_view.tangent == by_graph.tangent);
  }
}
