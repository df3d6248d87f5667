// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Force Dimension's DHD: a haptic device that reports the force that it held and its mass. Needs dhdc.h in the
// include path.
//
//     ph::adapters::force_dimension<scene> omega;
//     if (const auto fault = omega.open()) return complain(fault);
//     auto touch = ph::make_touch<scene>({.mass = omega.least_mass(), .damping = 0.05, .force_limit = 12.0, .longest_tick = 0.0005}, {.force = 5.0});
//     for (auto sample = omega.exchange(scene::zero()); …;) {
//       touch.enable_forces(omega.forces_on());                            // its button may have switched them off
//       sample = omega.exchange(touch.tick(sample).force);                 // the call paces the loop
//     }
//
// `held` in a sample is the force of the motors: if the SDK reports that they saturated, it is the force that the SDK
// applied. A sample that the time guard of the SDK repeats is read again, because an old position looks like
// a device at rest. Forces that DRD's regulation adds are behind the port, and no ledger books them.

#include <passive_haptics/adapters/poses.hpp>
#include <passive_haptics/device/rigid_body.hpp>
#include <passive_haptics/port/concepts.hpp>

#include <Eigen/Eigenvalues>

#include <cstddef>
#include <dhdc.h>
#include <utility>

namespace passive_haptics {
inline namespace v0 {
namespace adapters {

/// The least apparent mass [kg] of a handle with this inertia [kg, kg·m, kg·m²], (velocity, turning rate) in
/// that order, over all directions of its travel. A wrist that is free to turn makes it lighter: M_tt − M_tr
/// M_rr⁻¹ M_rt. Zero if the matrix is no inertia.
[[nodiscard]] inline double least_apparent_mass(const Eigen::Matrix<double, 6, 6>& inertia) {
  Eigen::Matrix3d moving = inertia.topLeftCorner<3, 3>();
  const Eigen::Matrix3d turning = inertia.bottomRightCorner<3, 3>();
  if (const Eigen::LLT<Eigen::Matrix3d> solver(turning); solver.info() == Eigen::Success) {
    const Eigen::Matrix3d coupling = inertia.bottomLeftCorner<3, 3>();
    moving -= coupling.transpose() * solver.solve(coupling);
  }
  if (!moving.allFinite()) return 0.0;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> modes(moving, Eigen::EigenvaluesOnly);
  const double least = modes.eigenvalues()(0);
  return least > 0.0 ? least : 0.0;
}

namespace dhd {
/// The largest force that the SDK lets its motors hold [N]; 0 for older SDKs, which do not report it.
template <class Id>
[[nodiscard]] double most_force(Id id) {
  if constexpr (requires { dhdGetMaxForce(id); }) {
    return dhdGetMaxForce(id);
  } else {
    return 0.0;
  }
}
}  // namespace dhd

/// `Port` is space<S, 3>, stylus, or rigid_body for a device whose wrist has motors. Models
/// haptic_device_for<Port>. One thread owns it.
template <hand_port Port>
class force_dimension {
 public:
  using port_type = Port;
  using scalar = typename Port::scalar;
  using effort = typename Port::effort;
  using sample_type = device_sample<Port>;

  force_dimension() = default;
  force_dimension(const force_dimension&) = delete;
  force_dimension& operator=(const force_dimension&) = delete;
  ~force_dimension() { close(); }

  /// The device of that number, −1 for the first free one. The SDK opens no device twice, so no two
  /// ports of this kind share one.
  [[nodiscard]] parameter_fault open(char id = -1) {
    close();
    const int opened = id < 0 ? dhdOpen() : dhdOpenID(id);
    if (opened < 0) {
      return {"device", static_cast<double>(dhdErrorGetLast()),
              "one that is connected, powered and not open elsewhere: dhdErrorGetLastStr() says "
              "which it is"};
    }
    id_ = static_cast<char>(opened);
    if (turns && !dhdHasActiveWrist(id_)) {
      close();
      return {"wrist", 0.0, "one with motors: use stylus, or space, for a device without"};
    }
    (void)dhdEnableForce(DHD_ON, id_);
    stamp_ = dhdGetTime();
    saturated_ = failed_ = 0;
    return {};
  }
  void close() noexcept {
    if (id_ < 0) return;
    (void)dhdSetForceAndTorqueAndGripperForce(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, id_);
    (void)dhdClose(id_);
    id_ = closed;
  }
  [[nodiscard]] bool is_open() const noexcept { return id_ >= 0; }

  /// Sends a force [N] and a torque [N·m], and returns the position of the handle after that. The force of a gripper is
  /// zero, because no port books it. A number that is not finite is sent as zero.
  [[nodiscard]] sample_type exchange(const effort& wanted) noexcept {
    const effort sent = Port::is_finite(wanted) ? wanted : effort(Port::zero());
    const int said = send(sent);
    sample_type sample{.held = said == DHD_MOTOR_SATURATED ? applied(sent) : sent};
    sample.valid = read(sample.position) && said >= 0;
    const double now = dhdGetTime();
    sample.dt = static_cast<scalar>(now - std::exchange(stamp_, now));
    saturated_ += said == DHD_MOTOR_SATURATED ? 1U : 0U;
    failed_ += said < 0 ? 1U : 0U;
    return sample;
  }

  /// False if the motors are off, by the button of the device or by a fault, or if the SDK does not say. No sample says
  /// so: a port that is not told by enable_forces() takes what it commands for held, and credits the hand with it.
  [[nodiscard]] bool forces_on() const noexcept {
    int status[DHD_MAX_STATUS] = {};
    return is_open() && dhdGetStatus(status, id_) >= 0 && status[DHD_STATUS_FORCE] != 0;
  }

  /// Exchanges since open() in which the motors could not hold the command, and those that the SDK refused.
  [[nodiscard]] unsigned long saturated() const noexcept { return saturated_; }
  [[nodiscard]] unsigned long failed() const noexcept { return failed_; }

  /// The least apparent mass at the present pose [kg], 0 if the SDK has none. Call it at the corners of the workspace,
  /// too, and take the smallest.
  [[nodiscard]] double least_mass() const {
    double joints[DHD_MAX_DOF] = {}, inertia[6][6] = {};
    if (!is_open() || dhdEnableExpertMode() < 0) return 0.0;
    const bool known = dhdGetJointAngles(joints, id_) >= 0 &&
                       dhdJointAnglesToInertiaMatrix(joints, inertia, id_) >= 0;
    (void)dhdDisableExpertMode();
    if (!known) return 0.0;
    return least_apparent_mass(matrix_of(inertia));
  }

  /// The facts of an open device in the SDK, which has neither damping nor friction.
  [[nodiscard]] design::device_facts facts() const {
    if (!is_open()) return {};
    return {.name = dhdGetSystemName(id_),
            .mass = said_by("DHD", least_mass()),
            .peak_force = said_by("DHD", dhd::most_force(id_)),
            .rate = said_by("DHD", dhdGetComFreq(id_) * 1e3)};  // the SDK says it in kHz
  }

 private:
  static constexpr char closed = -1;
  static constexpr bool turns = Port::dof == 6;

  template <int N>
  [[nodiscard]] static Eigen::Matrix<double, N, N> matrix_of(const double (&rows)[N][N]) {
    Eigen::Matrix<double, N, N> all;
    for (int row = 0; row < N; ++row) {
      for (int column = 0; column < N; ++column) all(row, column) = rows[row][column];
    }
    return all;
  }

  int send(const effort& w) const noexcept {
    if (!is_open()) return -1;
    const auto n = [&w](int i) { return static_cast<double>(w(i)); };
    if constexpr (turns) {
      return dhdSetForceAndTorqueAndGripperForce(n(0), n(1), n(2), n(3), n(4), n(5), 0.0, id_);
    } else {
      return dhdSetForceAndTorqueAndGripperForce(n(0), n(1), n(2), 0.0, 0.0, 0.0, 0.0, id_);
    }
  }
  /// The force that saturated motors hold, or the command if the SDK does not report it.
  [[nodiscard]] effort applied(const effort& told) const noexcept {
    double f[3] = {}, t[3] = {}, g = 0.0;
    if (dhdGetForceAndTorqueAndGripperForce(&f[0], &f[1], &f[2], &t[0], &t[1], &t[2], &g, id_) <
        0) {
      return told;
    }
    effort held = Port::zero();
    for (int i = 0; i < 3; ++i) {
      held(i) = static_cast<scalar>(f[i]);
      if constexpr (turns) held(i + 3) = static_cast<scalar>(t[i]);
    }
    return held;
  }
  /// Reads the pose; returns false if there is no new one.
  bool read(typename Port::stored_pose& into) const noexcept {
    if (!is_open()) return false;
    Eigen::Vector3d x;
    double rows[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    int said = DHD_TIMEGUARD;
    for (int i = 0; i < most_repeats && said == DHD_TIMEGUARD; ++i) {
      if constexpr (turning_port<Port>) {
        said = dhdGetPositionAndOrientationFrame(&x(0), &x(1), &x(2), rows, id_);
      } else {
        said = dhdGetPosition(&x(0), &x(1), &x(2), id_);
      }
    }
    if (said < 0 || said == DHD_TIMEGUARD) return false;
    const auto pose = pose_of<Port>(x, matrix_of(rows));
    if (pose) into = *pose;
    return pose.has_value();
  }

  static constexpr int most_repeats = 10000;  ///< of a sample that the time guard repeats

  char id_ = closed;
  double stamp_ = 0.0;  ///< of the last sample, on the SDK's clock [s]
  unsigned long saturated_ = 0, failed_ = 0;
};

}  // namespace adapters
}  // namespace v0
}  // namespace passive_haptics
