// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// SuiteSparse's CHOLMOD as a stiffness_solver, as a user may write it.

#include <passive_haptics/environment/stiffness_solver.hpp>

#include <cholmod.h>
#include <cstddef>

namespace organ {

namespace env = passive_haptics::environment;

class by_cholmod {
 public:
  by_cholmod() {
    cholmod_start(&common_);
    common_.supernodal = CHOLMOD_SUPERNODAL;
  }
  by_cholmod(const by_cholmod&) = delete;
  by_cholmod& operator=(const by_cholmod&) = delete;
  ~by_cholmod() {
    for (cholmod_dense** d : {&x_, &y_, &e_}) cholmod_free_dense(d, &common_);
    cholmod_free_factor(&factor_, &common_);
    cholmod_finish(&common_);
  }

  static std::size_t analyse(const env::node_graph& /*graph*/) { return 0; }

  env::factor_result factorise(const Eigen::SparseMatrix<double>& stiffness,
                               const env::on_progress& tell) {
    if (tell && !tell(0.0)) return {.stopped = true};
    Eigen::SparseMatrix<double> lower = stiffness.triangularView<Eigen::Lower>();
    cholmod_sparse a{};
    a.nrow = a.ncol = static_cast<std::size_t>(lower.rows());
    a.nzmax = static_cast<std::size_t>(lower.nonZeros());
    a.p = lower.outerIndexPtr();
    a.i = lower.innerIndexPtr();
    a.x = lower.valuePtr();
    a.stype = -1;
    a.itype = CHOLMOD_INT;
    a.xtype = CHOLMOD_REAL;
    a.dtype = CHOLMOD_DOUBLE;
    a.sorted = a.packed = 1;
    factor_ = cholmod_analyze(&a, &common_);
    cholmod_factorize(&a, factor_, &common_);
    return {.smallest_pivot =
                common_.status == CHOLMOD_OK ? cholmod_rcond(factor_, &common_) : 0.0};
  }

  void solve(Eigen::VectorXd& b) {
    cholmod_dense right{};
    right.nrow = right.d = right.nzmax = static_cast<std::size_t>(b.size());
    right.ncol = 1;
    right.x = b.data();
    right.xtype = CHOLMOD_REAL;
    right.dtype = CHOLMOD_DOUBLE;
    cholmod_solve2(CHOLMOD_A, factor_, &right, nullptr, &x_, nullptr, &y_, &e_, &common_);
    b = Eigen::Map<const Eigen::VectorXd>(static_cast<const double*>(x_->x), b.size());
  }

  [[nodiscard]] double bytes() const noexcept { return 8.0 * static_cast<double>(factor_->xsize); }

 private:
  cholmod_common common_{};
  cholmod_factor* factor_ = nullptr;
  cholmod_dense *x_ = nullptr, *y_ = nullptr, *e_ = nullptr;
};

}  // namespace organ
