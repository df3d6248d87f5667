// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: this bound is not proved for a port that turns
//
// Six numbers of inertia leave out what a body does to itself while it turns.

#include <passive_haptics/contact/given_force.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/force_bound/reachable_bound.hpp>
#include <passive_haptics/force_bound/rigid_reachable_bound.hpp>
#include <passive_haptics/port/passive_port.hpp>

namespace ph = passive_haptics;
using body = ph::rigid_body<float>;

#ifdef POSITIVE_CONTROL
using bound = ph::rigid_reachable_bound;
#else
using bound = ph::reachable_work_bound<6>;
#endif
using ledger = ph::basic_reduced_energy<ph::rigid_damping>;
ph::passive_port port{body{}, ph::given_force{}, ledger{}, bound{}, ph::loop_limits{}};
