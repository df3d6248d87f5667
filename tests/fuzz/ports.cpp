// SPDX-License-Identifier: BSD-3-Clause
// libFuzzer's door to fuzz::ports: fuzz_ports -max_total_time=600 corpus
#include "fuzz/port_targets.hpp"

#include <cstdio>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (const char* broken = fuzz::ports({data, size})) {
    std::fprintf(stderr, "%s\n", broken);
    std::abort();
  }
  return 0;
}
