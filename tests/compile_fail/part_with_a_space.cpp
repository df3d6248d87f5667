// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: is not a template|expected unqualified-id
//
// A part is told its space by the port that it is composed into.

#include <passive_haptics/energy_observer/reduced_energy.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

#ifdef POSITIVE_CONTROL
ph::reduced_energy ledger{.damping = 0.03};
#else
ph::reduced_energy<scene> ledger{.damping = 0.03};
#endif
