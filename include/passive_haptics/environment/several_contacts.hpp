// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Several contacts at once on one elastic body, each of which gives way to the forces of all.
//
//   G_ij = nᵢᵀ C(pᵢ, pⱼ) nⱼ               the capacitance matrix of the contacts [m/N], from a compliance_table
//   f ≥ 0,  G f ≥ d,  f·(G f − d) = 0     no contact pulls, none penetrates, and a force f [N] acts only where the
//                                         gap G f − d is zero; d [m] is the depth of each in the body at rest
//
// For elastic tips add 1/k [m/N] to the diagonal of G. D. L. James, D. K. Pai, SIGGRAPH 1999. The complementarity
// problem is solved by K. G. Murty's least-index pivoting, which ends for every positive definite G (1974).

#include <passive_haptics/environment/refuse.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

/// A point of the surface that a force pushes along −normal.
struct contact_point {
  std::array<int, 3> nodes;  ///< of its triangle
  Eigen::Vector3d weights;   ///< barycentric
  Eigen::Vector3d normal;    ///< unit, outward
};

/// G [m/N], k × k for k contacts. It is singular if two points are the same, or one does not move.
template <class Table>
[[nodiscard]] Eigen::MatrixXd capacitance(const Table& table,
                                          std::span<const contact_point> contacts) {
  const auto count = static_cast<Eigen::Index>(contacts.size());
  Eigen::MatrixXd g(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {  // float tables are symmetric up to rounding only
      const contact_point &a = contacts[static_cast<std::size_t>(i)],
                          &b = contacts[static_cast<std::size_t>(j)];
      g(i, j) = g(j, i) =
          a.normal.dot(table.between(a.nodes, a.weights, b.nodes, b.weights) * b.normal);
    }
  }
  return g;
}

/// The k forces f [N] of k contacts at the depths d [m]. Throws std::invalid_argument unless G is k × k and
/// positive definite by more than rounding, and everything is finite.
[[nodiscard]] inline Eigen::VectorXd contact_forces(const Eigen::MatrixXd& g,
                                                    const Eigen::VectorXd& depth) {
  const Eigen::Index count = depth.size();
  if (g.rows() != count || g.cols() != count || !g.allFinite() || !depth.allFinite()) {
    refuse_argument("contact_forces: a matrix of ", g.rows(), " x ", g.cols(), " for ", count,
                    " depths, all of them finite, is needed");
  }
  // A pivot is the part of G_ii that the contacts before i do not explain.
  const Eigen::LLT<Eigen::MatrixXd> whole(g);
  const auto pivots = whole.matrixLLT().diagonal().array().square();
  if (whole.info() != Eigen::Success || (pivots < 1e-12 * g.diagonal().array()).any()) {
    refuse_argument(
        "contact_forces: the matrix is not positive definite; leave out contacts that are at the "
        "same point or on fixed nodes, or add 1/k of the tips to its diagonal");
  }
  std::vector<bool> pushes(static_cast<std::size_t>(count), false);
  const double noise = 1e-12 * (count > 0 ? depth.cwiseAbs().maxCoeff() : 0.0);
  for (;;) {
    // For a contact that does not push, row and column are those of the unit matrix, so its force is 0.
    Eigen::MatrixXd part = g;
    Eigen::VectorXd right = depth;
    for (Eigen::Index i = 0; i < count; ++i) {
      if (pushes[static_cast<std::size_t>(i)]) continue;
      part.row(i).setZero();
      part.col(i).setZero();
      part(i, i) = 1.0;
      right[i] = 0.0;
    }
    const Eigen::VectorXd force = part.llt().solve(right);
    const Eigen::VectorXd gap = g * force - depth;
    const auto is_right = [&](Eigen::Index i) {
      return pushes[static_cast<std::size_t>(i)] ? force[i] * g(i, i) >= -noise : gap[i] >= -noise;
    };
    Eigen::Index wrong = 0;  // the first contact that pulls or penetrates
    while (wrong < count && is_right(wrong)) ++wrong;
    if (wrong == count) return force.cwiseMax(0.0);
    pushes[static_cast<std::size_t>(wrong)] = !pushes[static_cast<std::size_t>(wrong)];
  }
}

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
