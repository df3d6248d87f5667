// SPDX-License-Identifier: BSD-3-Clause
// The control of faults.cpp: a fault of the core does end the program, loudly.
#include "../target/platform.hpp"

int program() {
  platform::print("about to fault\n");
  asm volatile("udf #0");
  platform::print("still here\n");
  return 0;
}
