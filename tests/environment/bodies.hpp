// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Bodies for the tests of the finite elements.
#include "environment/shapes.hpp"
#include <passive_haptics/environment/tetrahedral_fem.hpp>

inline constexpr env::material soft{.young = 5e3, .poisson = 0.3};

inline Vector3d anything(std::mt19937& random) {
  return anywhere(random, 1.0);
}

/// A box of n cubes along x, six upright tetrahedra in each, cubes of 1 m.
inline env::tetrahedral_mesh bar(int n) {
  env::tetrahedral_mesh mesh;
  for (int i = 0; i <= n; ++i) {
    for (int corner = 0; corner < 4; ++corner) mesh.nodes.emplace_back(i, corner / 2, corner % 2);
  }
  for (int i = 0; i < n; ++i) {
    std::array<int, 3> axis{1, 2, 4};  // node steps in z, y, x
    do {
      std::array<int, 4> t{4 * i, 4 * i + axis[0], 4 * i + axis[0] + axis[1], 4 * i + 7};
      if (env::signed_volume(mesh, t) < 0.0) std::swap(t[2], t[3]);
      mesh.tetrahedra.push_back(t);
    } while (std::next_permutation(axis.begin(), axis.end()));
  }
  return mesh;
}

inline int zero_eigenvalues(const env::tetrahedral_mesh& mesh, const std::vector<int>& fixed) {
  const Eigen::MatrixXd K = env::stiffness_matrix(mesh, soft, fixed);
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K, Eigen::EigenvaluesOnly).eigenvalues();
  CHECK(values.minCoeff() > -1e-10 * values.maxCoeff());
  return static_cast<int>((values.array() < 1e-10 * values.maxCoeff()).count());
}
