// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A simulated arm of three joints, yaw, shoulder and elbow, like a Touch. Its motors hold torques in the joints,
// and a hand that is a velocity source turns them.
//
// Between two samples the joints turn at constant speed, so the meter is exact: E += b_q|Δq|²/T − τ·Δq [J].

#include <passive_haptics/device/eigen_space.hpp>

#include <cmath>

struct joint_arm_parameters {
  double upper = 0.1335, fore = 0.1335;  ///< lengths of the links [m]
  double damping = 1.4e-3;               ///< b_q of each joint [N·m·s/rad]
  double period = 1e-3;                  ///< [s]
};

class joint_arm {
 public:
  using vector = passive_haptics::space<double, 3>::vector;
  using matrix = Eigen::Matrix<double, 3, 3>;

  explicit joint_arm(const joint_arm_parameters& parameters = {},
                     const vector& start = vector(0.0, 0.9, -0.5)) noexcept
      : p_(parameters), q_(start) {}

  /// The position of the tip [m]. The angles of shoulder and elbow are both from the horizontal.
  [[nodiscard]] vector tip() const noexcept {
    const double out = reach();
    return {out * std::cos(q_(0)), out * std::sin(q_(0)),
            p_.upper * std::sin(q_(1)) + p_.fore * std::sin(q_(2))};
  }
  /// J = ∂tip/∂q [m/rad].
  [[nodiscard]] matrix jacobian() const noexcept {
    const double c = std::cos(q_(0)), s = std::sin(q_(0)), out = reach();
    const double up1 = p_.upper * std::sin(q_(1)), up2 = p_.fore * std::sin(q_(2));
    matrix j;
    j << -out * s, -up1 * c, -up2 * c,  //
        out * c, -up1 * s, -up2 * s,    //
        0.0, p_.upper * std::cos(q_(1)), p_.fore * std::cos(q_(2));
    return j;
  }
  /// Jᵀ f [N·m].
  [[nodiscard]] vector torques(const vector& force) const noexcept {
    return jacobian().transpose() * force;
  }
  /// One tick in which the joints turned by `by` [rad] while the motors held `torque`; returns their work [J].
  double move(const vector& by, const vector& torque) noexcept {
    const double work = torque.dot(by);
    energy_ += p_.damping * by.dot(by) / p_.period - work;
    q_ += by;
    return work;
  }
  [[nodiscard]] const vector& joints() const noexcept { return q_; }
  [[nodiscard]] double energy() const noexcept { return energy_; }  ///< true, at the port [J]

 private:
  [[nodiscard]] double reach() const noexcept {
    return p_.upper * std::cos(q_(1)) + p_.fore * std::cos(q_(2));
  }

  joint_arm_parameters p_;
  vector q_;
  double energy_ = 0.0;
};
