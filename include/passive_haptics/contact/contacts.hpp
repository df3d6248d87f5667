// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Several contacts on one device: one port, one ledger, one bound on the sum of their forces.
//
//     ph::passive_port corner{scene{}, ph::contacts{floor, wall}, ph::reduced_energy{.damping = 0.03},
//                             ph::strict_bound{}, ph::loop_limits{.longest_tick = 0.0011}};
//     corner.source().contact<1>().update(plane);
//
// One port for each contact would spend the same damping twice (docs/design/mathematics.md § 4).

#include <passive_haptics/contact/local_contact.hpp>
#include <passive_haptics/contact/row.hpp>

namespace passive_haptics {
inline namespace v0 {

/// The sum of the forces of its sources. The bound's share s applies to each source alike, so that each local model
/// is at the depth of its own part of the force. There may be any number of sources.
template <class... Sources>
struct contacts {
  detail::row<Sources...> sources{};

  constexpr contacts() noexcept = default;
  constexpr explicit contacts(const Sources&... all) noexcept : sources{{all}...} {}

  template <port Space>
  class on;
};

template <class... Sources>
template <port Space>
class contacts<Sources...>::on {
  using all = std::index_sequence_for<Sources...>;

 public:
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  using result_type = tick_result<Space>;
  static constexpr bool asks_for_numbers = false;  // a sum may overflow
  static constexpr bool needs_ledger = (detail::spends_ledger<part_at<Sources, Space>>() || ...);
  static_assert((source_for<Sources, Space> && ...),
                "passive_haptics: the source does not model source_for: see port/concepts.hpp");

  constexpr explicit on(const contacts& p) noexcept : on(p, all{}) {}

  /// The I-th source, to update or to release.
  template <std::size_t I>
  [[nodiscard]] constexpr auto& contact() noexcept {
    return detail::get<I>(sources_);
  }
  template <std::size_t I>
  [[nodiscard]] constexpr const auto& contact() const noexcept {
    return detail::get<I>(sources_);
  }

  /// A new effort for the one source that takes efforts; port.tick(sample, wanted) passes it.
  constexpr bool update(const vector& wanted) noexcept
      requires((int(detail::takes_efforts<part_at<Sources, Space>, Space>) + ...) == 1) {
    for_each(*this, [&](auto& source) {
      if constexpr (requires { source.update(wanted); }) source.update(wanted);
    });
    return Space::is_finite(wanted);
  }

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    parameter_fault first;
    for_each(*this, [&first](const auto& source) {
      if (!first) first = detail::fault_in(source);
    });
    return first;
  }
  constexpr void adopt(scalar longest_tick, int late) noexcept {
    for_each(*this, [=](auto& source) { detail::tell(source, longest_tick, late); });
  }
  constexpr void reset() noexcept {
    for_each(*this, [](auto& source) { detail::restart(source); });
  }

  /// Explains the source that presses most, or the first one, for a device at x.
  constexpr void explain(explanation& e, const vector& x, scalar T, int late) const noexcept {
    detail::explain(contact<0>(), e, x, T, late);
    for_each(*this, [&](const auto& source) {
      explanation own;
      own.force = e.force;
      detail::explain(source, own, x, T, late);
      if (own.depth > 0.0 && own.shown * own.depth > e.shown * e.depth) e = own;
    });
  }

  template <class Parameters>
  static constexpr int takers = (detail::takers<Parameters, Sources, Space> + ... + 0);
  template <class Parameters>
  constexpr void take(const Parameters& p) noexcept {
    hand_over(p, all{});
  }

  struct request {
    vector wanted;  ///< the sum [N]
    bool nothing = true;
    detail::row<typename part_at<Sources, Space>::request...> each;
  };
  template <bool Shortcut>
  [[nodiscard]] constexpr request ask(const auto& motion, const auto& port, event& what) noexcept {
    return asked<Shortcut>(motion, port, what, all{});
  }
  [[nodiscard]] constexpr result_type answered(const request& r,
                                               const port_result<Space>& port) noexcept {
    return shared_out(r, port, all{});
  }
  constexpr result_type refused(const port_result<Space>& port, scalar dt) noexcept {
    for_each(*this, [&](auto& source) { static_cast<void>(source.refused(port, dt)); });
    return {port.force, scalar(0), port.energy, port.what, false};
  }

 private:
  template <std::size_t... I>
  constexpr on(const contacts& p, std::index_sequence<I...>) noexcept
      : sources_{{part_at<Sources, Space>(detail::get<I>(p.sources))}...} {}

  template <class Parameters, std::size_t... I>
  constexpr void hand_over(const Parameters& p, std::index_sequence<I...>) noexcept {
    const auto one = [&p]<class Source>(part_at<Source, Space>& part) {
      if constexpr (detail::takers<Parameters, Source, Space> == 1) {
        detail::take<Source, Space>(part, p);
      }
    };
    (one.template operator()<Sources>(detail::get<I>(sources_)), ...);
  }
  template <class Self, class Act, std::size_t... I>
  static constexpr void visit(Self& self, Act act, std::index_sequence<I...>) noexcept {
    (act(detail::get<I>(self.sources_)), ...);
  }
  template <class Self, class Act>
  static constexpr void for_each(Self& self, Act act) noexcept {
    visit(self, act, all{});
  }

  /// The desired force of one source [N], or zero.
  [[nodiscard]] static constexpr vector wanted_by(const auto& one) noexcept {
    return one.nothing ? Space::zero() : vector(one.wanted);
  }

  template <bool Shortcut, std::size_t... I>
  [[nodiscard]] constexpr request asked(const auto& motion, const auto& port, event& what,
                                        std::index_sequence<I...>) noexcept {
    request r{Space::zero(),
              true,
              {{detail::get<I>(sources_).template ask<Shortcut>(motion, port, what)}...}};
    ((r.wanted = vector(r.wanted + wanted_by(detail::get<I>(r.each))),
      r.nothing = r.nothing && detail::get<I>(r.each).nothing),
     ...);
    return r;
  }

  template <std::size_t... I>
  [[nodiscard]] constexpr result_type shared_out(const request& r, const port_result<Space>& port,
                                                 std::index_sequence<I...>) noexcept {
    scalar left(1);
    if (port.limited) {
      const scalar square = Space::dot(r.wanted, r.wanted);
      left = square > scalar(0) ? Space::dot(port.force, r.wanted) / square : scalar(0);
      left = kernels::clamped(left, scalar(0), scalar(1));
    }
    result_type sum{port.force, scalar(0), port.energy, port.what, port.limited};
    const auto answer = [&](auto& source, const auto& one) {
      const vector own = wanted_by(one);
      const bool cut = port.limited && !(own == Space::zero());  // a zero force is not cut
      const port_result<Space> part{cut ? vector(own * left) : own, port.energy, port.what, cut};
      const auto result = source.answered(one, part);
      sum.limited = sum.limited || result.limited;
      sum.what = worse(sum.what, result.what);
      if constexpr (detail::says_depth<decltype(result)>) {
        sum.depth = kernels::larger(sum.depth, result.depth);
      }
    };
    (answer(detail::get<I>(sources_), detail::get<I>(r.each)), ...);
    return sum;
  }

  detail::row<part_at<Sources, Space>...> sources_;
};

}  // namespace v0
}  // namespace passive_haptics
