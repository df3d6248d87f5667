// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the triangles of a mesh are a std::vector of mesh::triangle
//
// The numbers of nodes are int, so that one below 0 is seen.

#include <passive_haptics/mesh.hpp>
#include <passive_haptics/passive_haptics.hpp>

#include <array>
#include <vector>

namespace ph = passive_haptics;

#ifdef POSITIVE_CONTROL
using number = int;
#else
using number = unsigned;
#endif
const std::vector<std::array<number, 3>> triangles{{0, 1, 2}};
const std::vector<ph::space<double, 3>::vector> nodes(3);
ph::mesh::surface organ(triangles, nodes);
