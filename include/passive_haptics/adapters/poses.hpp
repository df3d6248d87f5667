// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Shared by the adapters: poses and facts from the values of an SDK, and the check that lengths are in metres.

#include <passive_haptics/device/rotation.hpp>
#include <passive_haptics/identification/device_facts.hpp>
#include <passive_haptics/port/concepts.hpp>

#include <Eigen/Geometry>

#include <optional>

namespace passive_haptics {
inline namespace v0 {
namespace adapters {

/// A pose with an orientation: that of rigid_body and stylus.
template <class P>
concept turning_port = port<P> && requires {
  typename P::body_space;
};
/// A port that moves in space, turning or not.
template <class P>
concept hand_port = turning_port<P> ||(port<P>&& P::dof == 3 && detail::has_geometry<P>);

/// The rotation of a matrix whose columns are the axes of the handle in the world, or none if they are no right-handed
/// frame of unit axes, because a mirrored frame would reverse the torques.
template <real S>
[[nodiscard]] std::optional<quaternion<S>> rotation_of(const Eigen::Matrix3d& columns) noexcept {
  const Eigen::Matrix3d from_unit = columns.transpose() * columns - Eigen::Matrix3d::Identity();
  if (!(from_unit.cwiseAbs().maxCoeff() < 1e-3) || !(columns.determinant() > 0.0)) return {};
  const Eigen::Quaterniond q(columns);
  return quaternion<S>{S(q.w()), S(q.x()), S(q.y()), S(q.z())};
}

/// The pose of a port from the position [m] and the axes of an SDK, or none if the axes are no rotation. A port without
/// orientation ignores the axes.
template <hand_port P>
[[nodiscard]] std::optional<typename P::pose> pose_of(const Eigen::Vector3d& place,
                                                      const Eigen::Matrix3d& columns) noexcept {
  using S = typename P::scalar;
  if constexpr (turning_port<P>) {
    const auto turned = rotation_of<S>(columns);
    if (!turned) return {};
    return typename P::pose{place.template cast<S>(), *turned};
  } else {
    return typename P::pose(place.template cast<S>());
  }
}

/// The result of a port before its first tick.
template <class Result, port P>
[[nodiscard]] Result nothing_yet() noexcept {
  Result r{};
  r.force = P::zero();
  return r;
}

/// A fact from the source of an SDK; a value ≤ 0 means that the SDK does not know it.
[[nodiscard]] constexpr design::fact said_by(const char* sdk, double value) noexcept {
  return value > 0.0 ? design::fact{value, design::evidence::software, sdk} : design::fact{};
}

/// The fault of a handle farther from the origin than ten radii of the workspace [m]: its position is in millimetres, or
/// in the scene instead of the device.
[[nodiscard]] constexpr parameter_fault check_metres(double distance, double radius) noexcept {
  if (!(radius > 0.0) || distance <= 10.0 * radius) return {};
  return {"position", distance,
          "within ten times the workspace's radius, in metres: are these millimetres, or "
          "positions of the scene instead of the device's?"};
}

}  // namespace adapters
}  // namespace v0
}  // namespace passive_haptics
