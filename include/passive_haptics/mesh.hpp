// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Contact of a point with a mesh, by a proxy that no triangle, edge or vertex lets through, for any motion of the
// mesh between updates. The menu:
//
//   mesh/surface.hpp        mesh::surface      triangles, a tree of boxes, news of nodes and poses; 1 to 5e7
//   mesh/smooth.hpp         mesh::smooth       its facets, felt as a smooth surface between creases; off by default
//   mesh/material.hpp       mesh::material     stiffness, friction and viscosity, of a mesh or triangle by triangle
//   mesh/proxy.hpp          mesh::proxy        a ball that is drawn to the device and does not pass through the mesh;
//                                              usable alone, for a renderer, an engine, another language
//   mesh/mesh_contact.hpp   mesh_contact       the same as the source of a port, with spring and damper
//   mesh/mesh_tool.hpp      mesh_tool          a tool that turns, with several such points; not included here
//   mesh/through_transmission.hpp              make_mesh_touch behind a cable that gives; not included here
//
// Collisions between bodies are not included. docs/design/meshes.md has proofs and measurements.

#include <passive_haptics/compositions.hpp>
#include <passive_haptics/mesh/mesh_contact.hpp>
#include <passive_haptics/mesh/proxy.hpp>
#include <passive_haptics/mesh/surface.hpp>

namespace passive_haptics {
inline namespace v0 {

/// A port for contact with a mesh: port.source().touch(surface), then port.tick(sample). Its stiffness is limited to one
/// that comes to rest and, on encoders, that dry friction pays for. The guarantee is that of make_guard.
///     auto touch = ph::make_mesh_touch<scene>(device, hand, {.stiffness = 1500});
template <class Space, class Limits = loop_limits, detail::described Device = exact_device,
          detail::stated_hand Hand = known_hand>
[[nodiscard]] constexpr auto make_mesh_touch(const Device& device, const Hand& hand,
                                             mesh_contact shape = {}) noexcept {
  detail::fit(shape.spring, device, detail::budget_of(device, hand, Limits::latency));
  return detail::port_of<Space, Limits>(shape, device, hand, detail::bounds_of(device, hand));
}

/// The type that make_mesh_touch returns, for members of a class.
template <class Space, class Limits = loop_limits, class Device = exact_device,
          class Hand = known_hand>
using mesh_touch = decltype(make_mesh_touch<Space, Limits>(Device{}, Hand{}));

}  // namespace v0
}  // namespace passive_haptics
