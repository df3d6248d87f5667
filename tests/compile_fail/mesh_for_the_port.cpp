// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the source of a port touches a mesh, and its surface moves it
//
// A mesh outlives many ticks and is shared by many ports, so a port does not own it.

#include <passive_haptics/mesh.hpp>
#include <passive_haptics/passive_haptics.hpp>

#include <array>
#include <vector>

namespace ph = passive_haptics;
using scene = ph::space<double, 3>;
const std::vector<ph::mesh::triangle> triangles{{0, 1, 2}};
const std::vector<scene::vector> nodes(3);
ph::mesh::surface organ(triangles, nodes);
auto touch = ph::make_mesh_touch<scene>(ph::exact_device{}, ph::known_hand{});

void use() {
#ifdef POSITIVE_CONTROL
  static_cast<void>(touch.source().touch(organ));
  organ.update(nodes);
#else
  touch.touch(organ);
  touch.update(nodes);
#endif
}
