// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The scenes of two and three degrees of freedom.

#include "scenes.hpp"
#include <passive_haptics/eigen_space.hpp>

namespace composed {

using plane_strict =
    ph::local_model<flat, ph::following<ph::half_space<flat>>, ph::rotate_limited<flat>,
                    ph::spring<flat>, ph::reduced_energy<flat>, ph::strict_bound<flat>>;
using plane_reachable = ph::local_model<solid, ph::following<ph::half_space<solid>>,
                                        ph::rotate_limited<solid>, ph::damped_spring<solid>,
                                        ph::reduced_energy<solid>, ph::reachable_bound<solid>>;
using triangle_thesis =
    ph::local_model<solid, ph::following<ph::triangle<solid>>, ph::rotate_limited<solid>,
                    ph::spring<solid>, ph::reduced_energy<solid>, ph::thesis_bound<solid>>;

ph::tick_result<flat> plane_strict_tick(plane_strict& model, const flat::vector& x, real dt);
ph::tick_result<solid> plane_reachable_tick(plane_reachable& model, const solid::vector& x,
                                            real dt);
ph::tick_result<solid> triangle_thesis_tick(triangle_thesis& model, const solid::vector& x,
                                            real dt);

}  // namespace composed
