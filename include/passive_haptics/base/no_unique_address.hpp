// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS in front of a member: if its type holds nothing, it takes no room.
//
// The library's one macro, because an attribute has no other name. Under Microsoft's ABI the standard
// spelling is a word without effect, so an empty part would cost four bytes or eight; there the compiler
// has a spelling of its own, and says so. No result depends on it, only sizeof does.

#include <passive_haptics/base/language.hpp>

#if __has_cpp_attribute(msvc::no_unique_address)
#define PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS [[msvc::no_unique_address]]
#else
#define PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS [[no_unique_address]]
#endif
