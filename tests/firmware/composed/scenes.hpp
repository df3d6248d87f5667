// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The five scenes of the firmware report, composed. By hand they are in by_hand/.
//
//   wall_strict      1   a fixed wall          spring          strict_bound
//   wall_reachable   1   a moving wall         damped spring   reachable_bound
//   plane_strict     2   a moving half-space   spring          strict_bound      normals turn slowly
//   plane_reachable  3   a moving half-space   damped spring   reachable_bound   normals turn slowly
//   triangle_thesis  3   a moving triangle     spring          thesis_bound      normals turn slowly

#include "../by_hand/common.h"
#include <passive_haptics/bounds/force_bounding.hpp>
#include <passive_haptics/bounds/reachable.hpp>
#include <passive_haptics/bounds/thesis.hpp>
#include <passive_haptics/contact.hpp>
#include <passive_haptics/geometry.hpp>
#include <passive_haptics/local_model.hpp>
#include <passive_haptics/normals.hpp>
#include <passive_haptics/observers.hpp>
#include <passive_haptics/supply.hpp>

namespace composed {

namespace ph = passive_haptics;

using line = ph::space<real, 1>;
using flat = ph::space<real, 2>;
using solid = ph::space<real, 3>;

using wall_strict =
    ph::local_model<line, ph::rigid<ph::half_space<line>>, ph::snap<line>, ph::spring<line>,
                    ph::reduced_energy<line>, ph::strict_bound<line>>;
using wall_reachable =
    ph::local_model<line, ph::following<ph::half_space<line>>, ph::snap<line>,
                    ph::damped_spring<line>, ph::reduced_energy<line>, ph::reachable_bound<line>>;

// One tick of each, in a file of its own, so that its bytes can be counted.
ph::tick_result<line> wall_strict_tick(wall_strict& model, real x, real dt);
ph::tick_result<line> wall_reachable_tick(wall_reachable& model, real x, real dt);

}  // namespace composed
