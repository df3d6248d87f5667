// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: between_samples is for dual_ledger
//
// Where a force began to be held is known from two samples only, and so never exactly.

#include <passive_haptics/compliant/compositions.hpp>
#include <passive_haptics/energy_observer/quantised_energy.hpp>

namespace ph = passive_haptics;

#ifdef POSITIVE_CONTROL
ph::between_samples<ph::quantised_energy> late{};
#else
ph::between_samples<ph::reduced_energy> late{};
#endif
