// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Eigen's own sparse factorisation as a stiffness_solver: column by column, in the order of AMD. For some
// hundred nodes it is as good as multifrontal; at 10 648 it takes some 50 times as long.

#include <passive_haptics/environment/stiffness_solver.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <cstddef>

namespace organ {

namespace env = passive_haptics::environment;

class sparse_ldlt {
 public:
  /// Eigen tells the size of a factor only when it has it.
  [[nodiscard]] static std::size_t analyse(const env::node_graph& /*graph*/) noexcept { return 0; }

  /// Cannot be stopped once it has begun.
  [[nodiscard]] env::factor_result factorise(const Eigen::SparseMatrix<double>& stiffness,
                                             const env::on_progress& tell = {}) {
    if (tell && !tell(0.0)) return {.stopped = true};
    factor_.compute(stiffness);
    if (factor_.info() != Eigen::Success) return {};
    const Eigen::VectorXd pivots = factor_.permutationPinv() * factor_.vectorD();
    inverse_pivots_ = factor_.vectorD().cwiseInverse();
    work_.setZero(stiffness.rows());
    if (!inverse_pivots_.allFinite()) return {};
    return {.smallest_pivot = pivots.cwiseQuotient(stiffness.diagonal()).minCoeff()};
  }

  /// b ← K⁻¹b, by hand: SimplicialLDLT::solve allocates.
  void solve(Eigen::VectorXd& b) {
    work_.noalias() = factor_.permutationP() * b;
    factor_.matrixL().solveInPlace(work_);
    work_.array() *= inverse_pivots_.array();
    factor_.matrixU().solveInPlace(work_);
    b.noalias() = factor_.permutationPinv() * work_;
  }

 private:
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
  Eigen::VectorXd inverse_pivots_;
  Eigen::VectorXd work_;
};
static_assert(env::stiffness_solver<sparse_ldlt>);

}  // namespace organ
