// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: this port turns, and a turn may do other work than its ends show
//
// A damping for six joints knows nothing of the path between two orientations.

#include <passive_haptics/device/rigid_damping.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>

namespace ph = passive_haptics;
using body = ph::rigid_body<float>;

#ifdef POSITIVE_CONTROL
using damping = ph::rigid_damping;
#else
using damping = ph::diagonal_damping<6>;
#endif
ph::part_at<ph::basic_reduced_energy<damping>, body> ledger({});
