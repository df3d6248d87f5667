// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Cholesky's K = L Lᵀ [N/m] by dense fronts along a nested dissection, and the parts of K⁻¹ [m/N] that a contact needs.
//
//   solve          b ← K⁻¹b, over every front twice
//   press          Y = L⁻¹B of unit forces B at a point, over the fronts from there to the root: BᵀK⁻¹B = YᵀY
//   displacement   u of a node under a force at that point, over the fronts above THAT node
//
// J. W. H. Liu, "The multifrontal method for sparse matrix solution", SIAM Review 34(1), 1992. The products are
// Eigen's dense ones; one thread factorises.

#include <passive_haptics/environment/marks.hpp>
#include <passive_haptics/environment/nested_dissection.hpp>
#include <passive_haptics/environment/stiffness_solver.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

class multifrontal {
 public:
  /// Orders the nodes; returns the largest number of bytes that factorise() will hold.
  std::size_t analyse(const node_graph& graph) {
    factorised_ = false;
    factor_.clear();
    tree_ = dissect(graph);
    node_at_.resize(tree_.position.size());
    for (std::size_t i = 0; i < node_at_.size(); ++i) {
      node_at_[slot(tree_.position[i])] = static_cast<int>(i);
    }
    return static_cast<std::size_t>(tree_.peak_bytes);
  }

  /// Factorises K [N/m] of the graph that was analysed, three rows per node. It calls `tell` at least after every
  /// 10⁹ operations; if that returns false, no factor is kept.
  [[nodiscard]] factor_result factorise(const Eigen::SparseMatrix<double>& stiffness,
                                        const on_progress& tell = {}) {
    factorised_ = false;
    factor_result result = eliminate(stiffness, tell);
    factorised_ = !result.stopped && result.smallest_pivot > 0.0;
    if (!factorised_) return factor_ = {}, result;
    work_.setZero(stiffness.rows());
    below_.setZero(largest_front());
    three_.setZero(largest_front(), 3);
    return result;
  }
  [[nodiscard]] bool factorised() const noexcept { return factorised_; }
  [[nodiscard]] const elimination_tree& tree() const noexcept { return tree_; }

  /// b ← K⁻¹b for one column, without allocating. Without a factor b does not change.
  void solve(Eigen::VectorXd& b) {
    if (!factorised_) return;
    for (std::size_t k = 0; k < node_at_.size(); ++k) {
      work_.segment<3>(row(k)) = b.segment<3>(row(node_at_[k]));
    }
    for (std::size_t t = 0; t < factor_.size(); ++t) forward(t, work_, below_);
    for (std::size_t t = factor_.size(); t-- > 0;) backward(t, work_, below_);
    for (std::size_t k = 0; k < node_at_.size(); ++k) {
      b.segment<3>(row(node_at_[k])) = work_.segment<3>(row(k));
    }
  }

  /// The fronts from these nodes to the root, in the order of elimination.
  [[nodiscard]] std::vector<int> path_of(std::span<const int> nodes) const {
    std::vector<int> path;
    for (const int node : nodes) climb(node, path);
    tidy(path);
    return path;
  }

  /// Rows 3i..3i+2 of the result are those of node wanted[i] in K⁻¹B [m/N], where column 3j + c of B is a unit
  /// force along axis c at node loaded[j]. Any number of threads may call it at a time. (A template, so that only
  /// programs that ask for columns compile their products.)
  template <class Matrix = Eigen::MatrixXd>
  [[nodiscard]] Matrix columns(std::span<const int> loaded, std::span<const int> wanted) const {
    const auto count = static_cast<Eigen::Index>(3 * loaded.size());
    Matrix result = Matrix::Zero(static_cast<Eigen::Index>(3 * wanted.size()), count);
    if (!factorised_ || result.size() == 0) return result;
    const std::vector<int> down = path_of(loaded);
    std::vector<int> all = path_of(wanted);
    all.insert(all.end(), down.begin(), down.end());
    tidy(all);
    // x has rows for the nodes of these fronts only.
    std::vector<int> at(node_at_.size(), -1);
    int rows = 0;
    for (const int t : all) {
      const elimination_front& front = tree_.fronts[slot(t)];
      for (int k = 0; k < front.pivots; ++k) at[slot(front.first + k)] = rows++;
    }
    Matrix x = Matrix::Zero(3 * rows, count);
    for (std::size_t j = 0; j < loaded.size(); ++j) {
      const int position = tree_.position[slot(loaded[j])];
      x.block(3 * at[slot(position)], row(j), 3, 3).setIdentity();
    }
    Matrix bound;
    for (const int t : down) {
      const elimination_front& front = tree_.fronts[slot(t)];
      const Matrix& l = factor_[slot(t)];
      auto pivots = x.middleRows(3 * at[slot(front.first)], l.cols());
      l.topRows(l.cols()).template triangularView<Eigen::Lower>().solveInPlace(pivots);
      bound.noalias() = l.bottomRows(l.rows() - l.cols()) * pivots;
      for (std::size_t i = 0; i < front.bound.size(); ++i) {
        x.middleRows(3 * at[slot(front.bound[i])], 3) -= bound.middleRows(row(i), 3);
      }
    }
    for (auto it = all.rbegin(); it != all.rend(); ++it) {
      const elimination_front& front = tree_.fronts[slot(*it)];
      const Matrix& l = factor_[slot(*it)];
      auto pivots = x.middleRows(3 * at[slot(front.first)], l.cols());
      bound.resize(l.rows() - l.cols(), count);
      for (std::size_t i = 0; i < front.bound.size(); ++i) {
        bound.middleRows(row(i), 3) = x.middleRows(3 * at[slot(front.bound[i])], 3);
      }
      pivots.noalias() -= l.bottomRows(bound.rows()).transpose() * bound;
      l.topRows(l.cols()).template triangularView<Eigen::Lower>().transpose().solveInPlace(pivots);
    }
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const int position = tree_.position[slot(wanted[i])];
      result.middleRows(row(i), 3) = x.middleRows(3 * at[slot(position)], 3);
    }
    return result;
  }

  /// The point that was pressed last.
  struct pressed {
    std::vector<int> path;                          ///< fronts from the point to the root
    Eigen::Matrix<double, Eigen::Dynamic, 3> half;  ///< Y, 3N rows in the order of elimination
    Eigen::Matrix3d compliance = Eigen::Matrix3d::Zero();  ///< YᵀY of the point [m/N]
  };
  /// The displacements under one force, of the fronts that were solved so far.
  struct answer {
    Eigen::VectorXd u;         ///< 3N, in the order of elimination [m]
    marks solved;              ///< fronts whose u is known
    std::vector<int> waiting;  ///< fronts to solve, on the way from a node to a solved front
  };
  /// Allocates their memory, so that press() and displacement() do not allocate.
  void prepare(pressed& at) const {
    at.path.reserve(tree_.fronts.size());
    at.half.setZero(static_cast<Eigen::Index>(3 * node_at_.size()), 3);
  }
  void prepare(answer& to) const {
    to.u.setZero(static_cast<Eigen::Index>(3 * node_at_.size()));
    to.solved = marks(tree_.fronts.size());
    to.waiting.reserve(tree_.fronts.size());
  }

  /// Presses the point whose force is shared out to these nodes by these weights.
  void press(pressed& at, std::span<const int> nodes, std::span<const double> weights) {
    at.path.clear();
    at.compliance.setZero();
    if (!factorised_) return;
    for (const int node : nodes) climb(node, at.path);
    tidy(at.path);
    for (const int t : at.path) {
      const elimination_front& front = tree_.fronts[slot(t)];
      at.half.middleRows(3 * front.first, 3 * front.pivots).setZero();
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      at.half.middleRows<3>(row(tree_.position[slot(nodes[i])])) +=
          weights[i] * Eigen::Matrix3d::Identity();
    }
    for (const int t : at.path) {
      const elimination_front& front = tree_.fronts[slot(t)];
      forward_three(slot(t), at.half);
      const auto pivots = at.half.middleRows(3 * front.first, 3 * front.pivots);
      for (Eigen::Index i = 0; i < 3; ++i) {
        for (Eigen::Index j = 0; j < 3; ++j)
          at.compliance(i, j) += pivots.col(i).dot(pivots.col(j));
      }
    }
  }

  /// Forgets the displacements. Call it whenever the force changes.
  static void forget(answer& of) { of.solved.clear(); }
  /// u [m] of a node under `force` [N] at the pressed point. A second call before forget() costs nothing.
  [[nodiscard]] Eigen::Vector3d displacement(answer& of, const pressed& at,
                                             const Eigen::Vector3d& force, int node) {
    if (!factorised_ || of.u.size() == 0) return Eigen::Vector3d::Zero();
    const int position = tree_.position[slot(node)];
    of.waiting.clear();
    for (int t = tree_.front_of[slot(position)]; t >= 0 && !of.solved.has(t);
         t = tree_.fronts[slot(t)].parent) {
      of.waiting.push_back(t);
    }
    for (auto it = of.waiting.rbegin(); it != of.waiting.rend(); ++it) {
      const elimination_front& front = tree_.fronts[slot(*it)];
      auto pivots = of.u.segment(3 * front.first, 3 * front.pivots);
      if (std::binary_search(at.path.begin(), at.path.end(), *it)) {
        pivots.noalias() = at.half.middleRows(3 * front.first, 3 * front.pivots).lazyProduct(force);
      } else {
        pivots.setZero();
      }
      backward(slot(*it), of.u, below_);
      of.solved.add(*it);
    }
    return of.u.segment<3>(row(position));
  }

 private:
  static constexpr Eigen::Index panel = 192;  ///< columns that are eliminated at once

  template <class Integer>
  [[nodiscard]] static constexpr Eigen::Index row(Integer position) noexcept {
    return 3 * static_cast<Eigen::Index>(position);
  }
  static void tidy(std::vector<int>& path) {
    std::sort(path.begin(), path.end());
    path.erase(std::unique(path.begin(), path.end()), path.end());
  }
  void climb(int node, std::vector<int>& path) const {
    const auto seen = path.size();  // the paths of two nodes mostly meet in a front or two
    for (int t = tree_.front_of[slot(tree_.position[slot(node)])]; t >= 0;
         t = tree_.fronts[slot(t)].parent) {
      const auto end = path.begin() + static_cast<std::ptrdiff_t>(seen);
      if (std::find(path.begin(), end, t) != end) return;
      path.push_back(t);
    }
  }
  [[nodiscard]] Eigen::Index largest_front() const {
    Eigen::Index largest = 0;
    for (const auto& l : factor_) largest = (std::max)(largest, l.rows());
    return largest;
  }

  // ------------------------------------------------------------------------------- factorising
  /// The progress of the elimination, in operations.
  struct course {
    const on_progress& tell;
    double total;
    double done = 0.0;
    /// Returns false if `tell` stops the elimination.
    [[nodiscard]] bool count(double operations) {
      done += operations;
      return !tell || tell((std::min)(1.0, done / total));
    }
  };

  factor_result eliminate(const Eigen::SparseMatrix<double>& stiffness, const on_progress& tell) {
    const std::size_t count = tree_.fronts.size();
    factor_.assign(count, {});
    std::vector<Eigen::MatrixXd> left(count);  // the update matrix of each front for its parent
    std::vector<int> local(node_at_.size());   // place of a position in the present front
    const Eigen::VectorXd diagonal = stiffness.diagonal();
    factor_result result{.smallest_pivot = std::numeric_limits<double>::infinity()};
    course way{tell, tree_.operations};
    for (std::size_t t = 0; t < count; ++t) {
      const elimination_front& front = tree_.fronts[t];
      for (int k = 0; k < front.pivots; ++k) local[slot(front.first + k)] = k;
      int next = front.pivots;
      for (const int position : front.bound) local[slot(position)] = next++;
      const Eigen::Index p = row(front.pivots), u = row(front.bound.size());
      factor_[t].setZero(p + u, p);
      left[t].setZero(u, u);
      fill(t, stiffness, local);
      for (const int child : front.children) {
        extend(t, child, left[slot(child)], left[t], local);
        left[slot(child)].resize(0, 0);
      }
      if (!factorise_front(factor_[t], left[t], way, result)) return result;
      for (Eigen::Index k = 0; k < p; ++k) {
        const Eigen::Index at = row(node_at_[slot(front.first) + slot(static_cast<int>(k / 3))]);
        const double pivot = factor_[t](k, k) * factor_[t](k, k) / diagonal[at + k % 3];
        if (!(pivot >= result.smallest_pivot)) result.smallest_pivot = pivot;
      }
    }
    return result;
  }

  /// Copies the columns of K that are eliminated in front t, from their diagonals down.
  void fill(std::size_t t, const Eigen::SparseMatrix<double>& stiffness,
            const std::vector<int>& local) {
    const elimination_front& front = tree_.fronts[t];
    for (int k = 0; k < front.pivots; ++k) {
      for (Eigen::Index c = 0; c < 3; ++c) {
        const Eigen::Index column = row(node_at_[slot(front.first + k)]) + c;
        for (Eigen::SparseMatrix<double>::InnerIterator it(stiffness, column); it; ++it) {
          const int position = tree_.position[slot(static_cast<int>(it.row() / 3))];
          if (position < front.first + k) continue;
          factor_[t](row(local[slot(position)]) + it.row() % 3, row(k) + c) = it.value();
        }
      }
    }
  }

  /// Adds the update matrix of a child (extend-add); only lower triangles are used.
  void extend(std::size_t t, int child, const Eigen::MatrixXd& from, Eigen::MatrixXd& left,
              const std::vector<int>& local) {
    const int pivots = tree_.fronts[t].pivots;
    const std::vector<int>& bound = tree_.fronts[slot(child)].bound;
    for (std::size_t j = 0; j < bound.size(); ++j) {
      const int to = local[slot(bound[j])];
      const bool is_pivot = to < pivots;
      Eigen::MatrixXd& target = is_pivot ? factor_[t] : left;
      const int above = is_pivot ? 0 : pivots;
      for (std::size_t i = j; i < bound.size(); ++i) {
        target.block<3, 3>(row(local[slot(bound[i])] - above), row(to - above)) +=
            from.block<3, 3>(row(i), row(j));
      }
    }
  }

  /// a ← a − b cᵀ, where a begins in row and column j of the front, and b and c are the rows of a and its columns in
  /// columns k to k + count of L. (All products of blocks are this one: another kind is half a second of compilation.)
  static void subtract(Eigen::Block<Eigen::MatrixXd> a, Eigen::MatrixXd& l, Eigen::Index j,
                       Eigen::Index k, Eigen::Index count) {
    a.noalias() -= l.block(j, k, a.rows(), count) * l.block(j, k, a.cols(), count).transpose();
  }

  /// Columns k to k + count of K, with all rows below, become those of L: the left half, then the right one. Returns
  /// false if the matrix is not positive definite. Above the diagonal they are left undefined.
  static bool factorise_columns(Eigen::MatrixXd& l, Eigen::Index k, Eigen::Index count) {
    const Eigen::Index half = count / 2, next = k + half, rows = l.rows();
    if (count > 12) {
      if (!factorise_columns(l, k, half)) return false;
      subtract(l.block(next, next, rows - next, count - half), l, next, k, half);
      return factorise_columns(l, next, count - half);
    }
    for (Eigen::Index j = k; j < k + count; ++j) {
      auto column = l.col(j).tail(rows - j);
      for (Eigen::Index i = k; i < j; ++i) column -= l(j, i) * l.col(i).tail(rows - j);
      if (!(column(0) > 0.0)) return false;
      column /= std::sqrt(column(0));
    }
    return true;
  }

  /// Factorises the pivots and the bound below them, panel by panel, and subtracts their part from `left`. Returns
  /// false if it was stopped or the matrix is not positive definite.
  static bool factorise_front(Eigen::MatrixXd& l, Eigen::MatrixXd& left, course& way,
                              factor_result& result) {
    const Eigen::Index rows = l.rows(), pivots = l.cols();
    for (Eigen::Index k = 0; k < pivots; k += panel) {
      const Eigen::Index width = (std::min)(panel, pivots - k);
      if (!factorise_columns(l, k, width)) {
        result.smallest_pivot = 0.0;
        return false;
      }
      const auto done = [&](Eigen::Index from) {
        const auto m = static_cast<double>(rows - from), w = static_cast<double>(width);
        result.stopped = !way.count(m * w * static_cast<double>((std::min)(panel, rows - from)));
        return !result.stopped;
      };
      if (k + width == rows) return done(k);
      for (Eigen::Index j = k + width; j < pivots; j += panel) {
        const Eigen::Index columns = (std::min)(panel, pivots - j);
        subtract(l.block(j, j, rows - j, columns), l, j, k, width);
        if (!done(j)) return false;
      }
      for (Eigen::Index j = pivots; j < rows; j += panel) {
        const Eigen::Index columns = (std::min)(panel, rows - j);
        subtract(left.block(j - pivots, j - pivots, rows - j, columns), l, j, k, width);
        if (!done(j)) return false;
      }
    }
    return true;
  }

  // ----------------------------------------------------------------------------------- solving
  /// x of the pivots of front t ← L⁻¹x; its part is subtracted from the later nodes.
  void forward(std::size_t t, Eigen::VectorXd& x, Eigen::VectorXd& below) const {
    const elimination_front& front = tree_.fronts[t];
    const Eigen::MatrixXd& l = factor_[t];
    auto pivots = x.segment(row(front.first), l.cols());
    l.topRows(l.cols()).triangularView<Eigen::Lower>().solveInPlace(pivots);
    auto taken = below.head(l.rows() - l.cols());
    taken.noalias() = l.bottomRows(taken.size()) * pivots;
    for (std::size_t i = 0; i < front.bound.size(); ++i) {
      x.segment<3>(row(front.bound[i])) -= taken.segment<3>(row(i));
    }
  }
  /// x of the pivots of front t ← L⁻ᵀ(x − the part of the later nodes), which are solved already.
  void backward(std::size_t t, Eigen::VectorXd& x, Eigen::VectorXd& below) const {
    const elimination_front& front = tree_.fronts[t];
    const Eigen::MatrixXd& l = factor_[t];
    auto pivots = x.segment(row(front.first), l.cols());
    auto later = below.head(l.rows() - l.cols());
    for (std::size_t i = 0; i < front.bound.size(); ++i) {
      later.segment<3>(row(i)) = x.segment<3>(row(front.bound[i]));
    }
    pivots.noalias() -= l.bottomRows(later.size()).transpose() * later;
    l.topRows(l.cols()).triangularView<Eigen::Lower>().transpose().solveInPlace(pivots);
  }
  /// forward() of three columns. It reads L once and, unlike Eigen's matrix products, does not allocate.
  void forward_three(std::size_t t, Eigen::Matrix<double, Eigen::Dynamic, 3>& x) {
    constexpr Eigen::Index step = 16, slab = 192;  // a slab of L is 24 kB, in the first cache
    const elimination_front& front = tree_.fronts[t];
    const Eigen::MatrixXd& l = factor_[t];
    const Eigen::Index rows = l.rows(), pivots = l.cols();
    three_.topRows(pivots) = x.middleRows(row(front.first), pivots);
    three_.middleRows(pivots, rows - pivots).setZero();
    for (Eigen::Index k = 0; k < pivots; k += step) {
      const Eigen::Index width = (std::min)(step, pivots - k);
      for (Eigen::Index c = 0; c < 3; ++c) {
        auto some = three_.col(c).segment(k, width);
        l.block(k, k, width, width).triangularView<Eigen::Lower>().solveInPlace(some);
      }
      for (Eigen::Index r = k + width; r < rows; r += slab) {
        const Eigen::Index height = (std::min)(slab, rows - r);
        three_.middleRows(r, height) -=
            l.block(r, k, height, width).lazyProduct(three_.middleRows(k, width));
      }
    }
    x.middleRows(row(front.first), pivots) = three_.topRows(pivots);
    for (std::size_t i = 0; i < front.bound.size(); ++i) {
      x.middleRows<3>(row(front.bound[i])) += three_.middleRows<3>(pivots + row(i));
    }
  }

  elimination_tree tree_;
  std::vector<int> node_at_;             ///< the node at each position in the order of elimination
  std::vector<Eigen::MatrixXd> factor_;  ///< L of each front, the bound below the pivots
  bool factorised_ = false;
  Eigen::VectorXd work_;
  Eigen::VectorXd below_;                           ///< scratch, rows of the largest front
  Eigen::Matrix<double, Eigen::Dynamic, 3> three_;  ///< scratch, rows of the largest front
};

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
