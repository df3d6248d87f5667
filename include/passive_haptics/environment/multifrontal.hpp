// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Cholesky's K = L Lᵀ [N/m] by dense fronts along a nested dissection, and the parts of K⁻¹ [m/N] that a contact needs.
//
//   solve          b ← K⁻¹b, over every front twice
//   press          Y = L⁻¹B of unit forces B at a point, over the fronts from there to the root: BᵀK⁻¹B = YᵀY
//   displacement   u of a node under a force at that point, over the fronts above THAT node
//
// J. W. H. Liu, "The multifrontal method for sparse matrix solution", SIAM Review 34(1), 1992. One thread factorises.
// All products but those of columns() are subtract_tile()'s: with Eigen's a program with finite elements takes a third
// longer to compile.

#include <passive_haptics/environment/marks.hpp>
#include <passive_haptics/environment/nested_dissection.hpp>
#include <passive_haptics/environment/stiffness_solver.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
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
    if (!factorised_) return factor_.clear(), result;
    work_.assign(static_cast<std::size_t>(stiffness.rows()), 0.0);
    clear(below_, largest_front(), 3);
    return result;
  }
  [[nodiscard]] bool factorised() const noexcept { return factorised_; }
  [[nodiscard]] const elimination_tree& tree() const noexcept { return tree_; }

  /// b ← K⁻¹b for one column, without allocating. Without a factor b does not change.
  void solve(Eigen::VectorXd& b) {
    if (!factorised_) return;
    for (std::size_t k = 0; k < node_at_.size(); ++k) {
      std::copy_n(b.data() + row(node_at_[k]), 3, work_.data() + row(k));
    }
    for (std::size_t t = 0; t < factor_.size(); ++t) forward(t, work_.data(), b.size(), 1);
    for (std::size_t t = factor_.size(); t-- > 0;) backward(t, work_.data());
    for (std::size_t k = 0; k < node_at_.size(); ++k) {
      std::copy_n(work_.data() + row(k), 3, b.data() + row(node_at_[k]));
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
    std::vector<int> path;  ///< fronts from the point to the root
    Eigen::MatrixXd half;   ///< Y, 3N rows in the order of elimination, and 3 columns
    Eigen::Matrix3d compliance = Eigen::Matrix3d::Zero();  ///< YᵀY of the point [m/N]
  };
  /// The displacements under one force, of the fronts that were solved so far.
  struct answer {
    std::vector<double> u;     ///< 3N, in the order of elimination [m]
    marks solved;              ///< fronts whose u is known
    std::vector<int> waiting;  ///< fronts to solve, on the way from a node to a solved front
  };
  /// Allocates their memory, so that press() and displacement() do not allocate.
  void prepare(pressed& at) const {
    at.path.reserve(tree_.fronts.size());
    clear(at.half, row(node_at_.size()), 3);
  }
  void prepare(answer& to) const {
    to.u.assign(3 * node_at_.size(), 0.0);
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
      for (Eigen::Index c = 0; c < 3; ++c) {
        std::fill_n(&at.half(row(front.first), c), 3 * front.pivots, 0.0);
      }
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Eigen::Index first = row(tree_.position[slot(nodes[i])]);
      for (Eigen::Index c = 0; c < 3; ++c) at.half(first + c, c) += weights[i];
    }
    for (const int t : at.path) {
      const elimination_front& front = tree_.fronts[slot(t)];
      forward(slot(t), at.half.data(), at.half.rows(), 3);
      for (Eigen::Index k = row(front.first); k < row(front.first + front.pivots); ++k) {
        for (Eigen::Index i = 0; i < 3; ++i) {
          for (Eigen::Index j = 0; j < 3; ++j) at.compliance(i, j) += at.half(k, i) * at.half(k, j);
        }
      }
    }
  }

  /// Forgets the displacements. Call it whenever the force changes.
  static void forget(answer& of) { of.solved.clear(); }
  /// u [m] of a node under `force` [N] at the pressed point. A second call before forget() costs nothing.
  [[nodiscard]] Eigen::Vector3d displacement(answer& of, const pressed& at,
                                             const Eigen::Vector3d& force, int node) {
    if (!factorised_ || of.u.empty()) return Eigen::Vector3d::Zero();
    const int position = tree_.position[slot(node)];
    of.waiting.clear();
    for (int t = tree_.front_of[slot(position)]; t >= 0 && !of.solved.has(t);
         t = tree_.fronts[slot(t)].parent) {
      of.waiting.push_back(t);
    }
    for (auto it = of.waiting.rbegin(); it != of.waiting.rend(); ++it) {
      const elimination_front& front = tree_.fronts[slot(*it)];
      const bool on_path = std::binary_search(at.path.begin(), at.path.end(), *it);
      for (Eigen::Index k = row(front.first); k < row(front.first + front.pivots); ++k) {
        of.u[static_cast<std::size_t>(k)] =
            !on_path
                ? 0.0
                : at.half(k, 0) * force[0] + at.half(k, 1) * force[1] + at.half(k, 2) * force[2];
      }
      backward(slot(*it), of.u.data());
      of.solved.add(*it);
    }
    const double* const u = of.u.data() + row(position);
    return {u[0], u[1], u[2]};
  }

 private:
  /// Columns that are eliminated at once, and rows that subtract() packs: 295 kB, which a second cache holds.
  static constexpr Eigen::Index panel = 192;

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
    factor_ = std::vector<Eigen::MatrixXd>(count);
    std::vector<Eigen::MatrixXd> left(count);  // the update matrix of each front for its parent
    std::vector<int> local(node_at_.size());   // place of a position in the present front
    std::vector<double> diagonal(3 * node_at_.size());  // of K, in the order of elimination
    std::vector<double> packed;
    factor_result result{.smallest_pivot = std::numeric_limits<double>::infinity()};
    course way{tell, tree_.operations};
    for (std::size_t t = 0; t < count; ++t) {
      const elimination_front& front = tree_.fronts[t];
      for (int k = 0; k < front.pivots; ++k) local[slot(front.first + k)] = k;
      int next = front.pivots;
      for (const int position : front.bound) local[slot(position)] = next++;
      const Eigen::Index p = row(front.pivots), u = row(front.bound.size());
      clear(factor_[t], p + u, p);
      clear(left[t], u, u);
      fill(t, stiffness, local, diagonal);
      for (const int child : front.children) {
        extend(t, child, left[slot(child)], left[t], local);
        left[slot(child)].resize(0, 0);
      }
      if (!factorise_front(factor_[t], left[t], packed, way, result)) return result;
      for (Eigen::Index k = 0; k < p; ++k) {
        const auto at = static_cast<std::size_t>(row(front.first) + k);
        const double pivot = factor_[t](k, k) * factor_[t](k, k) / diagonal[at];
        if (!(pivot >= result.smallest_pivot)) result.smallest_pivot = pivot;
      }
    }
    return result;
  }

  static void clear(Eigen::MatrixXd& m, Eigen::Index rows, Eigen::Index columns) {
    m.resize(rows, columns);
    std::fill_n(m.data(), rows * columns, 0.0);
  }

  /// Copies the columns of K that are eliminated in front t, from their diagonals down, and the diagonals.
  void fill(std::size_t t, const Eigen::SparseMatrix<double>& stiffness,
            const std::vector<int>& local, std::vector<double>& diagonal) {
    const elimination_front& front = tree_.fronts[t];
    for (int k = 0; k < front.pivots; ++k) {
      for (Eigen::Index c = 0; c < 3; ++c) {
        const Eigen::Index column = row(node_at_[slot(front.first + k)]) + c;
        for (Eigen::SparseMatrix<double>::InnerIterator it(stiffness, column); it; ++it) {
          const int position = tree_.position[slot(static_cast<int>(it.row() / 3))];
          if (position < front.first + k) continue;
          factor_[t](row(local[slot(position)]) + it.row() % 3, row(k) + c) = it.value();
        }
        diagonal[static_cast<std::size_t>(row(front.first + k) + c)] =
            factor_[t](row(k) + c, row(k) + c);
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
        for (Eigen::Index c = 0; c < 3; ++c) {
          const double* const part = &from(row(i), row(j) + c);
          double* const sum = &target(row(local[slot(bound[i])] - above), row(to - above) + c);
          for (int k = 0; k < 3; ++k) sum[k] += part[k];
        }
      }
    }
  }

  /// Rows of two packets of the processor, or of one of AVX-512: the sums of subtract_tile() stay in registers.
  static constexpr int tile = EIGEN_MAX_STATIC_ALIGN_BYTES >= 32 ? 8 : 4;
  using rows_of_tile = Eigen::Array<double, tile, 1>;

  /// a ← a − b cᵀ of up to `tile` rows and 4 columns. Column k of b and row k of c begin at b + k `stride` and c + 4 k;
  /// b has `tile` rows and, unless a has one column, c has 4 columns, however few of them a has.
  static void subtract_tile(double* a, Eigen::Index a_stride, Eigen::Index rows,
                            Eigen::Index columns, const double* b, Eigen::Index stride,
                            const double* c, Eigen::Index depth) {
    rows_of_tile s0 = rows_of_tile::Zero(), s1 = s0, s2 = s0, s3 = s0;
    if (columns == 1) {
      for (Eigen::Index k = 0; k < depth; ++k) {
        s0 += Eigen::Map<const rows_of_tile>(b + k * stride) * c[4 * k];
      }
    } else {
      for (Eigen::Index k = 0; k < depth; ++k, b += stride, c += 4) {
        const rows_of_tile x = Eigen::Map<const rows_of_tile>(b);
        s0 += x * c[0];
        s1 += x * c[1];
        s2 += x * c[2];
        s3 += x * c[3];
      }
    }
    const auto take = [&](const rows_of_tile& sum) {
      if (rows == tile) {
        Eigen::Map<rows_of_tile> to(a);
        to -= sum;
      } else {
        for (Eigen::Index i = 0; i < rows; ++i) a[i] -= sum[i];
      }
      a += a_stride;
    };
    take(s0);
    if (columns > 1) take(s1);
    if (columns > 2) take(s2);
    if (columns > 3) take(s3);
  }

  /// The same for any number of rows, of which b has no more than a.
  static void subtract_rows(double* a, Eigen::Index a_stride, Eigen::Index rows,
                            Eigen::Index columns, const double* b, Eigen::Index stride,
                            const double* c, Eigen::Index depth) {
    for (; rows >= tile; rows -= tile, a += tile, b += tile) {
      subtract_tile(a, a_stride, tile, columns, b, stride, c, depth);
    }
    for (Eigen::Index j = 0; j < columns; ++j) {
      for (Eigen::Index k = 0; k < depth; ++k) {
        for (Eigen::Index i = 0; i < rows; ++i) {
          a[j * a_stride + i] -= b[k * stride + i] * c[4 * k + j];
        }
      }
    }
  }

  /// a ← a − b cᵀ on and below the diagonal of the `columns` first columns, where a begins in row and column j of the
  /// front, and b and c are the rows of a and its columns in columns k to k + count of L. Above the diagonal a is left
  /// undefined.
  static void subtract(double* a, Eigen::Index a_stride, Eigen::Index columns,
                       const Eigen::MatrixXd& l, Eigen::Index j, Eigen::Index k, Eigen::Index count,
                       std::vector<double>& packed) {
    packed.resize(static_cast<std::size_t>((panel + 4) * panel));
    double *const b = packed.data(), *const c = b + panel * panel;
    const Eigen::Index rows = l.rows() - j;
    const auto pack = [&](double* to, Eigen::Index first, Eigen::Index wide) {
      const Eigen::Index some = (std::min)(wide, rows - first);
      for (Eigen::Index i = 0; i < count; ++i, to += wide) {
        std::fill(std::copy_n(&l(j + first, k + i), some, to), to + wide, 0.0);
      }
    };
    for (Eigen::Index top = 0; top < rows; top += panel) {
      const Eigen::Index end = (std::min)(top + panel, rows);
      for (Eigen::Index i = top; i < end; i += tile) pack(b + (i - top) * count, i, tile);
      for (Eigen::Index column = 0; column < (std::min)(end, columns); column += 4) {
        pack(c, column, 4);
        for (Eigen::Index i = (std::max)(top, column / tile * tile); i < end; i += tile) {
          subtract_tile(
              a + column * a_stride + i, a_stride, (std::min<Eigen::Index>)(tile, end - i),
              (std::min<Eigen::Index>)(4, columns - column), b + (i - top) * count, tile, c, count);
        }
      }
    }
  }

  /// Columns k to k + count of K, with all rows below, become those of L: the left half, then the right one. Returns
  /// false if the matrix is not positive definite. Above the diagonal they are left undefined.
  static bool factorise_columns(Eigen::MatrixXd& l, Eigen::Index k, Eigen::Index count,
                                std::vector<double>& packed) {
    const Eigen::Index half = (count + 7) / 8 * 4, next = k + half, rows = l.rows();
    if (count > 4) {
      if (!factorise_columns(l, k, half, packed)) return false;
      subtract(&l(next, next), rows, count - half, l, next, k, half, packed);
      return factorise_columns(l, next, count - half, packed);
    }
    std::array<double, 12> across{};
    for (Eigen::Index j = k; j < k + count; ++j) {
      for (Eigen::Index i = k; i < j; ++i) across[static_cast<std::size_t>(4 * (i - k))] = l(j, i);
      subtract_rows(&l(j, j), 0, rows - j, 1, &l(j, k), rows, across.data(), j - k);
      if (!(l(j, j) > 0.0)) return false;
      const double scale = 1.0 / std::sqrt(l(j, j));
      for (Eigen::Index r = j; r < rows; ++r) l(r, j) *= scale;
    }
    return true;
  }

  /// Factorises the pivots and the bound below them, panel by panel, and subtracts their part from `left`. Returns
  /// false if it was stopped or the matrix is not positive definite.
  static bool factorise_front(Eigen::MatrixXd& l, Eigen::MatrixXd& left,
                              std::vector<double>& packed, course& way, factor_result& result) {
    const Eigen::Index rows = l.rows(), pivots = l.cols();
    for (Eigen::Index k = 0; k < pivots; k += panel) {
      const Eigen::Index width = (std::min)(panel, pivots - k);
      if (!factorise_columns(l, k, width, packed)) {
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
        subtract(&l(j, j), rows, columns, l, j, k, width, packed);
        if (!done(j)) return false;
      }
      for (Eigen::Index j = pivots; j < rows; j += panel) {
        const Eigen::Index columns = (std::min)(panel, rows - j);
        subtract(&left(j - pivots, j - pivots), left.rows(), columns, l, j, k, width, packed);
        if (!done(j)) return false;
      }
    }
    return true;
  }

  // ----------------------------------------------------------------------------------- solving
  /// x of the pivots of front t ← L⁻¹x; its part is subtracted from the later nodes. x has one column or three, of
  /// `size` rows. It reads L once and does not allocate.
  void forward(std::size_t t, double* x, Eigen::Index size, Eigen::Index columns) {
    constexpr Eigen::Index step = 16;
    const elimination_front& front = tree_.fronts[t];
    const Eigen::MatrixXd& l = factor_[t];
    const Eigen::Index rows = l.rows(), pivots = l.cols();
    for (Eigen::Index c = 0; c < columns; ++c) {
      std::copy_n(x + c * size + row(front.first), pivots, &below_(0, c));
      std::fill_n(&below_(0, c) + pivots, rows - pivots, 0.0);
    }
    std::array<double, 4 * step> solved{};  // row by row, as subtract_tile() wants it
    for (Eigen::Index k = 0; k < pivots; k += step) {
      const Eigen::Index end = (std::min)(k + step, pivots);
      for (Eigen::Index c = 0; c < columns; ++c) {
        for (Eigen::Index j = k; j < end; ++j) {
          double sum = below_(j, c);
          for (Eigen::Index i = k; i < j; ++i) sum -= l(j, i) * below_(i, c);
          below_(j, c) = solved[static_cast<std::size_t>(4 * (j - k) + c)] = sum / l(j, j);
        }
      }
      subtract_rows(below_.data() + end, below_.rows(), rows - end, columns,
                    l.data() + k * rows + end, rows, solved.data(), end - k);
    }
    for (Eigen::Index c = 0; c < columns; ++c, x += size) {
      std::copy_n(&below_(0, c), pivots, x + row(front.first));
      for (std::size_t i = 0; i < front.bound.size(); ++i) {
        const double* const part = &below_(pivots + row(i), c);
        for (int q = 0; q < 3; ++q) x[row(front.bound[i]) + q] += part[q];
      }
    }
  }
  /// x of the pivots of front t ← L⁻ᵀ(x − the part of the later nodes), which are solved already.
  void backward(std::size_t t, double* x) {
    const elimination_front& front = tree_.fronts[t];
    const Eigen::MatrixXd& l = factor_[t];
    const Eigen::Index rows = l.rows(), pivots = l.cols();
    double* const y = below_.data();
    std::copy_n(x + row(front.first), pivots, y);
    for (std::size_t i = 0; i < front.bound.size(); ++i) {
      std::copy_n(x + row(front.bound[i]), 3, y + pivots + row(i));
    }
    for (Eigen::Index end = pivots; end > 0;) {  // up to eight columns at once
      const Eigen::Index begin = (std::max<Eigen::Index>)(0, end - 8);
      std::array<double, 8> sums{};
      subtract_dots(sums, l.data() + begin * rows + end, rows, y + end, rows - end, end - begin);
      for (Eigen::Index k = end; k-- > begin;) {
        double sum = y[k] + sums[static_cast<std::size_t>(k - begin)];
        for (Eigen::Index r = end; --r > k;) sum -= l(r, k) * y[r];  // the newest one last
        y[k] = sum / l(k, k);
      }
      end = begin;
    }
    std::copy_n(y, pivots, x + row(front.first));
  }
  /// Subtracts the products of up to eight columns a, of `rows` rows, with x: eight streams from memory are faster than
  /// four.
  static void subtract_dots(std::array<double, 8>& from, const double* a, Eigen::Index stride,
                            const double* x, Eigen::Index rows, Eigen::Index columns) {
    using packet = Eigen::Array<double, tile / 2, 1>;
    using some = Eigen::Map<const packet>;
    Eigen::Index r = 0;
    if (columns == 8) {
      packet s0 = packet::Zero(), s1 = s0, s2 = s0, s3 = s0, s4 = s0, s5 = s0, s6 = s0, s7 = s0;
      const double* const b = a + 4 * stride;
      for (; r + tile / 2 <= rows; r += tile / 2) {
        const packet y = some(x + r);
        s0 += y * some(a + r);
        s1 += y * some(a + stride + r);
        s2 += y * some(a + 2 * stride + r);
        s3 += y * some(a + 3 * stride + r);
        s4 += y * some(b + r);
        s5 += y * some(b + stride + r);
        s6 += y * some(b + 2 * stride + r);
        s7 += y * some(b + 3 * stride + r);
      }
      const std::array<packet, 8> sums{s0, s1, s2, s3, s4, s5, s6, s7};
      for (std::size_t c = 0; c < 8; ++c) {
        for (Eigen::Index i = 0; i < tile / 2; ++i) from[c] -= sums[c][i];
      }
    }
    for (; r < rows; ++r) {
      for (Eigen::Index c = 0; c < columns; ++c) {
        from[static_cast<std::size_t>(c)] -= a[c * stride + r] * x[r];
      }
    }
  }

  elimination_tree tree_;
  std::vector<int> node_at_;             ///< the node at each position in the order of elimination
  std::vector<Eigen::MatrixXd> factor_;  ///< L of each front, the bound below the pivots
  bool factorised_ = false;
  std::vector<double> work_;
  Eigen::MatrixXd below_;  ///< scratch, rows of the largest front and 3 columns
};

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
