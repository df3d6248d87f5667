// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The version of the library, stated here alone: CMakeLists.txt and conan/conanfile.py read this header.

#include <passive_haptics/base/language.hpp>

namespace passive_haptics {
inline namespace v0 {

inline constexpr int version_major = 0;
inline constexpr int version_minor = 2;
inline constexpr int version_patch = 0;

}  // namespace v0
}  // namespace passive_haptics
