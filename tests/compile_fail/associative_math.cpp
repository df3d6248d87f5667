// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: -fassociative-math, a part of -ffast-math, sums in any order
// FLAGS: -fassociative-math -fno-signed-zeros -fno-trapping-math
// ONLY: GNU
//
// Sums in any order round bounds in any direction. clang++ does not tell.

#include <passive_haptics/base/kernels.hpp>

static_assert(passive_haptics::kernels::is_finite(1.0F));
