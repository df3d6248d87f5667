// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: a mesh is touched in a space of three dimensions
//
// A mesh is made of triangles; in two dimensions a boundary is made of segments.

#include <passive_haptics/mesh.hpp>
#include <passive_haptics/passive_haptics.hpp>

namespace ph = passive_haptics;

#ifdef POSITIVE_CONTROL
constexpr int dof = 3;
#else
constexpr int dof = 2;
#endif
using scene = ph::space<double, dof>;
ph::passive_port touch{scene{}, ph::mesh_contact{}, ph::reduced_energy{.damping = 0.03},
                       ph::strict_bound{}, ph::loop_limits{}};
