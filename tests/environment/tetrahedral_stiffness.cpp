// SPDX-License-Identifier: BSD-3-Clause
#include "environment/bodies.hpp"

TEST_CASE("stiffness_matrix is symmetric and resists no rigid motion", "[environment][fem]") {
  const auto mesh = env::ball(0.05);
  const Eigen::MatrixXd K = env::stiffness_matrix(mesh, soft);
  REQUIRE(K.rows() == 33);
  CHECK((K - K.transpose()).norm() <= 1e-13 * K.norm());
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::VectorXd shift(33);
    Eigen::VectorXd turn(33);
    for (int i = 0; i < 11; ++i) {
      shift.segment<3>(3 * i) = Vector3d::Unit(axis);
      turn.segment<3>(3 * i) = Vector3d::Unit(axis).cross(mesh.nodes[std::size_t(i)]);
    }
    CHECK((K * shift).norm() < 1e-12 * K.norm());
    CHECK((K * turn).norm() < 1e-12 * K.norm() * turn.norm());
  }
  CHECK_THAT(env::scaled(mesh, 2.0).nodes[0].z(), WithinRel(0.1, 1e-12));
  const Eigen::MatrixXd twice = env::stiffness_matrix(env::scaled(mesh, 2.0), soft);
  CHECK((twice - 2.0 * K).norm() < 1e-12 * K.norm());  // stiffness grows with length
}
