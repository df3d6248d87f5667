// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The scenes of two and three degrees of freedom; they include what a user would.

#include "scenes.hpp"
#include <passive_haptics/passive_haptics.hpp>

namespace composed {

using plane_strict = ph::local_model<flat, ph::followed<ph::half_space<flat>>, ph::turn_limited,
                                     ph::spring, ph::reduced_energy, ph::strict_bound>;
using plane_reachable =
    ph::local_model<solid, ph::followed<ph::half_space<solid>>, ph::turn_limited, ph::damped_spring,
                    ph::reduced_energy, ph::reachable_bound>;
using triangle_thesis =
    ph::local_model<solid, ph::followed<ph::triangle<solid>>, ph::turn_limited,
                    ph::shaped<ph::spring, ph::thesis_rule>, ph::reduced_energy, ph::no_bound>;

ph::tick_result<flat> plane_strict_tick(plane_strict& model, const flat::vector& x, real dt);
ph::tick_result<solid> plane_reachable_tick(plane_reachable& model, const solid::vector& x,
                                            real dt);
ph::tick_result<solid> triangle_thesis_tick(triangle_thesis& model, const solid::vector& x,
                                            real dt);

}  // namespace composed
