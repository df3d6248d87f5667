// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Several bounds, one after the other.
//
//   ph::bound_chain{ph::reachable_bound{…}, ph::actuator_limit{…}}

#include <passive_haptics/port/composing.hpp>

namespace passive_haptics {
inline namespace v0 {

/// First, then the rest. What the chain promises is the best promise among its bounds that nothing
/// behind them can break: a bound that only reduces cannot, because zero force is always safe and
/// the allowed forces of every bound here are a ball around it.
///
/// What may raise a force because of the contact, a rate limit say, is no bound but a shaper, and
/// stands before all of them.
template <class First, class... Rest>
struct bound_chain : detail::sequence<First, Rest...> {
  static_assert(detail::are_bounds<First, Rest...>());
  static constexpr bound_traits traits{
      .needs_ledger = First::traits.needs_ledger || (Rest::traits.needs_ledger || ...),
      .exact_travel =
          assumptions_of<First>().exact_travel || (assumptions_of<Rest>().exact_travel || ...),
      .latency = (std::min)({assumptions_of<First>().latency, assumptions_of<Rest>().latency...}),
      .turns = assumptions_of<First>().turns && (assumptions_of<Rest>().turns && ...),
      .reported_work =
          assumptions_of<First>().reported_work && (assumptions_of<Rest>().reported_work && ...)};

  using detail::sequence<First, Rest...>::sequence;

  template <port P>
  class on;
};
template <class First, class... Rest>
bound_chain(First, Rest...) -> bound_chain<First, Rest...>;

namespace detail {
/// The best promise that no later bound can break, and whether all only reduce.
struct chained {
  guarantee promise = guarantee::none;
  bool reduce = true;
};
template <class P, class... Bounds>
[[nodiscard]] constexpr chained chain_promise() noexcept {
  using state = port_state<P, some_damping<P>>;
  chained sum;
  ((sum = {(std::max)(reduces<Bounds, P, state>() ? sum.promise : guarantee::none,
                      promise_of<Bounds, P>()),
           sum.reduce && reduces<Bounds, P, state>()}),
   ...);
  return sum;
}
}  // namespace detail

template <class First, class... Rest>
template <port P>
class bound_chain<First, Rest...>::on : public detail::sequence<First, Rest...>::template on<P> {
  using parts = typename detail::sequence<First, Rest...>::template on<P>;

 public:
  static constexpr guarantee passivity = detail::chain_promise<P, First, Rest...>().promise;

  constexpr explicit on(const bound_chain& p) noexcept : parts(p) {}

  [[nodiscard]] constexpr typename P::effort limit(const typename P::effort& desired,
                                                   const auto& state) noexcept {
    return this->apply(desired, state).force;
  }
};

}  // namespace v0
}  // namespace passive_haptics
