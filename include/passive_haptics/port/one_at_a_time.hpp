// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Finds two threads that call one port at the same time, in debug builds; with NDEBUG it does nothing.

#include <passive_haptics/base/language.hpp>

#include <cstdint>
#ifndef NDEBUG
#include <atomic>
#include <cassert>
#endif

namespace passive_haptics {
inline namespace v0 {
namespace detail {

/// Lives as long as a call of a port: tick, set, reset, update, release. A second call meanwhile fails an assertion,
/// because both calls change the same state.
///
/// `busy` is a byte of padding in every build, so that a port has the same layout with and without NDEBUG. A core
/// without an atomic swap of a byte is not checked.
struct one_at_a_time {
#if !defined(NDEBUG) && defined(__cpp_lib_atomic_ref)
  constexpr explicit one_at_a_time(std::uint8_t& mark) noexcept : busy(mark) {
    [[maybe_unused]] const bool alone = swapped(1) == 0;
    assert(alone && "two threads call one port at once: passive_haptics, docs/guarantees.md");
  }
  constexpr ~one_at_a_time() {
    swapped(0);
  }
  constexpr std::uint8_t swapped(std::uint8_t next) noexcept {
    if constexpr (std::atomic_ref<std::uint8_t>::is_always_lock_free) {
      if (!std::is_constant_evaluated()) return std::atomic_ref(busy).exchange(next);
    }
    return 0;
  }
  std::uint8_t& busy;
#else
  constexpr explicit one_at_a_time(std::uint8_t& /*busy*/) noexcept {}
#endif
};

}  // namespace detail
}  // namespace v0
}  // namespace passive_haptics
