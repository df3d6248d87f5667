// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: a set of contacts has slots
//
// How many surfaces there may be is part of the type, so a tick allocates nothing.

#include <passive_haptics/passive_haptics.hpp>

namespace ph = passive_haptics;
using scene = ph::space<double, 3>;
using plane = ph::half_space<scene>;
#ifdef POSITIVE_CONTROL
auto corner = ph::make_contacts<scene>(ph::exact_device{}, ph::known_hand{}, ph::slots<plane, 3>{});
#else
auto corner = ph::make_contacts<scene>(ph::exact_device{}, ph::known_hand{});
#endif
