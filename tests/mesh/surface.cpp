// SPDX-License-Identifier: BSD-3-Clause
// What is no mesh is refused with a sentence and the last good one stays; news cross threads whole.
#include "mesh/shapes.hpp"

#include <atomic>
#include <thread>

using namespace meshes;
using Catch::Matchers::Contains;

TEST_CASE("what is no mesh is refused by a sentence that names it", "[mesh]") {
  const body b = plate();
  const auto said = [](const std::vector<triangle>& t, const std::vector<triple>& n) {
    const std::string fault = ph::mesh::surface::check(t, n);
    CHECK_THROWS_WITH(ph::mesh::surface(t, n), Contains(fault));
    return fault;
  };
  CHECK(ph::mesh::surface::check(b.triangles, b.nodes).empty());
  CHECK_THAT(said({}, b.nodes), Contains("no triangles"));
  CHECK_THAT(said({{0, 1, 8}}, b.nodes), Contains("triangle 0 names node 8 of 8"));
  CHECK_THAT(said({{0, 1, 2}, {0, -1, 2}}, b.nodes), Contains("triangle 1 names node -1"));
  auto bad = b.nodes;
  bad[3].y = std::nan("");
  CHECK_THAT(said(b.triangles, bad), Contains("node 3 at (0.05, nan, 0) m is not finite"));
  CHECK_THAT(said(b.triangles, std::vector<triple>(8)), Contains("has an area"));
  // Open, inside out, double, of no area in part: all serve.
  CHECK(ph::mesh::surface::check(std::vector<triangle>{{0, 1, 3}, {1, 0, 3}, {1, 1, 2}}, b.nodes)
            .empty());
}

TEST_CASE("a mesh that was told in millimetres or kilometres is doubted", "[mesh]") {
  const body b = plate();
  CHECK(ph::mesh::surface::doubt(b.nodes).empty());
  const auto doubt = [&](double unit) {
    auto nodes = b.nodes;
    for (triple& p : nodes) p = p * unit;
    CHECK(ph::mesh::surface::check(b.triangles, nodes).empty());
    return ph::mesh::surface::doubt(nodes);
  };
  CHECK_THAT(doubt(1e3), Contains("it is 100 m wide") && Contains("millimetres"));
  CHECK_THAT(doubt(1e-3), Contains("it is 0.0001 m wide") && Contains("give metres"));
  auto far_off = b.nodes;
  for (triple& p : far_off) p.z += 400.0;
  CHECK_THAT(ph::mesh::surface::doubt(far_off), Contains("it lies 400 m from the origin"));
}

TEST_CASE("a mesh of too many triangles for 20 updates a second is doubted", "[mesh]") {
  CHECK(ph::mesh::surface::doubt_count(1'000'000).empty());
  CHECK_THAT(ph::mesh::surface::doubt_count(10'000'000),
             Contains("its 10000000 triangles take about 0.6 s an update") &&
                 Contains("give a coarser one, or move it by poses"));
}

TEST_CASE("a mesh whose triangles have left their neighbours is doubted", "[mesh]") {
  const body b = sphere(3, 0.04);
  auto mixed = b.nodes;
  const std::size_t count = mixed.size();
  for (std::size_t i = 0; i < count; ++i) std::swap(mixed[i], mixed[i * i % count]);
  ph::mesh::surface s(b.triangles, mixed);
  CHECK(s.doubt().empty());
  REQUIRE(s.update(b.nodes));
  CHECK_THAT(s.doubt(), Contains("make another mesh of these nodes"));
  ph::mesh::surface anew(b.triangles, b.nodes);
  for (const double by : {0.5, 1.0, 2.0}) {  // it grows, is drawn out, and is wound up by a turn
    auto nodes = b.nodes;
    for (triple& p : nodes) {
      const double a = 6.28 * by * p.z / 0.08;
      p = {by * (p.x * std::cos(a) - p.y * std::sin(a)),
           by * (p.x * std::sin(a) + p.y * std::cos(a)), by * by * p.z};
    }
    REQUIRE(anew.update(nodes));
    CHECK(anew.doubt().empty());
  }
}

TEST_CASE("nodes with x, y and z are taken as they are", "[mesh]") {
  struct place {
    float x, y, z;
  };
  std::vector<place> places{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  ph::mesh::surface s({{0, 1, 2}}, places);
  ph::mesh::surface round({{0, 1, 2}}, places, ph::mesh::smooth{});
  ph::mesh::proxy ball({.radius = 5e-4});
  REQUIRE(ball.touch(s));
  for (int k = 0; k < 50; ++k) ball.step({0.2, 0.3, 0.01 - 4e-4 * k}, T);
  CHECK_THAT(ball.place().z, Catch::Matchers::WithinAbs(5e-4, 1e-9));
  places[1].y = std::nanf("");
  CHECK_FALSE(s.update(places));
  CHECK_THAT(s.fault(), Contains("node 1 at (1, nan, 0) m is not finite"));
}

TEST_CASE("news that are no news leave the last good mesh under the finger", "[mesh]") {
  const body b = plate();
  ph::mesh::surface s(b.triangles, b.nodes);
  ph::mesh::proxy ball({.radius = 5e-4});
  ball.touch(s);
  ball.step({0, 0, 0.01}, T);
  CHECK_FALSE(s.update(std::vector<triple>(7)));
  CHECK_THAT(s.fault(), Contains("news of 7 nodes for a mesh of 8"));
  auto bad = b.nodes;
  bad[0].x = 1.0 / 0.0;
  CHECK_FALSE(s.update(bad));
  CHECK_THAT(s.fault(), Contains("node 0 at (inf, -0.05, 0) m is not finite"));
  CHECK_FALSE(s.update(ph::mesh::pose{.position = {0, std::nan(""), 0}}));
  CHECK_FALSE(s.update(ph::mesh::pose{.w = 0.0}));
  CHECK_THAT(s.fault(), Contains("the pose at (0, 0, 0) m, turned by (0, 0, 0, 0), has"));
  CHECK_FALSE(s.update(ph::mesh::pose{.position = {0, 0, 1e169}}));
  CHECK_THAT(s.fault(), Contains("the pose at (0, 0, 1e+169) m, turned by (1, 0, 0, 0), has"));
  for (int k = 0; k < 50; ++k) ball.step({0, 0, -0.01}, T);
  CHECK(length(ball.place() - triple{0, 0, 5e-4}) < 1e-9);
  CHECK_FALSE(s.update(std::vector<std::array<double, 3>>(8, {0.0, 0.0, 0.0})));
  CHECK_THAT(s.fault(), Contains("none of its") && Contains("triangles has an area"));
  auto line = b.nodes;
  for (triple& p : line) p.y = p.z = 0.0;
  CHECK_FALSE(s.update(line));
  for (int k = 0; k < 100; ++k) ball.step({0, 0, -0.01}, T);
  CHECK(length(ball.place() - triple{0, 0, 5e-4}) < 1e-9);
  CHECK(s.update(b.nodes));
  CHECK(s.fault().empty());
  CHECK(ball.clearance() >= 1.25e-4);
}

TEST_CASE("a tick sees each shape whole, whatever another thread writes meanwhile", "[mesh]") {
  const body b = sphere(2, 0.04);
  ph::mesh::surface s(b.triangles, b.nodes);
  std::atomic<bool> stop{false};
  std::thread slow([&] {
    for (int k = 0; !stop; ++k) {
      auto nodes = b.nodes;
      for (triple& p : nodes) p = p * (1.0 + 0.01 * (k % 10));
      (void)s.update(nodes);
      ph::mesh::pose p;
      p.position = {0.001 * (k % 5), 0, 0};
      (void)s.update(p);
    }
  });
  ph::mesh::proxy ball({.radius = 5e-4});
  ball.touch(s);
  int torn = 0, news = 0;
  for (int k = 0; k < 20000; ++k) {
    ball.step({0.001 * (k % 7), 0.0, 0.08 - 0.06 * std::min(1.0, k / 1000.0)}, T);
    double least = 1.0, most = 0.0;  // of all nodes on their way between two spheres: one radius
    for (int i = 0; i < int(b.triangles.size()); i += 37) {
      for (const triple& p : ball.triangle(i)) {
        least = std::min(least, length(p));
        most = std::max(most, length(p));
      }
    }
    torn += most - least > 1e-12 ? 1 : 0;
    news += ball.shown() < 1.0 ? 1 : 0;
  }
  stop = true;
  slow.join();
  CHECK(torn == 0);
  CHECK(news > 0);
  CHECK(ball.clearance() >= 1.25e-4);
}

TEST_CASE("a mesh outlives who touches it: the next one goes on, and no update waits", "[mesh]") {
  const body b = plate();
  ph::mesh::surface s(b.triangles, b.nodes);
  auto nodes = b.nodes;
  for (int life = 0; life < 10; ++life) {
    ph::mesh::proxy ball({.radius = 5e-4});
    ball.touch(s);
    for (int k = 0; k < 7; ++k) {  // it ends on the way between two shapes
      for (triple& p : nodes) p.z += 0.001;
      REQUIRE(s.update(nodes));
      ball.step({0, 0, 0.2 - 0.01 * k}, T);
      ball.step({0, 0, 0.2 - 0.01 * k}, T);
    }
    CHECK(ball.shown() <= 1.0);
  }
  ph::mesh::proxy last({.radius = 5e-4});
  last.touch(s);
  last.step({0, 0, 0.2}, T);
  for (int k = 0; k < 100; ++k) last.step({0, 0, 0.0}, T);
  CHECK(length(last.place() - triple{0, 0, nodes[0].z + 5e-4}) < 1e-9);
}
