// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// An organ of any number of nodes: 120 by 80 by 50 mm, thicker at one end, coarse inside and fine under its
// surface, which is known in closed form. So a hand can follow it, and meshes of it can be compared.

#include <passive_haptics/environment/mesh.hpp>
#include <passive_haptics/environment/node_graph.hpp>
#include <passive_haptics/environment/tetrahedral_stiffness.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace organ {

namespace env = passive_haptics::environment;
using vector = Eigen::Vector3d;

/// A mesh, the nodes that hold it, and the middle of its top [m].
struct held_mesh {
  env::tetrahedral_mesh mesh;
  std::vector<int> held;
  vector top;
};

/// A grid of n³ nodes in (−1, 1)³, each cell cut into six tetrahedra about a diagonal, at place(q) [m].
template <class Place>
[[nodiscard]] env::tetrahedral_mesh grid_mesh(int n, const Place& place) {
  env::tetrahedral_mesh mesh;
  const auto number = [n](const std::array<int, 3>& at) { return (at[2] * n + at[1]) * n + at[0]; };
  for (int i = 0; i < n * n * n; ++i) {
    const vector index(i % n, i / n % n, i / n / n);
    mesh.nodes.push_back(place(vector(2.0 / (n - 1) * index - vector::Ones())));
  }
  const int m = n - 1;
  for (int cell = 0; cell < m * m * m; ++cell) {
    std::array<int, 3> axis{0, 1, 2};
    do {
      std::array<int, 3> at{cell % m, cell / m % m, cell / m / m};
      std::array<int, 4> t{number(at)};
      for (std::size_t s = 0; s < 3; ++s) {
        ++at[env::slot(axis[s])];
        t[s + 1] = number(at);
      }
      if (env::signed_volume(mesh, t) < 0.0) std::swap(t[2], t[3]);
      mesh.tetrahedra.push_back(t);
    } while (std::next_permutation(axis.begin(), axis.end()));
  }
  return mesh;
}

/// The organ itself: where a point of the cube (−1, 1)³ lies in it [m].
[[nodiscard]] inline vector organ_at(const vector& q) {
  constexpr double roundness =
      0.65;                        // 0: a box, 1: a ball, whose elements would be flat at the edges
  constexpr double grading = 0.5;  // layers are (1 + g)/(1 − g) times as thick inside as outside
  const double shell = q.cwiseAbs().maxCoeff();
  if (shell == 0.0) return vector::Zero();
  const vector graded = q * (1.0 + grading * (1.0 - shell));
  const vector round = graded * (1.0 + roundness * (shell / q.norm() - 1.0));
  const double thickness = 0.025 * (1.0 - 0.3 * round.x());
  return {0.060 * round.x(), 0.040 * round.y(), thickness * round.z()};
}

/// A point of its surface, and the normal there.
struct surface_place {
  vector point, normal;
};
/// Of the upper side; u and v in (−1, 1).
[[nodiscard]] inline surface_place top_at(double u, double v) {
  constexpr double h = 1e-4;
  const vector along = organ_at({u + h, v, 1.0}) - organ_at({u - h, v, 1.0});
  const vector across = organ_at({u, v + h, 1.0}) - organ_at({u, v - h, 1.0});
  return {organ_at({u, v, 1.0}), along.cross(across).normalized()};
}

/// Made of n³ nodes, its lowest 15 % held.
[[nodiscard]] inline held_mesh make_organ(int n) {
  held_mesh made{.mesh = grid_mesh(n, organ_at), .held = {}, .top = top_at(0.0, 0.0).point};
  Eigen::AlignedBox3d box;
  for (const auto& x : made.mesh.nodes) box.extend(x);
  const double lowest = box.min().z() + 0.15 * box.sizes().z();
  for (std::size_t i = 0; i < made.mesh.nodes.size(); ++i) {
    if (made.mesh.nodes[i].z() < lowest) made.held.push_back(static_cast<int>(i));
  }
  return made;
}

/// Its flesh.
inline constexpr env::material organ_flesh{.young = 2e4, .poisson = 0.45};

/// Where a hand that strokes its upper side wants to be at t [s], `depth` [m] below the surface at rest: a
/// Lissajous figure 42 by 28 mm, about 25 mm/s at the fastest.
struct stroke_of_organ {
  double deep = 0.003;    ///< mean depth [m]
  double swing = 0.001;   ///< of the depth [m]
  double above = 0.004;   ///< where it starts [m]
  double approach = 0.5;  ///< from there to the surface [s]

  [[nodiscard]] vector operator()(double t) const noexcept {
    const double turn = 2.0 * std::acos(-1.0) * t;
    const surface_place here = top_at(0.35 * std::sin(0.11 * turn), 0.35 * std::sin(0.17 * turn));
    const double s = std::clamp(t / approach, 0.0, 1.0);
    const double down = s * s * (3.0 - 2.0 * s);
    const double depth = (deep - swing * std::cos(0.5 * turn)) * down - above * (1.0 - down);
    return here.point - depth * here.normal;
  }
};

}  // namespace organ
