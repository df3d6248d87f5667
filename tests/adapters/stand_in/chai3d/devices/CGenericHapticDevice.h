// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// As much of CHAI3D's interface as the adapter uses, in declarations of our own.
// tests/adapters/interface_chai3d.cpp compares them with the real header where there is one.

#include <cmath>
#include <memory>

namespace chai3d {

const int C_MAX_DOF = 16;

class cVector3d {
 public:
  cVector3d() = default;
  cVector3d(const double x, const double y, const double z) : x_(x), y_(y), z_(z) {}
  double x() const { return x_; }
  double y() const { return y_; }
  double z() const { return z_; }
  double lengthsq() const { return x_ * x_ + y_ * y_ + z_ * z_; }
  void zero() { *this = {}; }

 private:
  double x_ = 0.0, y_ = 0.0, z_ = 0.0;
};

class cMatrix3d {
 public:
  double& operator()(const int row, const int column) { return values_[3 * row + column]; }
  const double& operator()(const int row, const int column) const {
    return values_[3 * row + column];
  }
  void identity() {
    for (int i = 0; i < 9; ++i) values_[i] = i % 4 == 0 ? 1.0 : 0.0;
  }

 private:
  double values_[9] = {};
};

class cTransform {};

struct cHapticDeviceInfo {
  double m_maxLinearForce = 0.0;
  double m_maxLinearStiffness = 0.0;
  double m_maxLinearDamping = 0.0;
  double m_workspaceRadius = 0.0;
};

class cGenericDevice {
 public:
  virtual ~cGenericDevice() = default;
  virtual bool open() { return false; }
  virtual bool close() { return false; }
  bool isDeviceAvailable() { return m_deviceAvailable; }
  bool isDeviceReady() { return m_deviceReady; }

 protected:
  bool m_deviceAvailable = false;
  bool m_deviceReady = false;
};

class cGenericHapticDevice;
using cGenericHapticDevicePtr = std::shared_ptr<cGenericHapticDevice>;

class cGenericHapticDevice : public cGenericDevice {
 public:
  explicit cGenericHapticDevice(unsigned int = 0) {}
  static cGenericHapticDevicePtr create(unsigned int number = 0) {
    return std::make_shared<cGenericHapticDevice>(number);
  }
  virtual bool calibrate(bool = false) { return m_deviceReady; }
  virtual bool getPosition(cVector3d& x) { return none(x); }
  virtual bool getLinearVelocity(cVector3d& v) { return none(v); }
  virtual bool getRotation(cMatrix3d& r) {
    r.identity();
    return m_deviceReady;
  }
  virtual bool getJointAnglesRad(double[C_MAX_DOF]) { return false; }
  virtual bool getAngularVelocity(cVector3d& w) { return none(w); }
  virtual bool getTransform(cTransform&) { return m_deviceReady; }
  virtual bool getGripperAngleRad(double& angle) { return none(angle); }
  virtual bool getGripperAngularVelocity(double& w) { return none(w); }
  virtual bool getForce(cVector3d& f) { return none(f); }
  virtual bool getTorque(cVector3d& t) { return none(t); }
  virtual bool getGripperForce(double& f) { return none(f); }
  virtual bool getUserSwitch(int, bool& on) {
    on = false;
    return m_deviceReady;
  }
  virtual bool getUserSwitches(unsigned int& all) {
    all = 0;
    return m_deviceReady;
  }
  cHapticDeviceInfo getSpecifications() { return m_specifications; }
  virtual void setEnableGripperUserSwitch(const bool) {}
  virtual bool getEnableGripperUserSwitch() const { return false; }
  bool setForce(const cVector3d& f) { return setForceAndTorqueAndGripperForce(f, {}, 0.0); }
  virtual bool setForceAndTorqueAndGripperForce(const cVector3d&, const cVector3d&, double) {
    return m_deviceReady;
  }
  virtual bool enableForces(bool) { return true; }

  cHapticDeviceInfo m_specifications{};

 private:
  template <class T>
  bool none(T& value) const {
    value = T();
    return m_deviceReady;
  }
};

}  // namespace chai3d
