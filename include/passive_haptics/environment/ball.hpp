// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The ball of the 3-DOF experiments (thesis 3.3), with as many inner nodes as geometry allows.
//
// A closed surface of 16 triangles has 16/2 + 2 = 10 vertices (Euler), so of 11 nodes exactly one
// is inside, and 16 tetrahedra join it to the faces. The "2 interior nodes" that the thesis fixes
// cannot exist; and two fixed nodes, wherever they are, leave the rotation about their line (audit.md A24).

#include <passive_haptics/environment/mesh.hpp>

#include <array>
#include <cmath>
#include <numbers>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

/// A gyroelongated square bipyramid in a sphere of `radius` [m] about the origin, plus its centre.
///     nodes 0 (0, 0, r) | 1-4 upper ring | 5-8 lower ring, turned by 45° | 9 (0, 0, −r) | 10 centre
/// The rings lie at z = ±(√2 − 1) r: all edges of the surface are 1.08 r long but those of the rings (1.29 r).
/// Throws std::invalid_argument for a radius that is not finite and > 0.
[[nodiscard]] inline tetrahedral_mesh ball(double radius) {
  if (!(radius > 0.0) || !std::isfinite(radius)) {
    refuse_argument("ball: radius ", radius, " m is refused; give a finite number above zero");
  }
  const double height = (std::numbers::sqrt2 - 1.0) * radius;
  const double ring = std::sqrt((radius - height) * (radius + height));
  tetrahedral_mesh mesh;
  mesh.nodes.emplace_back(0.0, 0.0, radius);
  for (int k = 0; k < 8; ++k) {
    const double angle = std::numbers::pi * (0.5 * (k % 4) + (k < 4 ? 0.0 : 0.25));
    mesh.nodes.emplace_back(ring * std::cos(angle), ring * std::sin(angle),
                            k < 4 ? height : -height);
  }
  mesh.nodes.emplace_back(0.0, 0.0, -radius);
  mesh.nodes.emplace_back(0.0, 0.0, 0.0);

  constexpr int centre = 10;
  for (int k = 0; k < 4; ++k) {
    const int upper = 1 + k;
    const int next_upper = 1 + (k + 1) % 4;
    const int lower = 5 + k;
    const int next_lower = 5 + (k + 1) % 4;
    mesh.tetrahedra.push_back({centre, 0, upper, next_upper});
    mesh.tetrahedra.push_back({centre, upper, lower, next_upper});
    mesh.tetrahedra.push_back({centre, next_upper, lower, next_lower});
    mesh.tetrahedra.push_back({centre, 9, next_lower, lower});
  }
  return mesh;
}

/// The nodes that hold the ball when it is pressed from above: the lower apex and two neighbours of
/// the lower ring. Three nodes that are not on a line leave no rigid motion, and these three are on the
/// far side, so the centre and the half that is touched stay free to give way.
[[nodiscard]] inline std::array<int, 3> ball_fixed_nodes() noexcept {
  return {9, 5, 6};
}

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
