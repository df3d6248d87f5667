// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: -ffast-math takes out the checks for NaN and infinity
// FLAGS: -ffast-math
//
// Whatever part of the library is included, the equations come with it, and they refuse.

#include <passive_haptics/base/kernels.hpp>

static_assert(passive_haptics::kernels::is_finite(1.0F));
