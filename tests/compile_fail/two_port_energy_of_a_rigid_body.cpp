// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: this port turns, and this observer takes every turn for a straight one
//
// A ledger of a port in a channel books τ·θ for the work of the torque.

#include <passive_haptics/contact/given_force.hpp>
#include <passive_haptics/device/rigid_damping.hpp>
#include <passive_haptics/force_bound/strict_bound.hpp>
#include <passive_haptics/port/passive_port.hpp>
#include <passive_haptics/two_port/energy.hpp>

namespace ph = passive_haptics;
using body = ph::rigid_body<float>;

#ifdef POSITIVE_CONTROL
using observer = ph::basic_reduced_energy<ph::rigid_damping>;
#else
using observer = ph::basic_two_port_energy<ph::rigid_damping>;
#endif
ph::passive_port port{body{}, ph::given_force{}, observer{}, ph::strict_bound{}, ph::loop_limits{}};
