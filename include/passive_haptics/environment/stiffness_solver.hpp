// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The contract of a solver of K u = f for the finite elements: multifrontal (the default), or your own.
//
//     struct by_cholmod {                                        // three functions are enough
//       std::size_t analyse(const env::node_graph&);             // bytes that it will need; 0: unknown
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

/// Is called during a long computation with the share that is done, 0 to 1; if it returns false, the computation
/// ends. An empty one is never called.
using on_progress = std::function<bool(double done)>;

struct factor_result {
  double smallest_pivot =
      0.0;               ///< least pivot over its diagonal entry of K; about 1e-16 if K is singular
  bool stopped = false;  ///< on_progress has ended the factorisation: there is no factor
};

/// A solver for a K [N/m] that is symmetric and positive definite, with three rows per node in the graph's order.
template <class S>
concept stiffness_solver = std::default_initializable<S> &&
    requires(S solver, const node_graph& graph, const Eigen::SparseMatrix<double>& stiffness,
             const on_progress& tell, Eigen::VectorXd& b) {
  { solver.analyse(graph) } -> std::convertible_to<std::size_t>;
  { solver.factorise(stiffness, tell) } -> std::same_as<factor_result>;
  solver.solve(b);
};

/// Says that on_progress has ended a computation.
class stopped_by_caller : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Says that a body would take more memory than there is; none of it has been allocated.
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
