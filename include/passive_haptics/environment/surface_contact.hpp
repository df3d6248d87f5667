// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The contact of a deformable_body: place, normal, depth [m], stiffness [N/m]. contact_surface.hpp reads it.

#include <passive_haptics/environment/surface.hpp>

#include <Eigen/Core>

#include <array>
#include <concepts>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

/// The contact as the local model needs it.
struct surface_contact {
  std::array<Eigen::Vector3d, 3> nodes{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                       Eigen::Vector3d::Zero()};  ///< of the triangle [m]
  Eigen::Vector3d point = Eigen::Vector3d::Zero();    ///< p: of the triangle, closest to device [m]
  Eigen::Vector3d normal{0.0, 0.0, 1.0};              ///< n: of the triangle, unit, outward
  Eigen::Vector3d weights = Eigen::Vector3d::Zero();  ///< barycentric, of p
  Eigen::Vector3d rest = Eigen::Vector3d::Zero();     ///< where p is under no load [m]
  int triangle = -1;                                  ///< −1 until the first good update
  double depth = 0.0;                                 ///< (p − x)·n [m], positive inside
  double stiffness = 0.0;                             ///< of the body at p along n [N/m]
  bool fresh = false;  ///< false: an older contact, because the last input could not be used
};

/// A body with its last contact, and the surface and the positions of the nodes [m] of that update: a
/// deformable_body, or your own.
template <class B>
concept touched_body = requires(const B& body) {
  { body.contact() } -> std::convertible_to<const surface_contact&>;
  { body.nodes() } -> std::convertible_to<nodes_view>;
  body.search();
};

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
