// SPDX-License-Identifier: BSD-3-Clause
// The console is the debugger's, by semihosting. The clock is SysTick.
#include "cortex_m.hpp"
#include "platform.hpp"

void platform::print(const char* text) {
  cortex_m::semihosting(0x04, text);
}

std::uint32_t platform::clock() {
  if ((cortex_m::systick_control & 1) ==
      0) {  // is it off? some boards have bits that are always one
    cortex_m::systick_reload = 0xFFFFFF;
    cortex_m::systick_value = 0;
    cortex_m::systick_control = 5;
  }
  return cortex_m::systick_value;
}
