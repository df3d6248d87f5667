// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: a chain has one to four masses
//
// Ten positions of an encoder do not show what five masses do.

#include <passive_haptics/compliant/compositions.hpp>

namespace ph = passive_haptics;

#ifdef POSITIVE_CONTROL
ph::chain<4> device{};
#else
ph::chain<5> device{};
#endif
