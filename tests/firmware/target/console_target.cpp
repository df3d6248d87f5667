// SPDX-License-Identifier: BSD-3-Clause
// The console is the debugger's, by semihosting. The clock is SysTick: QEMU with -icount shift=10
// gives every instruction 1024 ns, the MPS2 boards tick every 40 ns, so readings are exact to one
// instruction.
#include "cortex_m.hpp"
#include "platform.hpp"

void platform::print(const char* text) {
  cortex_m::semihosting(0x04, text);
}

std::uint32_t platform::clock() {
  if (cortex_m::systick_control == 0) {
    cortex_m::systick_reload = 0xFFFFFF;
    cortex_m::systick_value = 0;
    cortex_m::systick_control = 5;
  }
  return cortex_m::systick_value;
}

std::uint32_t platform::instructions(std::uint32_t before, std::uint32_t after) {
  return (((before - after) & 0xFFFFFFU) * 40 + 512) / 1024;
}
