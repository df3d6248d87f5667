// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the test programs need of the machine they run on: a console, and a clock that counts
// instructions. console_host.cpp and console_target.cpp have them.

#include <cstdint>

/// What a test program does; its result is the exit code.
int program();

namespace platform {

void print(const char* text);

/// Counts down, in units of `per_instruction`; wraps at `range`.
[[nodiscard]] std::uint32_t clock();

/// The instructions between two readings of the clock; 0 on the host.
[[nodiscard]] std::uint32_t instructions(std::uint32_t before, std::uint32_t after);

}  // namespace platform
