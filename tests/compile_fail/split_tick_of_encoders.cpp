// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: this ledger of a late force takes positions as exact
//
// The place where the force changes is not known to a step.

#include <passive_haptics/compliant/compositions.hpp>
#include <passive_haptics/energy_observer/quantised_energy.hpp>

namespace ph = passive_haptics;

#ifdef POSITIVE_CONTROL
ph::split_tick<ph::reduced_energy> late{};
#else
ph::split_tick<ph::quantised_energy> late{};
#endif
