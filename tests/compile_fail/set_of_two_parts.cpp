// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: set.*more than one part has such parameters
//
// Which of the two limits is meant?

#include <passive_haptics/contact/given_force.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/force_bound/actuator_limit.hpp>
#include <passive_haptics/force_bound/bound_chain.hpp>
#include <passive_haptics/force_bound/strict_bound.hpp>
#include <passive_haptics/port/passive_port.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

#ifdef POSITIVE_CONTROL
using first = ph::strict_bound;
#else
using first = ph::actuator_limit;
#endif
ph::passive_port guard{scene{}, ph::given_force{}, ph::reduced_energy{},
                       ph::bound_chain{first{}, ph::actuator_limit{}}, ph::loop_limits{}};
ph::parameter_fault fault = guard.set(ph::actuator_limit{.most = 6});
