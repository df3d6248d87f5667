// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What solves K u = f for the finite elements: multifrontal (the default), or your own.
//
//     struct by_cholmod {                                        // three functions are enough
//       std::size_t analyse(const env::node_graph&);             // bytes that it will take; 0: unknown
//       env::factor_result factorise(const Eigen::SparseMatrix<double>& K, const env::on_progress&);
//       void solve(Eigen::VectorXd& b);                          // b ← K⁻¹b, without allocating
//     };
//     env::basic_tetrahedral_fem<by_cholmod> fem(mesh, material, fixed);

#include <passive_haptics/environment/node_graph.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <concepts>
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

/// Told how much of a long computation is done, 0 to 1, several times a second; false ends it. An empty
/// one is never asked.
using on_progress = std::function<bool(double done)>;

/// What became of a factorisation.
struct factor_result {
  double smallest_pivot =
      0.0;               ///< relative to its diagonal entry of K; rounding error: K is singular
  bool stopped = false;  ///< by on_progress: there is no factor
};

/// A solver of K [N/m], symmetric and positive definite, three rows per node of the graph in its order.
template <class S>
concept stiffness_solver = std::default_initializable<S> &&
    requires(S solver, const node_graph& graph, const Eigen::SparseMatrix<double>& stiffness,
             const on_progress& tell, Eigen::VectorXd& b) {
  { solver.analyse(graph) } -> std::convertible_to<std::size_t>;
  { solver.factorise(stiffness, tell) } -> std::same_as<factor_result>;
  solver.solve(b);
};

/// on_progress has ended a computation: nothing of it is left.
class stopped_by_caller : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A body would take more memory than there is: none of it has been taken.
class memory_refused : public std::runtime_error {
 public:
  memory_refused(const std::string& what, double bytes) : std::runtime_error(what), bytes_(bytes) {}
  [[nodiscard]] double bytes() const noexcept { return bytes_; }  ///< predicted [B]

 private:
  double bytes_;
};

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
