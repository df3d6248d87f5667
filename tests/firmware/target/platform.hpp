// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the test programs need of the machine they run on: a console, and a clock that counts
// instructions. console_host.cpp, console_target.cpp and riscv.cpp have them.

#include <cstdint>

/// What a test program does; its result is the exit code.
int program();

namespace platform {

void print(const char* text);

/// Counts down from 0xFFFFFF, FIRMWARE_MHZ million times a second, and starts again; 0 on the host. QEMU
/// with -icount shift=10 gives every instruction 1024 ns, and the slowest of the clocks counts every
/// 100 ns, so two readings tell the instructions between them exactly.
[[nodiscard]] std::uint32_t clock();

[[nodiscard]] constexpr std::uint32_t instructions(std::uint32_t before, std::uint32_t after) {
  return (((before - after) & 0xFFFFFFU) * 125 / FIRMWARE_MHZ + 64) / 128;
}
/// How far the clock counts while so many instructions run.
[[nodiscard]] constexpr std::uint32_t readings(std::uint32_t instructions) {
  return instructions * 128 / 125 * FIRMWARE_MHZ;
}

}  // namespace platform
