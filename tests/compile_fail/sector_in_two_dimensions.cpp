// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: sector_bound: its proof is for one degree of freedom
//
// A slope needs motion along the force.

#include <passive_haptics/device/eigen_space.hpp>
#include <passive_haptics/published/sector_bound.hpp>

namespace ph = passive_haptics;

#ifdef POSITIVE_CONTROL
constexpr int dof = 1;
#else
constexpr int dof = 2;
#endif
ph::part_at<ph::sector_bound, ph::space<float, dof>> slope(ph::sector_bound{});
