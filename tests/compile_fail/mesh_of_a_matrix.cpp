// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: each node of a mesh has three numbers
//
// A matrix has one number at an index, and no place.

#include <passive_haptics/mesh.hpp>
#include <passive_haptics/passive_haptics.hpp>

#include <array>
#include <vector>

namespace ph = passive_haptics;

#ifdef POSITIVE_CONTROL
struct place {
  double x, y, z;
};
const std::vector<place> nodes(3);
#else
const Eigen::MatrixX3d nodes(3, 3);
#endif
const std::vector<ph::mesh::triangle> triangles{{0, 1, 2}};
ph::mesh::surface organ(triangles, nodes);
bool told = organ.update(nodes);
