// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A chain of bounds, applied in order: each one bounds the effort that the one before it returned.
//
//   ph::bound_chain{ph::reachable_bound{…}, ph::actuator_limit{…}}

#include <passive_haptics/port/composing.hpp>

namespace passive_haptics {
inline namespace v0 {

/// Applies `First`, then the rest. The chain's guarantee is the best among its bounds that no later bound can
/// break. A bound that only reduces the force breaks none, because every bound here allows any shorter force of the
/// same direction; one that turns or lengthens it breaks all before it. (§ 2, Shares and chains)
///
/// What may raise the force because of the contact, as force_rate_limit, is a shaper, and acts before the whole chain.
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
/// The best guarantee that no later bound can break, and whether all bounds only reduce the force.
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
