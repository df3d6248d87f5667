// SPDX-License-Identifier: BSD-3-Clause
#include "support/allocations.hpp"

#include <cstdlib>
#include <new>

namespace {
thread_local long count = 0;
}  // namespace

long allocations() {
  return count;
}

void* operator new(std::size_t size) {
  ++count;
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc{};
}
void operator delete(void* p) noexcept {
  std::free(p);
}
void operator delete(void* p, std::size_t /*size*/) noexcept {
  std::free(p);
}
