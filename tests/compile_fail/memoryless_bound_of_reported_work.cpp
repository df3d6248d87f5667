// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: this port reports the work of its motors, and this bound takes it from
//
// The bound spends what the last tick brought, and takes f·Δx for the work in it.

#include <passive_haptics/contact/given_force.hpp>
#include <passive_haptics/energy_observer/dual_ledger.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/force_bound/strict_bound.hpp>
#include <passive_haptics/port/passive_port.hpp>
#include <passive_haptics/port/reported_work.hpp>

namespace ph = passive_haptics;
using device = ph::reported_work<ph::space<float, 1>>;

#ifdef POSITIVE_CONTROL
using bound = ph::strict_bound;
#else
using bound = ph::memoryless_bound;
#endif
ph::passive_port port{device{}, ph::given_force{}, ph::reduced_energy{}, bound{},
                      ph::loop_limits{}};
