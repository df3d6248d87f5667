// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: reachable_work_bound is proved for viscous damping
//
// Dry friction counts into `hand`, what pushes beside the motors; it is no credit here.

#include <passive_haptics/contact/given_force.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/force_bound/reachable_bound.hpp>
#include <passive_haptics/passive_port.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

#ifdef POSITIVE_CONTROL
using damping = ph::isotropic_damping;
#else
using damping = ph::damping_and_friction;
#endif
using ledger = ph::basic_reduced_energy<damping>;

ph::passive_port guard{scene{}, ph::given_force{}, ledger{}, ph::reachable_work_bound<1>{},
                       ph::loop_limits{}};
float force = guard.tick(0, 0.001F, 1).force;
