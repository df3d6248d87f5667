// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: -ffast-math takes out the checks for NaN and infinity
// FLAGS: -ffinite-math-only
//
// The one part of -ffast-math that turns a refused sample into a force.

#include <passive_haptics/base/kernels.hpp>

static_assert(passive_haptics::kernels::is_finite(1.0F));
