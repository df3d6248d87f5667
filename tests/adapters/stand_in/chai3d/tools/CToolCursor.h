// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// As much of CHAI3D's interface as examples/adapters/chai3d_touch.cpp uses, in declarations of our own.

#include <devices/CGenericHapticDevice.h>
#include <forces/CAlgorithmFingerProxy.h>
#include <world/CGenericObject.h>

namespace chai3d {

class cToolCursor : public cGenericObject {
 public:
  explicit cToolCursor(cWorld* world);
  void setHapticDevice(cGenericHapticDevicePtr device);
  bool start();
  bool stop();
  void updateFromDevice();
  void computeInteractionForces();
  bool applyToDevice();
};

}  // namespace chai3d
