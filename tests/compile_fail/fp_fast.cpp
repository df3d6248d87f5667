// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: /fp:fast takes out the checks for NaN and infinity
// FLAGS: -D_M_FP_FAST=1
//
// MSVC's -ffast-math. The macro is what it defines then, and is all that this test has of it.

#include <passive_haptics/base/kernels.hpp>

static_assert(passive_haptics::kernels::is_finite(1.0F));
