// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// As much of CHAI3D's interface as examples/adapters/chai3d_touch.cpp uses, in declarations of our own.

namespace chai3d {

class cGenericObject {
 public:
  virtual ~cGenericObject() = default;
  void setStiffness(double stiffness, bool affect_children = false);
};

}  // namespace chai3d
