// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: this bound is not proved for a loop that is so late
//
// Two ticks late, nobody has shown how far a handle may turn meanwhile.

#include <passive_haptics/contact/given_force.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/force_bound/rigid_reachable_bound.hpp>
#include <passive_haptics/port/passive_port.hpp>

namespace ph = passive_haptics;
using body = ph::rigid_body<float>;

#ifdef POSITIVE_CONTROL
using loop = ph::late_loop_limits<1>;
#else
using loop = ph::late_loop_limits<2>;
#endif
using ledger = ph::basic_reduced_energy<ph::rigid_damping>;
ph::passive_port port{body{}, ph::given_force{}, ledger{}, ph::rigid_reachable_bound{}, loop{}};
