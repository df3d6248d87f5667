// SPDX-License-Identifier: BSD-3-Clause
// libFuzzer's door to fuzz::boot: fuzz_boot -max_total_time=30
#include "fuzz/targets.hpp"

#include <cstdio>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (const char* broken = fuzz::boot({data, size})) {
    std::puts(broken);
    std::abort();
  }
  return 0;
}
