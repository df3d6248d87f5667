// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: this port reports the work of its motors, and this observer does not
//
// A ledger for encoders sums up f·Δx̂ by parts, and has no place for work that is known.

#include <passive_haptics/contact/given_force.hpp>
#include <passive_haptics/energy_observer/dual_ledger.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/force_bound/strict_bound.hpp>
#include <passive_haptics/port/passive_port.hpp>
#include <passive_haptics/port/reported_work.hpp>

namespace ph = passive_haptics;
using device = ph::reported_work<ph::space<float, 1>>;

#ifdef POSITIVE_CONTROL
using observer = ph::reduced_energy;
#else
using observer = ph::dual_ledger;
#endif
ph::passive_port port{device{}, ph::given_force{}, observer{}, ph::strict_bound{},
                      ph::loop_limits{}};
