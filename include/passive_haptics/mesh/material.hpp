// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a triangle feels like.

#include <passive_haptics/base/parameter.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace mesh {

/// Of a kind of triangles; a mesh names one for each (surface::paint).
struct material {
  double stiffness = 1000.0;      ///< K [N/m], before what mass and tick leave of it
  double static_friction = 0.0;   ///< μ_s, of a finger that sticks
  double kinetic_friction = 0.0;  ///< μ_d ≤ μ_s, of one that slips
  double viscosity = 0.0;         ///< b, of a finger that slides, along the surface [N·s/m]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    using passive_haptics::detail::not_negative;
    if (!passive_haptics::detail::positive(stiffness)) {
      return {"stiffness", stiffness, "finite and > 0 N/m"};
    }
    if (!not_negative(static_friction)) {
      return {"static_friction", static_friction, "finite and ≥ 0"};
    }
    if (!(kinetic_friction >= 0.0 && kinetic_friction <= static_friction)) {
      return {"kinetic_friction", kinetic_friction, "in [0, static_friction]"};
    }
    if (!not_negative(viscosity)) return {"viscosity", viscosity, "finite and ≥ 0 N·s/m"};
    return {};
  }
};

}  // namespace mesh
}  // namespace v0
}  // namespace passive_haptics
