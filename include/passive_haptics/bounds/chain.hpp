// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Several bounds, one after the other.

#include <passive_haptics/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

/// First, then the rest. What the chain promises is the best promise among its bounds that nothing
/// behind them can break: a bound that only reduces cannot, because zero force is always safe and
/// the allowed forces of every bound here are a ball around it.
template <class First, class... Rest>
struct bound_chain {
  using rest_type = bound_chain<Rest...>;
  static constexpr guarantee passivity = std::max(
      rest_type::traits.only_reduces ? First::passivity : guarantee::none, rest_type::passivity);
  static constexpr bound_traits traits = First::traits + rest_type::traits;

  First first;
  rest_type rest;

  constexpr bound_chain() noexcept = default;
  constexpr explicit bound_chain(const First& one, const Rest&... others) noexcept
      : first(one), rest(others...) {}

  template <class Vector>
  [[nodiscard]] constexpr Vector limit(const Vector& desired, const auto& state) noexcept {
    return rest.limit(first.limit(desired, state), state);
  }
  [[nodiscard]] constexpr auto check() const noexcept {
    const auto fault = first.check();
    return fault ? fault : rest.check();
  }
};

template <class Only>
struct bound_chain<Only> : Only {
  constexpr bound_chain() noexcept = default;
  constexpr explicit bound_chain(const Only& one) noexcept : Only(one) {}
};

}  // namespace v0
}  // namespace passive_haptics
