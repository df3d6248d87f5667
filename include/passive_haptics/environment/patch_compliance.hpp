// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The compliance of the nodes of a patch as an elastic_solid (deformable_body.hpp): u_a = Σ_b K⁻¹_ab f_b [m].
// compliance_table.hpp keeps the columns of K⁻¹ [m/N] in a file.
//
// D. L. James, D. K. Pai, "ArtDefo: accurate real time deformable objects", SIGGRAPH 1999. The displacements of
// the nodes of the patch are exact. Nodes outside of it do not move, like fixed ones, so make the patch larger
// than the part that is touched.

#include <passive_haptics/environment/surface.hpp>
#include <passive_haptics/environment/tetrahedral_fem.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

/// A solver that gives the wanted rows of columns of K⁻¹, as multifrontal does.
template <class S>
concept column_solver = stiffness_solver<S> &&
    requires(const S solver, std::span<const int> nodes) {
  { solver.columns(nodes, nodes) } -> std::convertible_to<Eigen::MatrixXd>;
};

/// The columns of K⁻¹ [m/N] for `nodes` of a patch of M nodes, one after the other: three columns for each node,
/// of 3M scalars, x y z of node after node of the patch. Rows and columns of fixed nodes are zero.
template <std::floating_point Scalar, column_solver Solver>
[[nodiscard]] std::vector<Scalar> patch_columns(const basic_tetrahedral_fem<Solver>& solid,
                                                std::span<const int> patch,
                                                std::span<const int> nodes) {
  // Fixed nodes have no unknowns; the rows of the others go to their places in the patch.
  const auto free = [&](std::span<const int> among) {
    std::pair<std::vector<int>, std::vector<std::size_t>> found;  // number, place
    for (std::size_t i = 0; i < among.size(); ++i) {
      const int number = solid.numbers()[slot(among[i])];
      if (number < 0) continue;
      found.first.push_back(number);
      found.second.push_back(i);
    }
    return found;
  };
  const auto [wanted, wanted_at] = free(patch);
  const auto [loaded, loaded_at] = free(nodes);
  const std::size_t rows = 3 * patch.size();
  std::vector<Scalar> scalars(rows * 3 * nodes.size(), Scalar{0});
  if (loaded.empty() || wanted.empty()) return scalars;
  const Eigen::MatrixXd found = solid.solver().columns(loaded, wanted);
  for (std::size_t j = 0; j < 3 * loaded.size(); ++j) {
    Scalar* const column = scalars.data() + rows * (3 * loaded_at[j / 3] + j % 3);
    for (std::size_t i = 0; i < 3 * wanted.size(); ++i) {
      column[3 * wanted_at[i / 3] + i % 3] =
          static_cast<Scalar>(found(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
    }
  }
  return scalars;
}

/// Throws std::invalid_argument for a patch without nodes, or with a node that the mesh does not have.
inline void check_patch(std::string_view who, std::span<const int> patch, std::size_t mesh_nodes) {
  for (const int node : patch) {
    if (node >= 0 && slot(node) < mesh_nodes) continue;
    refuse_argument(who, ": node ", node, " is refused; the mesh has nodes 0 to ", mesh_nodes - 1);
  }
  if (patch.empty()) refuse_argument(who, ": the patch has no nodes; give some");
}

/// The `count` nodes of a surface that are closest to a point [m], or all if there are fewer, in ascending order.
[[nodiscard]] inline std::vector<int> patch_around(surface_view surface, nodes_view nodes,
                                                   const Eigen::Vector3d& where,
                                                   std::size_t count) {
  std::vector<int> all;
  for (const auto& t : surface) all.insert(all.end(), t.nodes.begin(), t.nodes.end());
  const auto ascending = [&] {
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
  };
  ascending();
  const auto distance = [&](int node) { return (nodes[slot(node)] - where).squaredNorm(); };
  std::stable_sort(all.begin(), all.end(), [&](int a, int b) { return distance(a) < distance(b); });
  all.resize((std::min)(count, all.size()));
  ascending();
  return all;
}

/// `Columns` has column(index), which points to the first of the 9M scalars of a node of the patch.
template <class Columns>
class patch_compliance {
 public:
  /// `nodes` are the nodes of the patch by their numbers in a mesh of `mesh_nodes` nodes.
  patch_compliance(Columns columns, std::vector<int> nodes, std::size_t mesh_nodes)
      : columns_(std::move(columns)), nodes_(std::move(nodes)), index_(mesh_nodes, -1) {
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      index_.at(slot(nodes_[i])) = static_cast<int>(i);
    at_.reserve(nodes_.size());
    shares_.reserve(nodes_.size());
  }

  [[nodiscard]] const std::vector<int>& nodes() const noexcept { return nodes_; }
  [[nodiscard]] const Columns& columns() const noexcept { return columns_; }
  [[nodiscard]] std::size_t mesh_nodes() const noexcept { return index_.size(); }
  [[nodiscard]] bool moves(int node) const { return index_[slot(node)] >= 0; }

  /// K⁻¹_ab [m/N], the displacement of node a for a force on node b; zero if one is outside of the patch.
  [[nodiscard]] Eigen::Matrix3d between(int a, int b) const {
    const int row = index_[slot(a)], column = index_[slot(b)];
    if (row < 0 || column < 0) return Eigen::Matrix3d::Zero();
    return block(row, column);
  }
  /// The displacement of one point, three nodes and their shares, for a force on another point [m/N].
  [[nodiscard]] Eigen::Matrix3d between(const std::array<int, 3>& at,
                                        const Eigen::Vector3d& at_shares,
                                        const std::array<int, 3>& by,
                                        const Eigen::Vector3d& by_shares) const {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (Eigen::Index i = 0; i < 3; ++i) {
      for (Eigen::Index j = 0; j < 3; ++j) {
        sum += at_shares[i] * by_shares[j] *
               between(at[static_cast<std::size_t>(i)], by[static_cast<std::size_t>(j)]);
      }
    }
    return sum;
  }

  // The functions of elastic_solid, for basic_deformable_body.
  [[nodiscard]] Eigen::Matrix3d compliance(const std::array<int, 3>& nodes,
                                           const Eigen::Vector3d& shares) const {
    return between(nodes, shares, nodes, shares);
  }
  Eigen::Matrix3d press(const std::array<int, 3>& nodes, const Eigen::Vector3d& shares) {
    return press(std::span<const int>(nodes), std::span(shares.data(), 3));
  }
  /// Nodes outside of the patch do not move, so their shares are lost.
  Eigen::Matrix3d press(std::span<const int> nodes, std::span<const double> shares) {
    at_.clear();
    shares_.clear();
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      if (!moves(nodes[k])) continue;
      at_.push_back(index_[slot(nodes[k])]);
      shares_.push_back(shares[k]);
    }
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (std::size_t j = 0; j < at_.size(); ++j) {
      for (std::size_t i = 0; i < at_.size(); ++i) {
        sum += shares_[i] * shares_[j] * block(at_[i], at_[j]);
      }
    }
    return sum;
  }
  void load(const Eigen::Vector3d& force) { force_ = force; }
  [[nodiscard]] Eigen::Vector3d displacement(int node) const {
    Eigen::Vector3d u = Eigen::Vector3d::Zero();
    const int row = index_[slot(node)];
    if (row < 0) return u;
    for (std::size_t k = 0; k < at_.size(); ++k) {
      u += block(row, at_[k]) * (shares_[k] * force_);
    }
    return u;
  }

 private:
  [[nodiscard]] Eigen::Matrix3d block(int row, int column) const {
    const std::size_t rows = 3 * nodes_.size();
    const auto* const first = columns_.column(slot(column)) + 3 * slot(row);
    Eigen::Matrix3d result;
    for (Eigen::Index j = 0; j < 3; ++j) {
      for (Eigen::Index i = 0; i < 3; ++i) {
        result(i, j) = static_cast<double>(
            first[static_cast<std::size_t>(j) * rows + static_cast<std::size_t>(i)]);
      }
    }
    return result;
  }

  Columns columns_;
  std::vector<int> nodes_;  ///< the nodes of the patch by their numbers in the mesh
  std::vector<int> index_;  ///< the place of a node of the mesh in nodes_, or −1
  std::vector<int> at_;     ///< the nodes that are pressed, by their places in nodes_
  std::vector<double> shares_;
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();
};

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
