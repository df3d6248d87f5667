// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: reachable_work_bound is proved for viscous damping
//
// Dry friction counts into `hand`, what pushes beside the motors; it is no credit here.

#include <passive_haptics/device/dry_friction.hpp>
#include <passive_haptics/force_bound/reachable_bound.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

#ifdef POSITIVE_CONTROL
using damping = ph::isotropic_damping;
#else
using damping = ph::damping_and_friction;
#endif
using state = ph::port_state<scene, ph::part_at<damping, scene>>;
using bound = ph::reachable_work_bound<1>;

float left(const ph::part_at<bound, scene>& at_port, const state& now) {
  return at_port.limit(1, now).factor;
}
