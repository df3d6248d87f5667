// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A tuple of parts of different types, as a plain value.

#include <passive_haptics/base/language.hpp>

#include <cstddef>
#include <utility>

namespace passive_haptics {
inline namespace v0 {
namespace detail {

/// A tuple that is trivially copyable if its elements are.
template <std::size_t I, class T>
struct cell {
  T value;
};
template <class Indices, class... T>
struct cells;
template <std::size_t... I, class... T>
struct cells<std::index_sequence<I...>, T...> : cell<I, T>... {};
template <class... T>
using row = cells<std::index_sequence_for<T...>, T...>;

template <std::size_t I, class T>
[[nodiscard]] constexpr T& get(cell<I, T>& of) noexcept {
  return of.value;
}
template <std::size_t I, class T>
[[nodiscard]] constexpr const T& get(const cell<I, T>& of) noexcept {
  return of.value;
}

}  // namespace detail

}  // namespace v0
}  // namespace passive_haptics
