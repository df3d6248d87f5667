// SPDX-License-Identifier: BSD-3-Clause
// An update of a deformable body takes nothing from the heap, by operator new (which support/allocations.cpp
// makes a malloc) or as Eigen does. The linker leads every malloc of this program through here.
#include "../bench/organ/sparse_ldlt.hpp"
#include "environment/bodies.hpp"
#include "support/scratch_folder.hpp"
#include <passive_haptics/environment/compliance_table.hpp>
#include <passive_haptics/environment/deformable_body.hpp>

#include <cstdlib>

namespace {
thread_local long count = 0;
}  // namespace

extern "C" {
void* __real_malloc(std::size_t size);
void* __wrap_malloc(std::size_t size) {
  ++count;
  return __real_malloc(size);
}
}

namespace {

/// How often the heap was asked while a body is stroked and left, from its first update on.
template <class Body>
long asked_by(Body& body) {
  const long before = count;
  auto contact = body.update({0.03, 0.04, 0.12}, Vector3d::Zero());
  for (int i = 0; i < 60; ++i) {
    const double z = i < 50 ? 0.098 - 1e-4 * i : 0.12;
    const Vector3d force = contact.stiffness * std::max(0.0, contact.depth) * contact.normal;
    contact = body.update({0.03 + 8e-4 * i, 0.04 + 5e-4 * i, z}, force);
  }
  return count - before;
}

}  // namespace

TEST_CASE("an update of a deformable body takes nothing from the heap", "[environment][realtime]") {
  const auto mesh = env::scaled(blocks(6, [](int, int, int) { return true; }), 0.1 / 6);
  std::vector<int> held;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    if (mesh.nodes[i].z() < 1e-6) held.push_back(static_cast<int>(i));
  }
  const auto patch = env::patch_around(env::boundary(mesh), mesh.nodes, {0.05, 0.05, 0.1}, 60);
  for (const double radius : {0.0, 0.03}) {
    for (const auto moved : {env::moved_nodes::all, env::moved_nodes::around}) {
      CAPTURE(radius, moved == env::moved_nodes::around);
      const env::body_options options{.radius = radius, .moved = moved};
      env::deformable_body fronts(mesh, soft, held, options);
      CHECK(asked_by(fronts) == 0);
      env::deformable_body touched(mesh, env::tetrahedral_fem(mesh, soft, held, {.touched = patch}),
                                   options);
      CHECK(asked_by(touched) == 0);
      env::basic_deformable_body<env::basic_tetrahedral_fem<organ::sparse_ldlt>> columns(
          mesh, soft, held, options);
      CHECK(asked_by(columns) == 0);
      const scratch_folder folder;
      const env::tetrahedral_fem fem(mesh, soft, held);
      env::compute_table(folder / "cube.table", fem, 1, patch);
      env::basic_deformable_body<env::compliance_table<>> table(
          mesh, env::read_table(folder / "cube.table", 1, mesh.nodes.size()), options);
      CHECK(asked_by(table) == 0);
    }
  }
  const long before = count;  // the controls
  const auto number = std::make_unique<int>(1);
  const Eigen::VectorXd numbers = Eigen::VectorXd::Zero(100);
  CHECK(count == before + 2);
  CHECK(numbers.size() + *number == 101);
}
