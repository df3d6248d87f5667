// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What is still to come in a loop that is k ticks late: the commands on their way, h(1) … h(k), each held
// in one of the next k ticks, and then the effort that is asked for now, in tick k + 1. An effort f can
// reach, in the first of these ticks and in the one after the j-th,
//
//     ρ(1) = now(f, h(1))        ρ(j+1) = ρ(j) + later(h(j), h(j+1))         (L6, § 2(a′), § 3)
//
// and what is left of a credit [J] for it is E1 less what those on their way can hand out meanwhile,
//
//     E1 − Σ handed_out(h(j), ρ(j))                                          rounded down
//
// How an effort is measured is the bound's own: its norm in newtons and its reach in metres, or its norm
// in √J/s and its reach in joules.

#include <passive_haptics/base/kernels.hpp>

#include <cstddef>

namespace passive_haptics {
inline namespace v0 {
namespace detail {

/// A `Measure` has norm(f), now(f, norm, held, state), later(norm, before, held, state), where `before` and
/// `held` are the norms of what is held in a tick and in the one after it, and handed_out(f, norm, reach,
/// state) [J].
template <class Measure, class State>
class commands_on_their_way {
 public:
  using scalar = typename State::scalar;
  using effort = typename State::effort;

  constexpr commands_on_their_way(const Measure& by, const State& state) noexcept
      : by_(by), state_(state) {}

  /// What they leave of a credit [J].
  [[nodiscard]] constexpr scalar left_of(scalar credit) const noexcept {
    if constexpr (State::latency > 0) promise<1>(credit);
    return credit;
  }
  /// How far an effort of that norm can reach in the tick in which it will be held.
  [[nodiscard]] constexpr scalar reach(const effort& f, scalar norm) const noexcept {
    return reach<State::latency + 1>(f, norm, norm);
  }

 private:
  /// The command that is held in the J-th coming tick.
  template <int J>
  [[nodiscard]] constexpr effort coming() const noexcept {
    return state_.commanded[static_cast<std::size_t>(State::latency - J)];
  }
  template <int J>
  constexpr void promise(scalar& credit) const noexcept {
    const effort h = coming<J>();
    const scalar norm = by_.norm(h);
    if (norm > scalar(0)) {
      credit -= by_.handed_out(h, norm, reach<J>(h, norm, norm), state_) *
                (scalar(1) + kernels::rounding<scalar>());
    }
    if constexpr (J < State::latency) promise<J + 1>(credit);
  }
  /// ρ(J) of an effort of that norm; `held` is the norm of what is held in tick J.
  template <int J>
  [[nodiscard]] constexpr scalar reach(const effort& f, scalar norm, scalar held) const noexcept {
    if constexpr (J == 1) {
      return by_.now(f, norm, held, state_);
    } else {
      const scalar before = by_.norm(coming<J - 1>());
      return reach<J - 1>(f, norm, before) + by_.later(norm, before, held, state_);
    }
  }

  const Measure& by_;
  const State& state_;
};

}  // namespace detail
}  // namespace v0
}  // namespace passive_haptics
