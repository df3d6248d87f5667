// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// An elastic body at rest under nodal forces: K u = f, K factorised once (thesis A.2, in 3 DOF).
//
//   displacements   u(f) [m], always from the REST positions: added to the current positions it would let
//                   the body creep under a constant force (audit.md A13)
//   stiffness       1/(nᵀCn) [N/m] that a finger feels at a point of the surface
//   press, load, displacement     u of a few nodes under a force at one point, at a haptic rate
//
// Not offered: large rotations, dynamics, contact within the body. Beyond a few per cent of strain the
// linear displacements look right but are not accurate.

#include <passive_haptics/environment/memory_limit.hpp>
#include <passive_haptics/environment/mesh.hpp>
#include <passive_haptics/environment/multifrontal.hpp>
#include <passive_haptics/environment/rigid_modes.hpp>
#include <passive_haptics/environment/stiffness_solver.hpp>
#include <passive_haptics/environment/tetrahedral_stiffness.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
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

  /// Number of rigid motions left by the fixed nodes; 0 if the parts are held but connected by hinges.
  [[nodiscard]] int rigid_modes() const noexcept { return rigid_modes_; }

 private:
  int rigid_modes_;
};

struct fem_options {
  on_progress tell = {};      ///< called while K is factorised; false throws stopped_by_caller
  double memory_limit = 0.0;  ///< for the factor [B]; 0: available memory (memory_limit.hpp)
  /// Nodes of the mesh that contacts will press, from patch_around() for example. A contact among M of them reads
  /// the triangle of a 3M × 3M matrix, 36 M² bytes. A contact elsewhere gives the same result, but takes longer.
  std::span<const int> touched = {};
};

/// A solver that presses a point without solving for the whole body, as multifrontal does.
template <class S>
concept pressing_solver = stiffness_solver<S> &&
    requires(S solver, typename S::pressed& at, typename S::answer& to, std::span<const int> nodes,
             std::span<const double> weights, const Eigen::Vector3d& force, int node) {
  solver.prepare(at);
  solver.prepare(to);
  solver.press(at, nodes, weights);
  solver.forget(to);
  {solver.displacement(to, at, force, node)};
};

/// A point that forces act on, by full solutions: three columns of K⁻¹, for any solver.
template <stiffness_solver Solver>
class point_load {
 public:
  void prepare(const Solver& /*solver*/, Eigen::Index rows) {
    for (auto& column : columns_) column.setZero(rows);
  }
  const Eigen::Matrix3d& press(Solver& solver, std::span<const int> nodes,
                               std::span<const double> weights) {
    for (int c = 0; c < 3; ++c) {
      Eigen::VectorXd& column = columns_[slot(c)];
      column.setZero();
      for (std::size_t i = 0; i < nodes.size(); ++i) column[3 * nodes[i] + c] += weights[i];
      solver.solve(column);
      for (int r = 0; r < 3; ++r) {
        compliance_(r, c) = 0.0;
        for (std::size_t i = 0; i < nodes.size(); ++i) {
          compliance_(r, c) += weights[i] * column[3 * nodes[i] + r];
        }
      }
    }
    return compliance_;
  }
  void load(Solver& /*solver*/, const Eigen::Vector3d& force) { force_ = force; }
  [[nodiscard]] Eigen::Vector3d displacement(Solver& /*solver*/, int node) const {
    Eigen::Vector3d u = Eigen::Vector3d::Zero();
    for (int c = 0; c < 3; ++c) {
      for (int r = 0; r < 3; ++r) u[r] += columns_[slot(c)][3 * node + r] * force_[c];
    }
    return u;
  }

 private:
  std::array<Eigen::VectorXd, 3> columns_;
  Eigen::Matrix3d compliance_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();
};

/// The same for a pressing_solver, which solves for the nodes asked for only.
template <pressing_solver Solver>
class point_load<Solver> {
 public:
  void prepare(const Solver& solver, Eigen::Index /*rows*/) {
    solver.prepare(at_);
    solver.prepare(answer_);
  }
  const Eigen::Matrix3d& press(Solver& solver, std::span<const int> nodes,
                               std::span<const double> weights) {
    solver.press(at_, nodes, weights);
    return at_.compliance;
  }
  void load(Solver& solver, const Eigen::Vector3d& force) {
    solver.forget(answer_);
    force_ = force;
  }
  [[nodiscard]] Eigen::Vector3d displacement(Solver& solver, int node) {
    return solver.displacement(answer_, at_, force_, node);
  }

 private:
  typename Solver::pressed at_;
  typename Solver::answer answer_;
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();
};

template <stiffness_solver Solver = multifrontal>
class basic_tetrahedral_fem {
 public:
  /// Factorises the stiffness of `mesh` [m] with `fixed_nodes` held. Throws mesh_error,
  /// std::invalid_argument, singular_stiffness, memory_refused or stopped_by_caller, each with the value
  /// and the remedy.
  basic_tetrahedral_fem(const tetrahedral_mesh& mesh, const material& m,
                        std::span<const int> fixed_nodes, const fem_options& options = {}) {
    check(mesh);
    check(m);
    number_ = free_numbers(mesh, fixed_nodes);
    if (const loose_parts loose = find_loose_parts(mesh, fixed_nodes); loose.modes > 0) {
      refuse(singular_stiffness(
          sentence("tetrahedral_fem: singular, ", loose.modes, " rigid modes left by ",
                   fixed_nodes.size(), " fixed nodes in ", loose.parts,
                   " connected part(s), the first in the part of node ", loose.node, ", ",
                   loose.part_nodes,
                   " nodes large; fix at least three nodes, not on one line, of each part, or "
                   "remove the part"),
          loose.modes));
    }
    node_graph graph = graph_of(mesh, number_);
    for (const int node : options.touched) {
      if (node < 0 || slot(node) >= number_.size()) {
        refuse_argument("tetrahedral_fem: touched node ", node,
                        " is refused; the mesh has nodes 0 to ", number_.size() - 1);
      }
      if (number_[slot(node)] >= 0) graph.touched.push_back(number_[slot(node)]);
    }
    if (graph.size() == 0) {
      refuse_argument(
          "tetrahedral_fem: every node is fixed, nothing can move; leave at least one free");
    }
    const double matrix_bytes =  // 9 entries of 8 + 4 bytes for each block of K
        108.0 * static_cast<double>(graph.neighbours.size() + graph.points.size());
    const double bytes = matrix_bytes + static_cast<double>(solver_->analyse(graph));
    check_memory("tetrahedral_fem", bytes, options.memory_limit, graph.points.size());
    factorise(stiffness_matrix(mesh, m, number_, graph), options.tell);
    displacements_.assign(mesh.nodes.size(), Eigen::Vector3d::Zero());
    load_.resize(3 * graph.size());
    std::fill_n(load_.data(), load_.size(), 0.0);
    pressed_.reserve(slot(graph.size()));
    shares_.reserve(slot(graph.size()));
    loaded_.prepare(*solver_, load_.size());
    probed_.prepare(*solver_, load_.size());
  }

  [[nodiscard]] const Solver& solver() const noexcept { return *solver_; }
  /// The number of each node in the reduced system, −1 if it is fixed.
  [[nodiscard]] const std::vector<int>& numbers() const noexcept { return number_; }
  [[nodiscard]] std::size_t mesh_nodes() const noexcept { return number_.size(); }

  /// u [m] of every node under nodal forces [N]; fixed nodes stay. It does not allocate, and the result
  /// lives until the next call. Throws std::invalid_argument unless there is one force per node.
  const std::vector<Eigen::Vector3d>& displacements(std::span<const Eigen::Vector3d> forces) {
    if (forces.size() != number_.size()) {
      refuse_argument("displacements: ", forces.size(), " forces for ", number_.size(),
                      " nodes; give one per node");
    }
    for (std::size_t node = 0; node < number_.size(); ++node) {
      if (number_[node] >= 0) load_.template segment<3>(3 * number_[node]) = forces[node];
    }
    solver_->solve(load_);
    for (std::size_t node = 0; node < number_.size(); ++node) {
      if (number_[node] >= 0) displacements_[node] = load_.template segment<3>(3 * number_[node]);
    }
    return displacements_;
  }

  /// C [m/N]: the displacement of the point with these barycentric weights for a force on it that is shared out
  /// by the same weights. It is zero if all three nodes are fixed.
  [[nodiscard]] Eigen::Matrix3d compliance(const std::array<int, 3>& nodes,
                                           const Eigen::Vector3d& weights) {
    return press(probed_, nodes, weights);
  }
  /// nᵀCn [m/N], along the unit vector n.
  [[nodiscard]] double compliance(const std::array<int, 3>& nodes, const Eigen::Vector3d& weights,
                                  const Eigen::Vector3d& n) {
    return across(compliance(nodes, weights), n, n);
  }
  /// K = 1/(nᵀCn) [N/m]; infinite where all three nodes are fixed.
  [[nodiscard]] double stiffness(const std::array<int, 3>& nodes, const Eigen::Vector3d& weights,
                                 const Eigen::Vector3d& n) {
    const double c = compliance(nodes, weights, n);
    return c > 0.0 ? 1.0 / c : std::numeric_limits<double>::infinity();
  }

  // The functions of elastic_solid: a point or area of the surface is pressed once and then loaded with one force
  // after the other. By multifrontal the cost is that of the fronts above the point and above the nodes asked for.

  [[nodiscard]] bool moves(int node) const { return number_[slot(node)] >= 0; }

  /// Chooses the point whose force is shared out to these nodes by these shares; returns its C [m/N].
  const Eigen::Matrix3d& press(const std::array<int, 3>& nodes, const Eigen::Vector3d& shares) {
    return press(loaded_, nodes, shares);
  }
  /// The same for an area of any number of nodes, with a share for each; C is the mean by these shares.
  const Eigen::Matrix3d& press(std::span<const int> nodes, std::span<const double> shares) {
    return press(loaded_, nodes, shares);
  }
  /// Sets the force [N] on the point that was pressed last.
  void load(const Eigen::Vector3d& force) { loaded_.load(*solver_, force); }
  /// u [m] of a node under that force; zero for a fixed node.
  [[nodiscard]] Eigen::Vector3d displacement(int node) {
    const int number = number_[slot(node)];
    if (number < 0) return Eigen::Vector3d::Zero();
    return loaded_.displacement(*solver_, number);
  }

 private:
  const Eigen::Matrix3d& press(point_load<Solver>& point, std::span<const int> nodes,
                               std::span<const double> shares) {
    pressed_.clear();
    shares_.clear();
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const int number = number_.at(slot(nodes[k]));
      if (number < 0) continue;
      pressed_.push_back(number);
      shares_.push_back(shares[k]);
    }
    return point.press(*solver_, pressed_, shares_);
  }
  const Eigen::Matrix3d& press(point_load<Solver>& point, const std::array<int, 3>& nodes,
                               const Eigen::Vector3d& shares) {
    return press(point, std::span<const int>(nodes), std::span(shares.data(), 3));
  }

  void factorise(const Eigen::SparseMatrix<double>& stiffness, const on_progress& tell) {
    const factor_result result = solver_->factorise(stiffness, tell);
    if (result.stopped) {
      refuse(stopped_by_caller("tetrahedral_fem: stopped while it factorised; nothing is kept"));
    }
    // A pivot of the size of its rounding error means that the body is a mechanism.
    if (result.smallest_pivot > 1e-12) return;
    refuse(singular_stiffness(
        sentence("tetrahedral_fem: singular, 0 rigid modes left but the smallest pivot is ",
                 result.smallest_pivot,
                 " of its diagonal; parts that share only a node or an edge turn about it: fix "
                 "three nodes of each, or mesh the volume again"),
        0));
  }

  std::vector<int> number_;
  std::unique_ptr<Solver> solver_ = std::make_unique<Solver>();  // so that any solver can be moved
  Eigen::VectorXd load_;
  point_load<Solver> loaded_;
  point_load<Solver> probed_;
  std::vector<int> pressed_;  ///< pressed nodes that are free, by their numbers
  std::vector<double> shares_;
  std::vector<Eigen::Vector3d> displacements_;
};

/// The finite elements with the library's own solver.
using tetrahedral_fem = basic_tetrahedral_fem<>;

/// rest + u, node by node [m]. (A13) Throws std::invalid_argument unless there is one u per node.
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
