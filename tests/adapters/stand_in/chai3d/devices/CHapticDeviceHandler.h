// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// As much of CHAI3D's interface as examples/adapters/chai3d_touch.cpp uses, in declarations of our own.

#include <devices/CGenericHapticDevice.h>

namespace chai3d {

class cHapticDeviceHandler {
 public:
  bool getDevice(cGenericHapticDevicePtr& device, unsigned int index = 0);
};

}  // namespace chai3d
