// SPDX-License-Identifier: BSD-3-Clause
#include "environment/shapes.hpp"

#include <optional>
#include <stdexcept>

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
