// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The composition of parts: bounds and shapers act on an effort in order, and parts take parameters between ticks.

#include <passive_haptics/base/no_unique_address.hpp>
#include <passive_haptics/port/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace detail {

/// Satisfied by a part that returns its parameters.
template <class Part>
concept has_parameters = requires(const Part part) {
  part.parameters();
};
/// Satisfied by a part that takes new parameters and keeps its state.
template <class Part, class Parameters>
concept takes_in_place = requires(Part part, const Parameters& p) {
  part.set(p);
};
/// Satisfied by a shaper, which states needs_local_model; a bound does not.
template <class Part>
concept speaks_of_local_model = requires {
  { Part::needs_local_model } -> std::convertible_to<bool>;
};

/// True if a source or a law spends energy of the ledger.
template <class Part>
[[nodiscard]] constexpr bool spends_ledger() noexcept {
  if constexpr (requires { Part::needs_ledger; }) return Part::needs_ledger;
  return false;
}

/// Lets a source recompute the numbers that depend on T [s], the latency or a parameter.
template <class Source, class Scalar>
constexpr void tell(Source& source, Scalar longest_tick, int late) noexcept {
  if constexpr (requires { source.adopt(longest_tick, late); }) {
    source.adopt(longest_tick, late);
  } else if constexpr (requires { source.adopt(longest_tick); }) {
    source.adopt(longest_tick);
  }
}

/// Sets a contact law for a stiffness K [N/m], ticks of T [s] and a latency of `late` ticks.
template <class Law, class Scalar>
constexpr void tell(Law& law, Scalar K, Scalar T, int late) noexcept {
  if constexpr (requires { law.adopt(K, T, late); }) return law.adopt(K, T, late);
  law.adopt(K, T);
}

/// True if an observer books the possible error of the work of a turn.
template <class Observer>
[[nodiscard]] constexpr bool books_turns() noexcept {
  if constexpr (requires { Observer::turns; }) return Observer::turns;
  return false;
}
/// Satisfied by an observer that books the work that a device reports.
template <class Observer, class P>
concept books_work = requires(Observer o, const typename P::motion m, const reported_effort<P> f,
                              typename P::scalar s) {
  { o.update(m, f, s) } -> std::same_as<bool>;
  requires noexcept(o.update(m, f, s));
};

/// True; a shaper among them does not compile.
template <class... Bounds>
[[nodiscard]] constexpr bool are_bounds() noexcept {
  static_assert(
      (!speaks_of_local_model<Bounds> && ...),
      "passive_haptics: this is a shaper, not a bound: it may ask for more than the ledger "
      "covers, so it stands before the bound: shaped{spring{}, force_rate_limit{}}");
  return true;
}

/// An effort, and whether it differs from the desired one.
template <class P>
struct bounded {
  typename P::effort force;
  bool limited;
};

/// The answer of a bound, which is given the port's state, or of a shaper, which is given the contact and the port.
template <class Part, class P, class... States>
[[nodiscard]] constexpr auto answer(Part& part, const typename P::effort& desired,
                                    const States&... states) noexcept {
  if constexpr (sizeof...(States) == 1) {
    return part.limit(desired, states...);
  } else {
    return part.shape(desired, states...);
  }
}

/// The desired effort after a bound, a shaper or a sequence of them.
template <class P, class Part, class... States>
[[nodiscard, gnu::always_inline]] constexpr bounded<P> applied(Part& part,
                                                               const typename P::effort& desired,
                                                               const States&... states) noexcept {
  if constexpr (requires { part.apply(desired, states...); }) {
    return part.apply(desired, states...);
  } else {
    const auto said = answer<Part, P>(part, desired, states...);
    if constexpr (std::same_as<decltype(said), const share<typename P::scalar>>) {
      using scalar = typename P::scalar;
      if (said.factor >= scalar(1)) return {desired, false};
      const scalar left = said.factor > scalar(0) ? said.factor : scalar(0);  // NaN counts as 0
      const typename P::effort force = desired * left;
      return {force, !(force == desired)};
    } else {
      return {said, !(said == desired)};
    }
  }
}

/// True if a part only reduces an effort, because its answer is always a share.
template <class Spec, class P, class... States>
[[nodiscard]] constexpr bool reduces() noexcept {
  using part = part_at<Spec, P>;
  if constexpr (requires { part::template only_reduces<States...>; }) {
    return part::template only_reduces<States...>;
  } else {
    return requires(part b, typename P::effort f, const States... states) {
      { answer<part, P>(b, f, states...) } -> std::same_as<share<typename P::scalar>>;
    };
  }
}
/// True if a part has no state from tick to tick.
template <class Spec, class P, class... States>
[[nodiscard]] constexpr bool keeps_nothing() noexcept {
  using part = part_at<Spec, P>;
  if constexpr (requires { part::template stateless<States...>; }) {
    return part::template stateless<States...>;
  } else if constexpr (sizeof...(States) == 1) {
    return requires(const part b, typename P::effort f, const States... s) {
      b.limit(f, s...);
    };
  } else {
    return requires(const part b, typename P::effort f, const States... s) {
      b.shape(f, s...);
    };
  }
}

/// Passes a tick without an effort to the parts that have a state.
template <class Spec, class P, class... States>
[[gnu::always_inline]] constexpr void idle(auto& part, const States&... states) noexcept {
  if constexpr (requires { part.idle(states...); })
    part.idle(states...);
  else if constexpr (!keeps_nothing<Spec, P, States...>())
    static_cast<void>(applied<P>(part, P::zero(), states...));
}

/// The number of parts in `Spec` at a port that take `Parameters`; it is 1 for the same struct.
template <class Parameters, class Spec, class P>
[[nodiscard]] constexpr int count_takers() noexcept {
  using part = part_at<Spec, P>;
  if constexpr (std::same_as<Parameters, Spec>) {
    return 1;
  } else if constexpr (requires { part::template takers<Parameters>; }) {
    return part::template takers<Parameters>;
  } else {
    return 0;
  }
}
template <class Parameters, class Spec, class P>
inline constexpr int takers = count_takers<Parameters, Spec, P>();

/// Sets new parameters of a part and keeps its state, if it has set().
template <class Spec, class P, class Parameters>
constexpr void take(part_at<Spec, P>& part, const Parameters& p) noexcept {
  if constexpr (!std::same_as<Parameters, Spec>) {
    part.take(p);
  } else if constexpr (takes_in_place<part_at<Spec, P>, Parameters>) {
    part.set(p);
  } else {
    part = part_at<Spec, P>(p);
  }
}

/// Satisfied by a bound that knows the limit of the motors.
template <class Part, class Effort>
concept says_what_it_holds = requires(const Part p, const Effort f) {
  { p.can_hold(f) } -> std::same_as<bool>;
};

/// The compile-time error of a port that is given a mesh, or the nodes of one.
template <class Mesh>
constexpr void refuse_mesh() noexcept {
  static_assert(!std::same_as<Mesh, Mesh>,
                "passive_haptics: the source of a port touches a mesh, and its surface moves it: "
                "port.source().touch(surface), and surface.update(nodes)");
}

template <class Source>
constexpr void refuse_slot() noexcept {
  static_assert(!std::same_as<Source, Source>,
                "passive_haptics: the slots are those of the source of a port: "
                "port.source().update(i, surface), and port.source().release(i)");
}

/// Calls explain() of a part, if it has one.
template <class Part, class... Facts>
constexpr void explain(const Part& part, explanation& e, const Facts&... facts) noexcept {
  if constexpr (requires { part.explain(e, facts...); }) part.explain(e, facts...);
}
/// |f| [N] of an effort; for a wrench, of its force only.
template <class P>
[[nodiscard]] constexpr auto force_in(const typename P::effort& f) noexcept {
  if constexpr (requires { P::norm(f); }) {
    return P::norm(f);
  } else if constexpr (requires { P::linear(f); }) {
    return P::body_space::norm(P::linear(f));
  } else {
    return P::geometry::norm(f);
  }
}
/// |τ| [N·m] of a wrench; 0 of another effort.
template <class P>
[[nodiscard]] constexpr auto torque_in([[maybe_unused]] const typename P::effort& f) noexcept {
  if constexpr (moves_and_turns<P>) return P::body_space::norm(P::angular(f));
  return typename P::scalar(0);
}
/// Satisfied by a bound with most_held(), the longest effort that can_hold() accepts.
template <class Part>
concept knows_most_held = requires(const Part p) {
  p.most_held();
};
/// Satisfied by a bound that tests its assumptions against the motion.
template <class Part>
concept looks_at_motion = requires(Part p) {
  { p.watching().seen() } -> std::same_as<event>;
};

/// Parts in order: each one is applied to the effort that the one before it returned.
template <class... Parts>
struct sequence {
  constexpr sequence() noexcept = default;
  [[nodiscard]] constexpr parameter_fault check() const noexcept { return {}; }

  template <class P>
  struct on {
    constexpr explicit on(const sequence& /*p*/) noexcept {}
    [[nodiscard]] constexpr sequence parameters() const noexcept { return {}; }
    constexpr void set(const sequence& /*p*/) noexcept {}
    constexpr void reset() noexcept {}
    template <class... States>
    static constexpr bool only_reduces = true;
    template <class... States>
    static constexpr bool stateless = true;
    template <class Parameters>
    static constexpr int takers = 0;
    template <class... States>
    [[nodiscard]] constexpr bounded<P> apply(const typename P::effort& desired,
                                             const States&... /*states*/) const noexcept {
      return {desired, false};
    }
  };
};

template <class First, class... Rest>
struct sequence<First, Rest...> {
  First first{};
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS sequence<Rest...> rest{};

  constexpr sequence() noexcept = default;
  constexpr explicit sequence(const First& one, const Rest&... others) noexcept
      : first(one), rest(others...) {}

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    const auto fault = fault_in(first);
    return fault ? fault : rest.check();
  }
  template <class P>
  class on;
};

template <class First, class... Rest>
template <class P>
class sequence<First, Rest...>::on {
  using effort = typename P::effort;
  using others = sequence<Rest...>;

 public:
  template <class... States>
  static constexpr bool only_reduces =
      reduces<First, P, States...>() && reduces<others, P, States...>();
  template <class... States>
  static constexpr bool stateless =
      keeps_nothing<First, P, States...>() && keeps_nothing<others, P, States...>();
  template <class Parameters>
  static constexpr int takers =
      detail::takers<Parameters, First, P> + detail::takers<Parameters, others, P>;

  constexpr explicit on(const sequence& p) noexcept : first_(p.first), rest_(p.rest) {}
  constexpr void set(const sequence& p) noexcept {
    detail::take<First, P>(first_, p.first);
    rest_.set(p.rest);
  }
  constexpr void adopt(typename P::scalar T, int late) noexcept {
    tell(first_, T, late);
    tell(rest_, T, late);
  }
  [[nodiscard]] constexpr sequence parameters() const noexcept {
    sequence p;
    if constexpr (has_parameters<part_at<First, P>>) {
      p.first = first_.parameters();
    } else if constexpr (std::same_as<First, part_at<First, P>>) {
      p.first = first_;
    }  // else it has none
    p.rest = rest_.parameters();
    return p;
  }
  constexpr void reset() noexcept {
    restart(first_);
    rest_.reset();
  }
  template <class Parameters>
  constexpr void take(const Parameters& p) noexcept {
    if constexpr (detail::takers < Parameters, First, P >> 0) {
      detail::take<First, P>(first_, p);
    } else {
      detail::take<others, P>(rest_, p);
    }
  }

  /// True if every part with a can_hold() accepts the effort.
  [[nodiscard]] constexpr bool can_hold(const effort& held) const noexcept
      requires(says_what_it_holds<part_at<First, P>, effort> ||
               says_what_it_holds<part_at<others, P>, effort>) {
    bool all = true;
    if constexpr (says_what_it_holds<part_at<First, P>, effort>) all = first_.can_hold(held);
    if constexpr (says_what_it_holds<part_at<others, P>, effort>) all &= rest_.can_hold(held);
    return all;
  }
  /// Calls explain() of each part in order.
  constexpr void explain(explanation& e, const auto& damping, typename P::scalar T,
                         int late) const noexcept {
    detail::explain(first_, e, damping, T, late);
    detail::explain(rest_, e, damping, T, late);
  }
  /// These three are answered by the first part that has them.
  [[nodiscard]] constexpr auto& watching() noexcept
      requires(looks_at_motion<part_at<First, P>> || looks_at_motion<part_at<others, P>>) {
    return first_if<looks_at_motion<part_at<First, P>>>(*this).watching();
  }
  template <class Damping>
  [[nodiscard]] constexpr unseen_work<typename P::scalar> unseen(
      const seen_tick<P>& seen, const Damping& damping, const effort& f,
      typename P::scalar t) const noexcept
      requires(knows_reach<part_at<First, P>, P> || knows_reach<part_at<others, P>, P>) {
    return first_if<knows_reach<part_at<First, P>, P>>(*this).unseen(seen, damping, f, t);
  }
  [[nodiscard]] constexpr effort most_held() const noexcept
      requires(knows_most_held<part_at<First, P>> || knows_most_held<part_at<others, P>>) {
    return first_if<knows_most_held<part_at<First, P>>>(*this).most_held();
  }

  constexpr void idle(const auto&... states) noexcept {
    detail::idle<First, P>(first_, states...);
    detail::idle<others, P>(rest_, states...);
  }
  template <class... States>
  [[nodiscard, gnu::always_inline]] constexpr bounded<P> apply(const effort& desired,
                                                               const States&... states) noexcept {
    return one_after_the_other(*this, desired, states...);
  }
  template <class... States>
  requires(stateless<States...>)
      [[nodiscard]] constexpr bounded<P> apply(const effort& desired,
                                               const States&... states) const noexcept {
    return one_after_the_other(*this, desired, states...);
  }

 private:
  template <bool IsFirst, class Self>
  [[nodiscard]] static constexpr auto& first_if(Self& self) noexcept {
    if constexpr (IsFirst) {
      return self.first_;
    } else {
      return self.rest_;
    }
  }
  template <class Self, class... States>
  [[nodiscard, gnu::always_inline]] static constexpr bounded<P> one_after_the_other(
      Self& self, const effort& desired, const States&... states) noexcept {
    const bounded<P> once = applied<P>(self.first_, desired, states...);
    const bounded<P> then = applied<P>(self.rest_, once.force, states...);
    return {then.force, once.limited || then.limited};
  }

  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS part_at<First, P> first_;
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS part_at<others, P> rest_;
};

}  // namespace detail

}  // namespace v0
}  // namespace passive_haptics
