// SPDX-License-Identifier: BSD-3-Clause
#include "environment/shapes.hpp"

#include <stdexcept>

namespace {

env::tetrahedral_mesh one_tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}};
}

std::string fault_of(const env::tetrahedral_mesh& mesh) {
  try {
    env::check(mesh, "here");
    return "";
  } catch (const env::mesh_error& e) {
    return e.what();
  }
}

}  // namespace

TEST_CASE("check refuses meshes that cannot carry a field", "[environment][mesh]") {
  CHECK(fault_of(one_tetrahedron()).empty());
  const auto with = [](const std::function<void(env::tetrahedral_mesh&)>& edit) {
    auto mesh = one_tetrahedron();
    edit(mesh);
    return fault_of(mesh);
  };
  CHECK(contains(with([](auto& m) { m.nodes.clear(); }), "here: has no nodes; "));
  CHECK(contains(with([](auto& m) { m.tetrahedra.clear(); }), "here: has no tetrahedra; "));
  CHECK(contains(with([](auto& m) { m.tetrahedra[0][2] = 4; }), "tetrahedron 0 names node 4 of 4"));
  CHECK(contains(with([](auto& m) { m.tetrahedra[0][2] = -1; }), "names node -1"));
  CHECK(contains(with([](auto& m) { m.tetrahedra[0][2] = 1; }), "names node 1 twice"));
  CHECK(contains(with([](auto& m) { m.nodes.emplace_back(2, 2, 2); }), "node 4 belongs to no"));
  CHECK(contains(with([](auto& m) {
                   m.tetrahedra.push_back({1, 2, 0, 3});
                 }),
                 "here: tetrahedron 1 and tetrahedron 0 overlap at a common face; "));
  CHECK(contains(with([](auto& m) { std::swap(m.tetrahedra[0][0], m.tetrahedra[0][1]); }),
                 "oriented()"));
  CHECK(contains(with([](auto& m) { m.nodes[3].z() = 1e-10; }), "has no volume"));
  CHECK(with([](auto& m) { m.nodes[3].z() = 1e-6; }).empty());
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    CHECK(contains(with([&](auto& m) { m.nodes[3].z() = bad; }), "node 3 is not finite"));
  }
  // Flatness is relative: the size of the mesh does not matter.
  CHECK(fault_of(env::scaled(one_tetrahedron(), 1e-9)).empty());
  CHECK(fault_of(env::scaled(one_tetrahedron(), 1e9)).empty());
}

TEST_CASE("check refuses elements that overlap at a face", "[environment][mesh]") {
  env::tetrahedral_mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}},
                             {{0, 1, 2, 3}, {0, 2, 1, 4}}};
  CHECK(fault_of(mesh).empty());
  mesh.nodes.emplace_back(0.1, 0.1, -2.0);
  mesh.tetrahedra.push_back({0, 2, 1, 5});  // a third owner
  CHECK(contains(fault_of(mesh), "tetrahedron 2 and tetrahedron 0 overlap"));
  mesh.nodes.erase(mesh.nodes.begin() + 3);
  mesh.tetrahedra = {{0, 2, 1, 3}, {0, 2, 1, 4}};  // two owners, but on the same side
  CHECK(contains(fault_of(mesh), "tetrahedron 1 and tetrahedron 0 overlap"));
}

TEST_CASE("bounds is the smallest box around a mesh", "[environment][mesh]") {
  const auto box = env::bounds(one_tetrahedron());
  CHECK(box.min() == Eigen::Vector3d(0, 0, 0));
  CHECK(box.max() == Eigen::Vector3d(1, 1, 1));
}

TEST_CASE("scaled changes lengths and refuses factors that lose the mesh", "[environment][mesh]") {
  const auto mesh = env::scaled(one_tetrahedron(), 0.1);
  CHECK_THAT(env::signed_volume(mesh, mesh.tetrahedra[0]),
             Catch::Matchers::WithinRel(1e-3 / 6.0, 1e-12));
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()}) {
    CHECK_THROWS_AS(env::scaled(one_tetrahedron(), bad), std::invalid_argument);
  }
}
