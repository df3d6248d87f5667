// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// CHAI3D: a passive port in front of a device, and the surface of a mesh for a local model. Needs CHAI3D's
// src/ in the include path, 3.2 or later.
//
//   tool ─▶ passive_device ─▶ PORT ─▶ your device          whatever CHAI3D computes, the hand gains no energy
//              position, force in raw metres and newtons
//
//     chai3d::cGenericHapticDevicePtr falcon;
//     handler->getDevice(falcon, 0);
//     auto device = ph::adapters::make_passive_device(falcon, ph::make_guard<scene>(facts, hand));
//     tool->setHapticDevice(device);                      // instead of falcon; all else as it was
//
// The port uses the positions of the device in metres, not the scaled ones of the tool. In a workspace scaled by 5
// those are five times too large, and a ledger computed from them is wrong by joules; with the positions of the
// device it is right at every scale.
//
//   proxy_probe     the surface of a deforming mesh as a plane for a local model: a finger proxy from before the
//                   deformation may lie behind the mesh, so each update starts a new one from outside
//   facts_of        the specifications that CHAI3D has of a device

#include <passive_haptics/adapters/poses.hpp>
#include <passive_haptics/base/stopwatch.hpp>
#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/contact/given_force.hpp>
#include <passive_haptics/port/passive_port.hpp>

#include <atomic>
#include <devices/CGenericHapticDevice.h>
#include <forces/CAlgorithmFingerProxy.h>
#include <memory>
#include <utility>

namespace passive_haptics {
inline namespace v0 {
namespace adapters {

namespace chai3d_types {

[[nodiscard]] inline Eigen::Vector3d vector(const ::chai3d::cVector3d& v) noexcept {
  return {v.x(), v.y(), v.z()};
}
[[nodiscard]] inline ::chai3d::cVector3d vector(const Eigen::Vector3d& v) noexcept {
  return {v.x(), v.y(), v.z()};
}
[[nodiscard]] inline Eigen::Matrix3d matrix(const ::chai3d::cMatrix3d& m) noexcept {
  Eigen::Matrix3d all;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) all(row, column) = m(row, column);
  }
  return all;
}

/// The base of every passive_device, by which one is recognised whatever its port.
class decorated : public ::chai3d::cGenericHapticDevice {};

}  // namespace chai3d_types

/// The facts of a device in CHAI3D's source. Its damping is the largest for a controller, not that of the device, so
/// it is left out.
[[nodiscard]] inline design::device_facts facts_of(const ::chai3d::cHapticDeviceInfo& info) {
  constexpr const char* source = "CHAI3D, cHapticDeviceInfo";
  return {.peak_force = said_by(source, info.m_maxLinearForce),
          .stiffness = said_by(source, info.m_maxLinearStiffness),
          .workspace_radius = said_by(source, info.m_workspaceRadius)};
}

/// A device whose every force goes through a port; in all else it is the device that it decorates.
///
/// `Port` is a passive_port at a given_force or a settled_force. With space<S, 3> or stylus a torque is refused; with
/// rigid_body force and torque are one wrench. The force of a gripper is always refused, because no ledger here books its
/// work. A refused torque or force is not sent, and has_refused() is true.
///
/// A device whose setForce… returns false has refused the force, and must not go on holding the last one.
///
/// The position is read again when the force is about to be sent, so that the motion between two sends is
/// paired with the force that was held in between. `Clock` measures that time.
template <class Port, measuring_clock Clock = steady_time>
requires hand_port<typename Port::port_type>
class passive_device final : public chai3d_types::decorated {
 public:
  using port_type = typename Port::port_type;
  using scalar = typename port_type::scalar;
  using result_type = typename Port::result_type;
  using vector3 = ::chai3d::cVector3d;

  passive_device(::chai3d::cGenericHapticDevicePtr device, const Port& port)
      : fault_(fault_of(device.get())),
        device_(device != nullptr ? std::move(device) : ::chai3d::cGenericHapticDevice::create()),
        port_(port) {
    copy_state();
  }

  /// The first fault, if any: no device, a device that has a port already, a parameter of the port, or, once it is
  /// open, a position that cannot be in metres. A device with a fault does not open, and is sent no force.
  [[nodiscard]] parameter_fault check() const {
    if (fault_) return fault_;
    if (const auto fault = port_.check()) return fault;
    return unit_fault_;
  }

  bool open() override {
    unit_fault_ = {};
    if (check() || !device_->open()) return false;
    copy_state();  // a device has its specifications only once it is open
    port_.reset();
    watch_.reset();
    if (vector3 x; device_->getPosition(x)) {
      unit_fault_ =
          check_metres(chai3d_types::vector(x).norm(), m_specifications.m_workspaceRadius);
    }
    if (unit_fault_) (void)close();
    return !unit_fault_;
  }
  bool close() override {
    const bool done = device_->close();
    m_deviceReady = false;
    return done;
  }

  /// Passes the wanted force [N] and torque [N·m] through the port, and sends the result to the device.
  bool setForceAndTorqueAndGripperForce(const vector3& force, const vector3& torque,
                                        double gripper_force) override {
    if (fault_ || unit_fault_) return false;
    refused_ = (!turns && torque.lengthsq() > 0.0) || gripper_force != 0.0;
    last_ = tick(force, torque);
    const auto [f, t] = split(last_.force);
    if (device_->setForceAndTorqueAndGripperForce(f, t, 0.0)) return true;
    // The command was not held, so the force during the next motion is unknown.
    last_ = port_.tick(device_sample<port_type>{.dt = scalar(1e-3), .valid = false});
    return false;
  }

  /// The result of the last tick: the event, the energy [J], whether the force was limited.
  [[nodiscard]] const result_type& last() const noexcept { return last_; }
  /// True if the last command had a torque or a gripper force that was refused.
  [[nodiscard]] bool has_refused() const noexcept { return refused_; }
  [[nodiscard]] const Port& port() const noexcept { return port_; }

  // All other functions are those of the device.
  bool calibrate(bool force = false) override { return device_->calibrate(force); }
  bool getPosition(vector3& x) override { return device_->getPosition(x); }
  bool getLinearVelocity(vector3& v) override { return device_->getLinearVelocity(v); }
  bool getRotation(::chai3d::cMatrix3d& r) override { return device_->getRotation(r); }
  bool getJointAnglesRad(double angles[::chai3d::C_MAX_DOF]) override {
    return device_->getJointAnglesRad(angles);
  }
  bool getAngularVelocity(vector3& w) override { return device_->getAngularVelocity(w); }
  bool getTransform(::chai3d::cTransform& t) override { return device_->getTransform(t); }
  bool getGripperAngleRad(double& angle) override { return device_->getGripperAngleRad(angle); }
  bool getGripperAngularVelocity(double& w) override {
    return device_->getGripperAngularVelocity(w);
  }
  bool getForce(vector3& f) override { return device_->getForce(f); }
  bool getTorque(vector3& t) override { return device_->getTorque(t); }
  bool getGripperForce(double& f) override { return device_->getGripperForce(f); }
  bool getUserSwitch(int index, bool& on) override { return device_->getUserSwitch(index, on); }
  bool getUserSwitches(unsigned int& all) override { return device_->getUserSwitches(all); }
  void setEnableGripperUserSwitch(const bool on) override {
    device_->setEnableGripperUserSwitch(on);
  }
  bool getEnableGripperUserSwitch() const override { return device_->getEnableGripperUserSwitch(); }
  /// The same, and the port hears of it before its next tick: while the device drops the forces nothing is credited. One
  /// thread at a time may call it, beside the tick.
  bool enableForces(bool on) override {
    int before = 0, told = went_off;
    if (!on) before = motors_.exchange(told);  // told first, so that no tick counts on what is gone
    const bool done = device_->enableForces(on);
    if (on && done) motors_ |= came_on;
    if (!on && !done && !motors_.compare_exchange_strong(told, before)) motors_ |= came_on;
    return done;
  }

 private:
  using effort = typename port_type::effort;
  /// True if the port books the work of a torque.
  static constexpr bool turns = port_type::dof == 6;

  [[nodiscard]] static parameter_fault fault_of(const ::chai3d::cGenericHapticDevice* device) {
    if (device == nullptr) {
      return {"device", 0.0, "a device: ask a cHapticDeviceHandler for one first"};
    }
    if (dynamic_cast<const chai3d_types::decorated*>(device) != nullptr) {
      return {"device", 0.0,
              "one that no passive_device decorates yet: two ports on one device spend the same "
              "damping twice"};
    }
    return {};
  }
  void copy_state() {
    m_specifications = device_->m_specifications;
    m_deviceAvailable = device_->isDeviceAvailable();
    m_deviceReady = device_->isDeviceReady();
  }

  result_type tick(const vector3& force, const vector3& torque) {
    if (motors_ != 0) [[unlikely]] {
      const int news = motors_.exchange(0);
      if ((news & went_off) != 0) port_.enable_forces(false);
      if ((news & came_on) != 0) port_.enable_forces(true);
    }
    const seconds<scalar> dt = seconds{watch_.lap(1e-3)};
    vector3 x;
    ::chai3d::cMatrix3d r;
    r.identity();
    bool read = device_->getPosition(x);
    if constexpr (turning_port<port_type>) read = device_->getRotation(r) && read;
    const auto pose = pose_of<port_type>(chai3d_types::vector(x), chai3d_types::matrix(r));
    if (!read || !pose)
      return port_.tick(device_sample<port_type>{.dt = dt.count(), .valid = false});
    return port_.tick(*pose, dt, join(force, torque));
  }
  [[nodiscard]] static effort join(const vector3& f, const vector3& t) noexcept {
    const auto force = chai3d_types::vector(f).template cast<scalar>().eval();
    if constexpr (turns) {
      return port_type::join(force, chai3d_types::vector(t).template cast<scalar>().eval());
    } else {
      return force;
    }
  }
  [[nodiscard]] static std::pair<vector3, vector3> split(const effort& w) noexcept {
    const auto out = [](const auto& v) {
      return chai3d_types::vector(v.template cast<double>().eval());
    };
    if constexpr (turns) {
      return {out(port_type::linear(w)), out(port_type::angular(w))};
    } else {
      return {out(w), vector3(0.0, 0.0, 0.0)};
    }
  }

  parameter_fault fault_;                     ///< fault of the device, found by the constructor
  ::chai3d::cGenericHapticDevicePtr device_;  ///< never null
  Port port_;
  basic_stopwatch<Clock> watch_{};
  result_type last_ = nothing_yet<result_type, port_type>();
  parameter_fault unit_fault_{};  ///< fault of its position, found by open()
  bool refused_ = false;
  static constexpr int went_off = 1, came_on = 2;
  std::atomic<int> motors_{0};  ///< what enableForces() has said since the last tick
};

template <class Port>
[[nodiscard]] std::shared_ptr<passive_device<Port>> make_passive_device(
    ::chai3d::cGenericHapticDevicePtr device, const Port& port) {
  return std::make_shared<passive_device<Port>>(std::move(device), port);
}

/// The map of a position x [m] of the device to the scene: x' = o + R s x.
struct workspace_map {
  double scale = 1.0;  ///< s
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< R

  /// The present map of a tool.
  template <class Tool>
  [[nodiscard]] static workspace_map of(Tool& tool) {
    return {tool.getWorkspaceScaleFactor(), chai3d_types::vector(tool.getGlobalPos()),
            chai3d_types::matrix(tool.getGlobalRot())};
  }
  [[nodiscard]] parameter_fault check() const noexcept {
    if (!passive_haptics::detail::positive(scale)) {
      return {"scale", scale, "finite and > 0, as a tool's workspace scale factor"};
    }
    if (!rotation_of<double>(rotation)) {
      return {"rotation", rotation.determinant(),
              "a right-handed frame of unit axes: one that is mirrored turns forces round"};
    }
    return {};
  }
  [[nodiscard]] Eigen::Vector3d to_scene(const Eigen::Vector3d& device) const {
    return origin + rotation * (scale * device);
  }
};

/// The tangent plane at a proxy outside, for a device inside the body; none if they are at the same place, as in free
/// space. Both positions are in metres of one frame, the stiffness in N/m of it.
template <real S = double>
[[nodiscard]] std::optional<half_space<space<S, 3>>> tangent_plane(const Eigen::Vector3d& proxy,
                                                                   const Eigen::Vector3d& device,
                                                                   double stiffness) {
  const Eigen::Vector3d out = proxy - device;
  const double depth = out.norm();
  if (!(depth > 1e-9)) return {};
  return half_space<space<S, 3>>{.point = proxy.template cast<S>(),
                                 .normal = (out / depth).template cast<S>(),
                                 .stiffness = static_cast<S>(stiffness)};
}

/// Finds the surface of a world under the device, by a new proxy that comes from outside along the last normal. It finds
/// the surface for a device just above it, too, which else could enter the body until the next update. Call it
/// once for each update of the mesh, in the thread that deforms it, and publish the result:
///     inbox.publish(probe.at(x, 800.0));                              // exchange<std::optional<plane>>
///     if (const auto* news = inbox.take()) { if (*news) touch.update(**news); else touch.release(); }
template <real S = double>
class proxy_probe {
 public:
  using plane = half_space<space<S, 3>>;

  /// `radius` is that of the finger, and the proxy starts `reach` outside of the device and goes `reach` below it [m of the
  /// scene]. `outward` is the first normal.
  proxy_probe(::chai3d::cWorld* world, double radius, double reach, const workspace_map& map = {},
              const Eigen::Vector3d& outward = Eigen::Vector3d::UnitZ())
      : world_(world), radius_(radius), reach_(reach), map_(map), normal_(outward.normalized()) {}

  [[nodiscard]] parameter_fault check() const noexcept {
    using passive_haptics::detail::not_negative, passive_haptics::detail::positive;
    if (world_ == nullptr) return {"world", 0.0, "a cWorld"};
    if (!not_negative(radius_)) return {"radius", radius_, "finite and ≥ 0 m"};
    if (!positive(reach_)) {
      return {"reach", reach_, "finite and > 0 m: deeper than the device will be"};
    }
    return map_.check();
  }

  /// `device` is a position [m] in the frame of the device, `stiffness` that of the mesh [N/m of the scene]. The plane is
  /// in the frame and metres of the device, with s times the stiffness. There is none if nothing is within reach, if a
  /// number is not finite, and with a fault.
  [[nodiscard]] std::optional<plane> at(const Eigen::Vector3d& device, double stiffness) {
    if (check() || !device.allFinite() || !(stiffness >= 0.0)) return {};
    const Eigen::Vector3d here = map_.to_scene(device), start = here + reach_ * normal_;
    Eigen::Vector3d goal = here, there = stop(start, goal);
    if (!((there - goal).norm() > 1e-9)) {  // no surface up to the device, so search below it
      goal = here - reach_ * normal_;
      there = stop(start, goal);
    }
    const Eigen::Vector3d out = there - goal;
    if (!(out.norm() > 1e-9)) return {};
    normal_ = out.normalized();
    const Eigen::Matrix3d back = map_.rotation.transpose();
    const auto to_device = [&](const Eigen::Vector3d& p) -> Eigen::Vector3d {
      return back * (p - map_.origin) / map_.scale;
    };
    return tangent_plane<S>(to_device(there), to_device(goal), stiffness * map_.scale);
  }

 private:
  /// The place [m] at which a proxy stops on its way from `start` to `goal`.
  [[nodiscard]] Eigen::Vector3d stop(const Eigen::Vector3d& start, const Eigen::Vector3d& goal) {
    ::chai3d::cAlgorithmFingerProxy proxy;
    proxy.initialize(world_, chai3d_types::vector(start));
    proxy.setProxyRadius(radius_);
    (void)proxy.computeForces(chai3d_types::vector(goal), ::chai3d::cVector3d(0.0, 0.0, 0.0));
    return chai3d_types::vector(proxy.getProxyGlobalPosition());
  }

  ::chai3d::cWorld* world_;
  double radius_, reach_;
  workspace_map map_;
  Eigen::Vector3d normal_;
};

}  // namespace adapters
}  // namespace v0
}  // namespace passive_haptics
