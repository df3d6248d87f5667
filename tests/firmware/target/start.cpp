// SPDX-License-Identifier: BSD-3-Clause
// Start-up for the test programs: FPU on, data copied, bss cleared, program(), its result to the
// debugger. A fault prints FAULT and ends with 99.
#include "cortex_m.hpp"
#include "memory.hpp"
#include "platform.hpp"

#include <cstdint>

extern "C" {

extern std::uint32_t _estack;

// Replaced by the programs that use it.
[[gnu::weak]] void SysTick_Handler() {}

[[noreturn]] void Reset_Handler();
[[noreturn]] void Fault_Handler();

void Reset_Handler() {
#ifdef __ARM_FP
  cortex_m::coprocessor_access = cortex_m::coprocessor_access | (0xFU << 20);
  asm volatile("dsb; isb");
#endif
  prepare_memory();
  cortex_m::leave(program());
}

void Fault_Handler() {
  cortex_m::semihosting(0x04, "FAULT\n");
  cortex_m::leave(99);
}

[[gnu::section(".vectors"), gnu::used]] void* const vectors[] = {
    &_estack,
    reinterpret_cast<void*>(&Reset_Handler),
    reinterpret_cast<void*>(&Fault_Handler),
    reinterpret_cast<void*>(&Fault_Handler),
    reinterpret_cast<void*>(&Fault_Handler),
    reinterpret_cast<void*>(&Fault_Handler),
    reinterpret_cast<void*>(&Fault_Handler),
    nullptr,
    nullptr,
    nullptr,
    nullptr,
    reinterpret_cast<void*>(&Fault_Handler),
    reinterpret_cast<void*>(&Fault_Handler),
    nullptr,
    reinterpret_cast<void*>(&Fault_Handler),
    reinterpret_cast<void*>(&SysTick_Handler)};
}
