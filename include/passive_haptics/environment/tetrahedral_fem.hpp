// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// An elastic body at rest under nodal forces: K u = f, K factorised once (thesis A.2, in 3 DOF).
//
//   displacements   u(f), always from the REST positions: added to the current ones the body would
//                   creep under a constant force (A13)
//   stiffness       1/(nᵀCn) [N/m] that a finger feels at a point of the surface
//
// Not offered: large rotations, dynamics, contact within the body. Beyond a few per cent of strain
// the linear answer is a shape, not a measurement.

#include <passive_haptics/environment/mesh.hpp>
#include <passive_haptics/environment/rigid_modes.hpp>
#include <passive_haptics/environment/tetrahedral_stiffness.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

/// The body can move without being deformed, so that no force determines its place.
class singular_stiffness : public std::runtime_error {
 public:
  singular_stiffness(const std::string& what, int rigid_modes)
      : std::runtime_error(what), rigid_modes_(rigid_modes) {}

  /// Rigid motions left by the fixed nodes; 0 if the parts are held but hang together by hinges.
  [[nodiscard]] int rigid_modes() const noexcept { return rigid_modes_; }

 private:
  int rigid_modes_;
};

class tetrahedral_fem {
 public:
  /// Factorises the stiffness of `mesh` [m] with `fixed_nodes` held. Throws mesh_error,
  /// std::invalid_argument or singular_stiffness, each with the value and the remedy.
  tetrahedral_fem(const tetrahedral_mesh& mesh, const material& m,
                  std::span<const int> fixed_nodes) {
    check(mesh);
    check(m);
    number_ = free_numbers(mesh, fixed_nodes);
    if (const int modes = rigid_modes_left(mesh, fixed_nodes); modes > 0) {
      refuse(singular_stiffness(
          sentence("tetrahedral_fem: singular, ", modes, " rigid modes left by the fixed nodes in ",
                   find_parts(mesh).count,
                   " connected part(s); fix at least three nodes, not on one line, of each part"),
          modes));
    }
    const Eigen::SparseMatrix<double> stiffness = stiffness_matrix(mesh, m, fixed_nodes);
    if (stiffness.rows() == 0) {
      refuse_argument(
          "tetrahedral_fem: every node is fixed, nothing can move; leave at least one free");
    }
    factorise(stiffness);
    displacements_.assign(mesh.nodes.size(), Eigen::Vector3d::Zero());
    load_.setZero(stiffness.rows());
    work_.setZero(stiffness.rows());
  }

  /// u [m] of every node under nodal forces [N]; fixed nodes stay. No allocation; the result lives
  /// until the next call. std::invalid_argument unless there is one force per node.
  const std::vector<Eigen::Vector3d>& displacements(std::span<const Eigen::Vector3d> forces) {
    if (forces.size() != number_.size()) {
      refuse_argument("displacements: ", forces.size(), " forces for ", number_.size(),
                      " nodes; give one per node");
    }
    for (std::size_t node = 0; node < number_.size(); ++node) {
      if (number_[node] >= 0) load_.segment<3>(3 * number_[node]) = forces[node];
    }
    solve();
    for (std::size_t node = 0; node < number_.size(); ++node) {
      if (number_[node] >= 0) displacements_[node] = load_.segment<3>(3 * number_[node]);
    }
    return displacements_;
  }

  /// nᵀCn [m/N]: how far the point with these barycentric weights gives way along the unit vector
  /// n, per newton along n shared out by the same weights. Zero where all three nodes are fixed.
  [[nodiscard]] double compliance(const std::array<int, 3>& nodes, const Eigen::Vector3d& weights,
                                  const Eigen::Vector3d& n) {
    load_.setZero();
    for (std::size_t k = 0; k < 3; ++k) {
      const int row = number_.at(static_cast<std::size_t>(nodes[k]));
      if (row >= 0) load_.segment<3>(3 * row) += weights[static_cast<Eigen::Index>(k)] * n;
    }
    solve();
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const int row = number_.at(static_cast<std::size_t>(nodes[k]));
      if (row >= 0) sum += weights[static_cast<Eigen::Index>(k)] * n.dot(load_.segment<3>(3 * row));
    }
    return sum;
  }

  /// K = 1/(nᵀCn) [N/m]; infinite where all three nodes are fixed.
  [[nodiscard]] double stiffness(const std::array<int, 3>& nodes, const Eigen::Vector3d& weights,
                                 const Eigen::Vector3d& n) {
    const double c = compliance(nodes, weights, n);
    return c > 0.0 ? 1.0 / c : std::numeric_limits<double>::infinity();
  }

 private:
  void factorise(const Eigen::SparseMatrix<double>& stiffness) {
    factor_.compute(stiffness);
    // A pivot that is nothing but rounding error next to its diagonal: a mechanism.
    double smallest = 0.0;
    if (factor_.info() == Eigen::Success) {
      const Eigen::VectorXd pivots = factor_.permutationPinv() * factor_.vectorD();
      smallest = pivots.cwiseQuotient(stiffness.diagonal()).minCoeff();
      inverse_pivots_ = factor_.vectorD().cwiseInverse();
    }
    if (!(smallest > 1e-12) || !inverse_pivots_.allFinite()) {
      refuse(singular_stiffness(
          sentence(
              "tetrahedral_fem: singular, 0 rigid modes left but the smallest pivot is ", smallest,
              " of its diagonal; parts that share only a node or an edge turn about it: fix three "
              "nodes of each, or mesh the volume again"),
          0));
    }
  }

  /// load_ ← K⁻¹ load_, by hand: SimplicialLDLT::solve allocates.
  void solve() {
    work_.noalias() = factor_.permutationP() * load_;
    factor_.matrixL().solveInPlace(work_);
    work_.array() *= inverse_pivots_.array();
    factor_.matrixU().solveInPlace(work_);
    load_.noalias() = factor_.permutationPinv() * work_;
  }

  std::vector<int> number_;  ///< of a node in the reduced system, −1 if fixed
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
  Eigen::VectorXd inverse_pivots_;
  Eigen::VectorXd load_;
  Eigen::VectorXd work_;
  std::vector<Eigen::Vector3d> displacements_;
};

/// rest + u, node by node [m]. (A13)
[[nodiscard]] inline std::vector<Eigen::Vector3d> deform(std::span<const Eigen::Vector3d> rest,
                                                         std::span<const Eigen::Vector3d> u) {
  if (rest.size() != u.size()) {
    refuse_argument("deform: ", u.size(), " displacements for ", rest.size(),
                    " nodes; give one per node");
  }
  std::vector<Eigen::Vector3d> result(rest.begin(), rest.end());
  for (std::size_t i = 0; i < result.size(); ++i) result[i] += u[i];
  return result;
}

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
