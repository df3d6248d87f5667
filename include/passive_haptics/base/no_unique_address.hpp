// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS in front of a member lets an empty type take no bytes.
//
// It is the library's only macro, because an attribute cannot be named otherwise. Under Microsoft's ABI the
// standard attribute has no effect, and an empty member would cost four or eight bytes; there the compiler has
// an attribute of its own. No result depends on it, only sizeof does.

#include <passive_haptics/base/language.hpp>

#if __has_cpp_attribute(msvc::no_unique_address)
#define PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS [[msvc::no_unique_address]]
#else
#define PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS [[no_unique_address]]
#endif
