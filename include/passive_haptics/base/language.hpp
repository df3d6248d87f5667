// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// All headers need C++20. Every chain of includes begins here, so a compiler set to an older standard prints one
// sentence instead of the thousand errors that would follow.
//
// The sentence is the name of a file that does not exist, because a missing file stops every compiler, while g++
// and clang++ go on after an #error. MSVC has its standard in _MSVC_LANG; its __cplusplus is that of 1998.

#if defined(_MSVC_LANG) ? _MSVC_LANG < 202002L : __cplusplus < 202002L
#include "passive_haptics: C++20 is needed: compile with -std=c++20 or newer, with MSVC /std:c++20"
#endif
