// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: this bound is not proved for a port that turns
//
// A ledger for each axis does not see that a torque across a turn may do work.

#include <passive_haptics/contact/given_force.hpp>
#include <passive_haptics/device/rigid_damping.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/force_bound/strict_bound.hpp>
#include <passive_haptics/port/passive_port.hpp>

namespace ph = passive_haptics;
using body = ph::rigid_body<float>;

#ifdef POSITIVE_CONTROL
using bound = ph::memoryless_bound;
#else
using bound = ph::per_axis_bound;
#endif
using ledger = ph::basic_reduced_energy<ph::rigid_damping>;
ph::passive_port port{body{}, ph::given_force{}, ledger{}, bound{}, ph::loop_limits{}};
