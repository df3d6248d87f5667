// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: reduced_energy takes what friction holds back elastically for spent
//
// dual_ledger credits friction, on exact positions with a quantum of zero.

#include <passive_haptics/energy_observer/dual_ledger.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

#ifdef POSITIVE_CONTROL
using ledger = ph::basic_dual_ledger<ph::damping_and_friction>;
#else
using ledger = ph::basic_reduced_energy<ph::damping_and_friction>;
#endif
ph::part_at<ledger, scene> at_port(ledger{});
