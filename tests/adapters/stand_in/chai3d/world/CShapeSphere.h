// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// As much of CHAI3D's interface as examples/adapters/chai3d_touch.cpp uses, in declarations of our own.

#include <world/CGenericObject.h>

namespace chai3d {

class cShapeSphere : public cGenericObject {
 public:
  explicit cShapeSphere(double radius);
  bool createEffectSurface();
};

}  // namespace chai3d
