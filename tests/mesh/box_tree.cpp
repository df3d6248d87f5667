// SPDX-License-Identifier: BSD-3-Clause
// Walks see all that is near and little else, and the closest point of a triangle is the closest.
// (tests/environment/surface_search.cpp has the same tree against a search without one.)
#include "mesh/shapes.hpp"

using namespace meshes;

TEST_CASE("no point of a triangle is closer than the closest, of slivers and of segments too",
          "[mesh]") {
  std::mt19937 random(5);
  std::uniform_real_distribution<> any(-1.0, 1.0), share(0.0, 1.0);
  for (int run = 0; run < 3000; ++run) {
    corners t;
    for (triple& p : t) p = {any(random), any(random), any(random)};
    if (run % 4 == 1) t[2] = between(t[0], t[1], share(random));
    if (run % 4 == 2) t[2] = between(t[0], t[1], share(random)) + triple{0, 0, 1e-7};
    if (run % 4 == 3 && run % 8 == 3) t[1] = t[0];
    const triple p{2 * any(random), 2 * any(random), 2 * any(random)};
    const triple w = closest_weights(t, p);
    CHECK(w.x >= 0.0);
    CHECK(w.y >= 0.0);
    CHECK(w.z >= 0.0);
    CHECK(std::abs(w.x + w.y + w.z - 1.0) < 1e-12);
    const double least = length(point_at(t, w) - p);
    for (int k = 0; k < 30; ++k) {
      const double a = share(random), b = share(random) * (1.0 - a);
      CHECK(length(point_at(t, {a, b, 1.0 - a - b}) - p) >= least - 1e-7);
    }
  }
}

TEST_CASE("a walk visits what is near, whatever has moved, and leaves the rest", "[mesh]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<> any(-1.0, 1.0);
  std::vector<triple> places(5000);
  for (triple& p : places) p = {any(random), any(random), any(random)};
  ph::mesh::box_tree tree(places);
  std::vector<ph::mesh::box> boxes(tree.branches().size());
  const auto grow = [&](int i, ph::mesh::box& b) { b.grow(places[std::size_t(i)]); };
  tree.fit(boxes, grow);
  for (int run = 0; run < 200; ++run) {
    const int moved[] = {run, 2 * run, 4999 - run};
    for (const int i : moved) places[std::size_t(i)] = {any(random), any(random), any(random)};
    tree.fit(boxes, moved, grow);
    const triple x{any(random), any(random), any(random)};
    const double reach = 0.1;
    int near = 0, seen = 0, all = 0;
    for (const triple& p : places) near += length(p - x) <= reach ? 1 : 0;
    tree.walk([&](int b) { return boxes[std::size_t(b)].squared_distance(x); },
              [&](double d2) { return d2 <= reach * reach; },
              [&](int i) {
                ++all;
                seen += length(places[std::size_t(i)] - x) <= reach ? 1 : 0;
              });
    CHECK(seen == near);
    CHECK(all < 500);
  }
}
