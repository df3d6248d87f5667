// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A mesh under the finger, with memory: no plate, edge or vertex lets the finger through, whatever the mesh does
// between news. The menu:
//
//   mesh/surface.hpp        mesh::surface      triangles, a tree of boxes, news of nodes and poses; 1 to 5e7
//   mesh/proxy.hpp          mesh::proxy        a ball that is drawn to the device and passes through nothing:
//                                              by itself, for a renderer, an engine, another language
//   mesh/mesh_contact.hpp   mesh_contact       the same as the source of a port, with spring and damper
//
// Points against meshes; collisions between bodies are not in. docs/design/meshes.md has proofs and figures.

#include <passive_haptics/mesh/mesh_contact.hpp>
#include <passive_haptics/mesh/proxy.hpp>
#include <passive_haptics/mesh/surface.hpp>
