// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The six scenes of the firmware report, composed. By hand they are in bench/by_hand.
//
//   wall_trusted     1   a fixed wall          spring          strict_bound      every sample trusted
//   wall_strict      1   a fixed wall          spring          strict_bound
//   wall_reachable   1   a moving wall         damped spring   reachable_bound
//   plane_strict     2   a moving half-space   spring          strict_bound      normals turn slowly
//   plane_reachable  3   a moving half-space   damped spring   reachable_bound   normals turn slowly
//   triangle_thesis  3   a moving triangle     spring          thesis_rule       normals turn slowly

#include <passive_haptics/firmware.hpp>

namespace composed {

namespace ph = passive_haptics;

#ifdef FIRMWARE_DOUBLE
using real = double;
#else
using real = float;
#endif
using line = ph::space<real, 1>;
using flat = ph::space<real, 2>;
using solid = ph::space<real, 3>;

using wall_trusted =
    ph::local_model<line, ph::fixed<ph::half_space<line>>, ph::turn_at_once, ph::spring,
                    ph::reduced_energy, ph::strict_bound, ph::trusted_loop_limits<>>;
using wall_strict = ph::local_model<line, ph::fixed<ph::half_space<line>>, ph::turn_at_once,
                                    ph::spring, ph::reduced_energy, ph::strict_bound>;
using wall_reachable = ph::local_model<line, ph::followed<ph::half_space<line>>, ph::turn_at_once,
                                       ph::damped_spring, ph::reduced_energy, ph::reachable_bound>;

// One tick of each, in a file of its own, so that its bytes can be counted.
ph::tick_result<line> wall_trusted_tick(wall_trusted& model, real x, real dt);
ph::tick_result<line> wall_strict_tick(wall_strict& model, real x, real dt);
ph::tick_result<line> wall_reachable_tick(wall_reachable& model, real x, real dt);

}  // namespace composed
