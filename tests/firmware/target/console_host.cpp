// SPDX-License-Identifier: BSD-3-Clause
#include "platform.hpp"

#include <cstdio>

void platform::print(const char* text) {
  std::fputs(text, stdout);
}
std::uint32_t platform::clock() {
  return 0;
}

int main() {
  return program();
}
