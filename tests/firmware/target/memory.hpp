// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What stands between a reset and C++: data copied to where the linker has put it, bss cleared.

#include <cstdint>

extern "C" std::uint32_t _sidata, _sdata, _edata, _sbss, _ebss;

inline void prepare_memory() {
  const std::uint32_t* from = &_sidata;
  for (std::uint32_t* to = &_sdata; to < &_edata;) *to++ = *from++;
  for (std::uint32_t* to = &_sbss; to < &_ebss;) *to++ = 0;
}
