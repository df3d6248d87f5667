// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A finger proxy of our own with CHAI3D's interface: on a sphere, which may grow and shrink, and as blind as
// the real one to a surface that has passed it by.

#include <devices/CGenericHapticDevice.h>

namespace chai3d {

class cGenericObject;

/// A world that is one sphere about the origin.
class cWorld {
 public:
  double radius = 0.05;    ///< [m]
  double stiffness = 1e3;  ///< of its surface [N/m]

  bool addChild(cGenericObject* object);
  void computeGlobalPositions(bool frame_only = true);
};

class cAlgorithmFingerProxy {
 public:
  virtual ~cAlgorithmFingerProxy() = default;
  void initialize(cWorld* world, const cVector3d& place) {
    world_ = world;
    m_proxyGlobalPos = place;
  }
  virtual cVector3d computeForces(const cVector3d& tool, const cVector3d& velocity);
  void setProxyRadius(const double& radius) { m_radius = radius; }
  double getProxyRadius() const { return m_radius; }
  cVector3d getProxyGlobalPosition() const { return m_proxyGlobalPos; }
  void setProxyGlobalPosition(const cVector3d& place) { m_proxyGlobalPos = place; }

 private:
  cWorld* world_ = nullptr;
  cVector3d m_proxyGlobalPos{};
  double m_radius = 0.0;
};

/// One that is outside stays outside, above the tool; one that finds itself inside has missed the surface and
/// follows the tool.
inline cVector3d cAlgorithmFingerProxy::computeForces(const cVector3d& tool, const cVector3d&) {
  const double surface = world_->radius + m_radius;
  const double from = std::sqrt(m_proxyGlobalPos.lengthsq()), to = std::sqrt(tool.lengthsq());
  if (from < surface - 1e-6 || to >= surface || !(to > 0.0)) {
    m_proxyGlobalPos = tool;
    return {};
  }
  const double out = surface / to, push = world_->stiffness * (out - 1.0);
  m_proxyGlobalPos = {tool.x() * out, tool.y() * out, tool.z() * out};
  return {push * tool.x(), push * tool.y(), push * tool.z()};
}

}  // namespace chai3d
