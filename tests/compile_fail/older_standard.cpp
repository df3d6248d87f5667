// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: C..20 is needed: compile with -std=c..20 or newer, with MSVC /std:c..20
// FLAGS: -std=c++17
//
// Said before anything else: tests/compile_fail/one_sentence.cmake includes every header first.

#include <passive_haptics/passive_haptics.hpp>

static_assert(passive_haptics::version_major >= 0);
