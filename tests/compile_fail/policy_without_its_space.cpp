// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: deduction (failed|guide)
//
// Only local_model deduces its arguments; a policy is told its space.

#include <passive_haptics/observers.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

#ifdef POSITIVE_CONTROL
ph::reduced_energy<scene> ledger{.damping = 0.03F};
#else
ph::reduced_energy ledger{.damping = 0.03F};
#endif
