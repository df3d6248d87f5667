// SPDX-License-Identifier: BSD-3-Clause
// libFuzzer's door to fuzz::remote_ends: fuzz_remote -max_total_time=30
#include "fuzz/remote_targets.hpp"

#include <cstdio>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (const char* broken = fuzz::remote_ends({data, size})) {
    std::puts(broken);
    std::abort();
  }
  return 0;
}
