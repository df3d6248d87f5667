// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The 1-DOF environment of the thesis (3.2, appendix A.2): a wall of springs in series.
//
//        force ──▶ 1 ─/\/\/─ 2 ─/\/\/─ 3 ▐ fixed
//
//   (A.1) element  [k −k; −k k]     (A.2) assembled     (A.3)-(A.5) last node struck out, solved
//
// Only node 1 is loaded, so all displacements are proportional to its force, and the system is solved once.

#include <passive_haptics/environment/refuse.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <cmath>
#include <initializer_list>
#include <span>

namespace experiments {

class spring_wall {
 public:
  /// Two springs of 20 kN/m: 10 kN/m together.
  spring_wall() : spring_wall({20e3, 20e3}) {}

  /// Springs from the surface inwards [N/m]. Throws std::invalid_argument for none, or for one that is not
  /// finite and > 0.
  spring_wall(std::initializer_list<double> springs)
      : spring_wall(std::span<const double>(springs.begin(), springs.size())) {}

  explicit spring_wall(std::span<const double> springs) {
    if (springs.empty()) {
      passive_haptics::environment::refuse_argument(
          "spring_wall: there is no spring; give at least one [N/m]");
    }
    for (const double k : springs) {
      if (!(k > 0.0) || !std::isfinite(k)) {
        passive_haptics::environment::refuse_argument(
            "spring_wall: spring ", k, " N/m is refused; give a finite one above zero");
      }
    }
    const auto count = static_cast<Eigen::Index>(springs.size());
    Eigen::MatrixXd assembled = Eigen::MatrixXd::Zero(count + 1, count + 1);
    for (Eigen::Index i = 0; i < count; ++i) {
      const double k = springs[static_cast<std::size_t>(i)];
      assembled.block<2, 2>(i, i) += (Eigen::Matrix2d() << k, -k, -k, k).finished();
    }
    const Eigen::LDLT<Eigen::MatrixXd> reduced(assembled.topLeftCorner(count, count));
    compliance_ = reduced.solve(Eigen::VectorXd::Unit(count, 0));
    if (!compliance_.allFinite() || !(compliance_[0] > 0.0)) {
      passive_haptics::environment::refuse_argument(
          "spring_wall: the stiffest spring is too far from the softest to be solved (",
          compliance_[0], " m/N); bring them within 1e12 of each other");
    }
  }

  /// Displacement of the surface (node 1) [m] under `force` [N], both positive into the wall.
  [[nodiscard]] double surface(double force) const { return compliance_[0] * force; }

  /// Displacements of nodes 1 to N [m]; node N + 1 is the fixed one.
  [[nodiscard]] Eigen::VectorXd displacements(double force) const { return compliance_ * force; }

  /// K = 1/Σ(1/kᵢ) [N/m].
  [[nodiscard]] double stiffness() const { return 1.0 / compliance_[0]; }

 private:
  Eigen::VectorXd compliance_;  ///< displacement of every free node per force at node 1 [m/N]
};

}  // namespace experiments
