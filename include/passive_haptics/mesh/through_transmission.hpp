// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A mesh, felt through a transmission that gives: as make_mesh_touch in mesh.hpp, with the bound of compliant/.
//
//     auto touch = ph::make_mesh_touch<scene>(device, ph::observed_transmission{.rotor = 0.03, .slew = 4000.0}, hand,
//                                             {.stiffness = 1500});

#include <passive_haptics/compliant/compositions.hpp>
#include <passive_haptics/mesh.hpp>

namespace passive_haptics {
inline namespace v0 {

/// Spring and damper are designed for the mass of the rotor. On encoders, state only the dry friction of the rotor.
template <class Space, class Limits = loop_limits, detail::described Device = exact_device,
          detail::stated_transmission Transmission>
[[nodiscard]] constexpr auto make_mesh_touch(const Device& device, const Transmission& transmission,
                                             const known_hand& hand,
                                             mesh_contact shape = {}) noexcept {
  const Device seen = detail::seen_through(device, transmission);
  detail::fit(shape.spring, detail::for_surfaces(seen, transmission, Limits::latency),
              detail::budget_of(seen, hand, Limits::latency));
  return detail::port_of<Space, Limits>(shape, seen, hand,
                                        detail::bounds_through<Limits>(seen, transmission, hand));
}

}  // namespace v0
}  // namespace passive_haptics
