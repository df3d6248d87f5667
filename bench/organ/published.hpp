// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What an organ publishes of its last contact, and the set of one contact that it is felt through: the same
// in virtual time and in real threads.

#include "organ_mesh.hpp"
#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/environment/contact_surface.hpp>
#include <passive_haptics/environment/deformable_body.hpp>
#include <passive_haptics/passive_haptics.hpp>

#include <time.h>

namespace organ {

namespace ph = passive_haptics;
using volume = ph::space<double, 3>;
using plane = ph::half_space<volume>;
using quadric = ph::quadric<volume>;
using patch = ph::patch<volume, 16>;

/// The radius of the fingertip over which the force is spread [m].
inline constexpr double fingertip = 0.010;

template <class Surface>
inline constexpr const char* name_of = "plane";
template <>
inline constexpr const char* name_of<quadric> = "quadric";
template <>
inline constexpr const char* name_of<patch> = "patch of 16";

/// The plane of the triangle, the quadric through its neighbours, or 16 triangles as they are.
template <class Surface, class Elastic>
[[nodiscard]] Surface published(const env::basic_deformable_body<Elastic>& body) {
  if constexpr (std::same_as<Surface, quadric>) {
    return env::quadric_at(body, {.thickness = 0.01});
  } else if constexpr (std::same_as<Surface, patch>) {
    return env::patch_at(body, 0.01);
  } else {
    return {body.contact().point, body.contact().normal, body.contact().stiffness};
  }
}

/// One contact of a device of this mass [kg] that holds at most that force [N].
template <class Surface>
[[nodiscard]] auto one_contact(double mass, double force_limit) {
  return ph::contact_set{ph::proxy_spring{.mass = mass, .force_limit = force_limit}, ph::pursuit{},
                         ph::slots<Surface, 1>{}};
}

/// The nodes of the surface that a stroke comes near to, with the rings of triangles around them.
[[nodiscard]] inline std::vector<int> stroked_patch(const held_mesh& body) {
  constexpr double radius = 0.036;  // [m]
  const auto surface = env::boundary(body.mesh);
  std::vector<int> all;
  for (const auto& t : surface) {
    for (const int node : t.nodes) {
      if ((body.mesh.nodes[env::slot(node)] - body.top).norm() < radius) all.push_back(node);
    }
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// CPU time of the thread that asks [s].
[[nodiscard]] inline double thread_cpu() noexcept {
  timespec t{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace organ
