// SPDX-License-Identifier: BSD-3-Clause
// libFuzzer's door to fuzz::files: fuzz_files -max_total_time=600 corpus
#include "fuzz/file_targets.hpp"

#include <cstdio>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (const char* broken = fuzz::files({data, size})) {
    std::fprintf(stderr, "%s\n", broken);
    std::abort();
  }
  return 0;
}
