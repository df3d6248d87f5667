// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What adapters share: a pose and facts out of what an SDK gives, a length in metres.

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

/// The rotation of a matrix whose columns are the handle's axes in the world, or none if they are no
/// right-handed frame of unit axes: one that is mirrored would turn the hand's torques round.
template <real S>
[[nodiscard]] std::optional<quaternion<S>> rotation_of(const Eigen::Matrix3d& columns) noexcept {
  const Eigen::Matrix3d from_unit = columns.transpose() * columns - Eigen::Matrix3d::Identity();
  if (!(from_unit.cwiseAbs().maxCoeff() < 1e-3) || !(columns.determinant() > 0.0)) return {};
  const Eigen::Quaterniond q(columns);
  return quaternion<S>{S(q.w()), S(q.x()), S(q.y()), S(q.z())};
}

/// A pose of a port from what an SDK says [m], or none if its orientation is no rotation. One that has no
/// orientation is not asked for it.
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

/// What a port says before it has ticked.
template <class Result, port P>
[[nodiscard]] Result nothing_yet() noexcept {
  Result r{};
  r.force = P::zero();
  return r;
}

/// What the source of an SDK says of a device, if it says anything: zero and less is nothing.
[[nodiscard]] constexpr design::fact said_by(const char* sdk, double value) noexcept {
  return value > 0.0 ? design::fact{value, design::evidence::software, sdk} : design::fact{};
}

/// Is a handle so far from the origin [m] in a workspace of this radius [m]? Ten times as far is no place
/// of it: millimetres that were taken for metres, or a position of the scene instead of the device's.
[[nodiscard]] constexpr parameter_fault check_metres(double distance, double radius) noexcept {
  if (!(radius > 0.0) || distance <= 10.0 * radius) return {};
  return {"position", distance,
          "within ten times the workspace's radius, in metres: are these millimetres, or "
          "positions of the scene instead of the device's?"};
}

}  // namespace adapters
}  // namespace v0
}  // namespace passive_haptics
