// SPDX-License-Identifier: BSD-3-Clause
// Start-up: FPU on, data copied, bss cleared. No constructors run: nothing here needs any.
#include "board.hpp"

int run();

extern "C" {
extern std::uint32_t _estack, _sidata, _sdata, _edata, _sbss, _ebss;
[[noreturn]] void Fault_Handler();
void SysTick_Handler();

[[noreturn]] void Reset_Handler() {
  board::at(0xE000ED88) = board::at(0xE000ED88) | (0xFU << 20);
  asm volatile("dsb; isb");
  for (std::uint32_t *to = &_sdata, *from = &_sidata; to < &_edata;) *to++ = *from++;
  for (std::uint32_t* to = &_sbss; to < &_ebss;) *to++ = 0;
  board::stop(run());
}

using handler = void (*)();
[[gnu::section(".vectors"), gnu::used]] const handler vectors[] = {
    reinterpret_cast<handler>(&_estack),
    &Reset_Handler,
    &Fault_Handler,
    &Fault_Handler,
    &Fault_Handler,
    &Fault_Handler,
    &Fault_Handler,
    nullptr,
    nullptr,
    nullptr,
    nullptr,
    &Fault_Handler,
    &Fault_Handler,
    nullptr,
    &Fault_Handler,
    &SysTick_Handler};
}
