// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a triangle is made of.
//
//     normal       f = K d                       K [N/m], d how deep [m]
//     tangential   |f_t| ≤ μ f                   Coulomb; sticks below, slides at it
//     viscous      −c v_t                        c [N·s/m], v_t the speed along the surface [m/s]

#include <passive_haptics/base/parameter.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace mesh {

struct material {
  double stiffness = 1000.0;  ///< K [N/m], before what the sampling leaves of it
  double friction = 0.0;      ///< μ
  double viscosity = 0.0;     ///< c [N·s/m], no more than half of m/T is felt of it

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!passive_haptics::detail::positive(stiffness))
      return {"stiffness", stiffness, "finite and > 0 N/m"};
    if (!passive_haptics::detail::not_negative(friction))
      return {"friction", friction, "finite and ≥ 0"};
    if (!passive_haptics::detail::not_negative(viscosity)) {
      return {"viscosity", viscosity, "finite and ≥ 0 N·s/m"};
    }
    return {};
  }
};

}  // namespace mesh
}  // namespace v0
}  // namespace passive_haptics
