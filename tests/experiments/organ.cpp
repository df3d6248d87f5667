// SPDX-License-Identifier: BSD-3-Clause
// The program of large finite elements: a first look at all of its parts keeps what it promises, the chain in
// real threads among them, and it understands its arguments.
#include "../bench/common/pareto.hpp"
#include "../bench/organ/organ_mesh.hpp"
#include "../bench/organ/program.hpp"
#include "programs.hpp"
#include "support/catch.hpp"
#include <passive_haptics/environment/surface.hpp>

using namespace programs;

namespace {

outcome run_quietly(const std::vector<std::string>& arguments, bool stopped = false) {
  const std::atomic<bool> stop = stopped;
  return quietly([&] { return organ::run(arguments, stop); });
}

}  // namespace

TEST_CASE("the organ of the bench is a sound body, fine under its surface", "[organ]") {
  for (const int side : {4, 9}) {
    const auto body = organ::make_organ(side);
    CAPTURE(side);
    CHECK(body.mesh.nodes.size() == std::size_t(side * side * side));
    REQUIRE_NOTHROW(organ::env::check(body.mesh));
    CHECK(!body.held.empty());
    CHECK(body.held.size() < body.mesh.nodes.size() / 2);
  }
  const double outside = (organ::organ_at({0, 0, 1.0}) - organ::organ_at({0, 0, 0.9})).norm();
  const double inside = organ::organ_at({0, 0, 0.1}).norm();
  CHECK(inside > 2.0 * outside);
  const auto place = organ::top_at(0.2, -0.1);
  CHECK(place.normal.z() > 0.8);
  // 1 mm under the surface along the normal is in the body, 1 mm above it is not.
  organ::stroke_of_organ deep{.deep = 1e-3, .swing = 0.0};
  organ::stroke_of_organ high{.deep = -1e-3, .swing = 0.0};
  const auto body = organ::make_organ(16);
  const auto surface = organ::env::boundary(body.mesh);
  CHECK(organ::env::is_inside(surface, body.mesh.nodes, deep(2.0)));
  CHECK(!organ::env::is_inside(surface, body.mesh.nodes, high(2.0)));
}

TEST_CASE("a Pareto front is what nothing beats in both", "[organ]") {
  using points = std::vector<std::pair<double, double>>;
  using places = std::vector<std::size_t>;
  CHECK(experiments::pareto_front(points{{3, 1}, {1, 3}, {2, 3}, {2, 2}, {4, 1}}) ==
        places{1, 3, 0});
  CHECK(experiments::pareto_front(points{}).empty());
  // Of three quantities: what is beaten in two of them is kept for the third, and of two that are alike the first.
  using triples = std::vector<std::array<double, 3>>;
  const triples of_three{{1, 3, 3}, {2, 3, 3}, {3, 3, 1}, {3, 1, 3}, {3, 3, 1}, {3, 3, 2}};
  CHECK(experiments::pareto_front(of_three) == places{0, 2, 3});
  CHECK(experiments::pareto_front(triples{}).empty());
}

TEST_CASE("a first look at an organ keeps what it promises", "[organ]") {
  const scratch_folder out;
  for (const char* part : {"precision", "chain", "deflections"}) {
    CAPTURE(part);
    const outcome found = run_quietly({"--quick", "--only", part, "--out", out / ""});
    INFO(found.complaint);
    CHECK(found.code == 0);
    const std::string json = content(out / "organ.json");
    CHECK(json.find('"' + std::string(part) + '"') != std::string::npos);
  }
  for (const char* file : {"chain_organ.vtu", "chain_scope.csv", "chain_surface.csv"}) {
    CAPTURE(file);
    CHECK(lines(content(out / file)).size() > 100);
  }
}

TEST_CASE("organ names the parts that there are, and stops when it is asked to", "[organ]") {
  const scratch_folder out;
  CHECK(run_quietly({"--only", "nothing"}).code == 2);
  CHECK(run_quietly({"--side", "3"}).code == 2);
  CHECK(run_quietly({"--help"}).code == 0);
  CHECK(run_quietly({"--quick", "--only", "chain", "--out", out / ""}, true).code == 130);
  CHECK(content(out / "organ.json").empty());
}
