// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// For a module whose meshes are sound, so that nothing throws; a page could not catch it. Included by its one source.

#ifdef __wasm__
extern "C" {
void* __cxa_allocate_exception(unsigned long /*size*/) noexcept {
  __builtin_trap();
}
void __cxa_throw(void* /*thrown*/, void* /*type*/, void* /*destroy*/) {
  __builtin_trap();
}
}
#endif
