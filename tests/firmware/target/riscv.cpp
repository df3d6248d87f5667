// SPDX-License-Identifier: BSD-3-Clause
// Start-up, console and clock of the test programs on a RISC-V without anything beside them: QEMU's
// board virt, loaded whole into its RAM. The console is the debugger's, by semihosting; the clock is
// the machine timer. A trap prints FAULT and ends with 99.
#include "memory.hpp"
#include "platform.hpp"

#include <cstdint>

namespace {

using word = std::uintptr_t;

/// One request to the debugger, here QEMU; it knows the three instructions by their neighbours.
word semihosting(word request, const void* argument) {
  register word a0 asm("a0") = request;
  register const void* a1 asm("a1") = argument;
  asm volatile(
      ".option push\n.option norvc\n.balign 16\n"
      "slli zero, zero, 0x1f\nebreak\nsrai zero, zero, 7\n.option pop"
      : "+r"(a0)
      : "r"(a1)
      : "memory");
  return a0;
}

[[noreturn]] void leave(int code) {
  const word block[2] = {0x20026U, static_cast<word>(code)};
  semihosting(0x20, block);
  for (;;) {
  }
}

}  // namespace

void platform::print(const char* text) {
  semihosting(0x04, text);
}

std::uint32_t platform::clock() {
  return ~*reinterpret_cast<volatile std::uint32_t*>(0x0200BFF8);  // counts down, like SysTick
}

extern "C" {

[[noreturn, gnu::aligned(4)]] void Fault_Handler() {
  platform::print("FAULT\n");
  leave(99);
}
[[noreturn, gnu::used]] void begin() {
  prepare_memory();
  leave(program());
}
}

// Stack, trap vector, FPU on (mstatus.FS), and on to C++.
asm(".section .vectors, \"ax\"\n.option push\n.option arch, +zicsr\n"
    ".global Reset_Handler\nReset_Handler:\n"
    "la sp, _estack\nla t0, Fault_Handler\ncsrw mtvec, t0\n"
    "li t0, 0x2000\ncsrs mstatus, t0\n"
    "tail begin\n.option pop\n.text\n");
