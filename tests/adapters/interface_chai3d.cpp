// SPDX-License-Identifier: BSD-3-Clause
// What the adapter takes for granted of CHAI3D. Compiled against our own declarations always, and
// against CHAI3D's where -DPASSIVE_HAPTICS_CHAI3D=<its src folder> says where they are.
#include <devices/CGenericHapticDevice.h>
#include <forces/CAlgorithmFingerProxy.h>
#include <type_traits>

using namespace chai3d;
using device = cGenericHapticDevice;

template <class Expected, class Found>
constexpr bool same = std::is_same_v<Expected, Found>;

static_assert(std::is_base_of_v<cGenericDevice, device>);
static_assert(std::has_virtual_destructor_v<device>);
static_assert(same<std::shared_ptr<device>, cGenericHapticDevicePtr>);
static_assert(same<cGenericHapticDevicePtr (*)(unsigned int), decltype(&device::create)>);
static_assert(same<bool (cGenericDevice::*)(), decltype(&cGenericDevice::open)>);
static_assert(same<bool (device::*)(bool), decltype(&device::calibrate)>);
static_assert(same<bool (device::*)(bool), decltype(&device::enableForces)>);
static_assert(same<bool (device::*)(cVector3d&), decltype(&device::getPosition)>);
static_assert(same<bool (device::*)(cVector3d&), decltype(&device::getLinearVelocity)>);
static_assert(same<bool (device::*)(cMatrix3d&), decltype(&device::getRotation)>);
static_assert(same<bool (device::*)(double[C_MAX_DOF]), decltype(&device::getJointAnglesRad)>);
static_assert(same<bool (device::*)(cVector3d&), decltype(&device::getAngularVelocity)>);
static_assert(same<bool (device::*)(cTransform&), decltype(&device::getTransform)>);
static_assert(same<bool (device::*)(double&), decltype(&device::getGripperAngleRad)>);
static_assert(same<bool (device::*)(double&), decltype(&device::getGripperAngularVelocity)>);
static_assert(same<bool (device::*)(cVector3d&), decltype(&device::getForce)>);
static_assert(same<bool (device::*)(cVector3d&), decltype(&device::getTorque)>);
static_assert(same<bool (device::*)(double&), decltype(&device::getGripperForce)>);
static_assert(same<bool (device::*)(int, bool&), decltype(&device::getUserSwitch)>);
static_assert(same<bool (device::*)(unsigned int&), decltype(&device::getUserSwitches)>);
static_assert(same<void (device::*)(bool), decltype(&device::setEnableGripperUserSwitch)>);
static_assert(same<bool (device::*)() const, decltype(&device::getEnableGripperUserSwitch)>);
static_assert(same<bool (device::*)(const cVector3d&, const cVector3d&, double),
                   decltype(&device::setForceAndTorqueAndGripperForce)>);
static_assert(same<cHapticDeviceInfo device::*, decltype(&device::m_specifications)>);
static_assert(same<double cHapticDeviceInfo::*, decltype(&cHapticDeviceInfo::m_maxLinearForce)>);
static_assert(
    same<double cHapticDeviceInfo::*, decltype(&cHapticDeviceInfo::m_maxLinearStiffness)>);
static_assert(same<double cHapticDeviceInfo::*, decltype(&cHapticDeviceInfo::m_workspaceRadius)>);

using proxy = cAlgorithmFingerProxy;
static_assert(same<void (proxy::*)(cWorld*, const cVector3d&), decltype(&proxy::initialize)>);
static_assert(same<cVector3d (proxy::*)(const cVector3d&, const cVector3d&),
                   decltype(&proxy::computeForces)>);
static_assert(same<void (proxy::*)(const double&), decltype(&proxy::setProxyRadius)>);
static_assert(same<cVector3d (proxy::*)() const, decltype(&proxy::getProxyGlobalPosition)>);
static_assert(same<void (proxy::*)(const cVector3d&), decltype(&proxy::setProxyGlobalPosition)>);
static_assert(std::has_virtual_destructor_v<proxy>);

int main() {
  const cVector3d v(1.0, 2.0, 3.0);
  cMatrix3d m;
  m.identity();
  return v.x() + v.y() + v.z() + v.lengthsq() == 20.0 && m(0, 0) == 1.0 ? 0 : 1;
}
