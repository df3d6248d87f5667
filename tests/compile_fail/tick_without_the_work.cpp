// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: this port reports the work of its motors: tick with a device_sample
//
// A position and a time say nothing of the work.

#include <passive_haptics/contact/given_force.hpp>
#include <passive_haptics/energy_observer/dual_ledger.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/force_bound/strict_bound.hpp>
#include <passive_haptics/port/passive_port.hpp>
#include <passive_haptics/port/reported_work.hpp>

namespace ph = passive_haptics;
using device = ph::reported_work<ph::space<float, 1>>;

ph::passive_port port{device{}, ph::given_force{}, ph::reduced_energy{}, ph::strict_bound{},
                      ph::loop_limits{}};
#ifdef POSITIVE_CONTROL
const auto result = port.tick({.position = 0.0F, .held = 0.0F, .dt = 1e-3F, .valid = true});
#else
const auto result = port.tick(0.0F, ph::seconds{1e-3});
#endif
