// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How an entry of the catalogue is written:
//
//     entry<3>({"none", "spring, no_observer, no_bound"},
//              [](const premises& p) { return parts{wall(p), ph::no_observer{}, ph::no_bound{}}; })
//     over_ledger<3>("strict FBA", "strict_bound", [](auto&) { return ph::strict_bound{}; })
//
// entry<3> offers it in 1, 2 and 3 dimensions, entry<1> in one; in 1 and 3 in float, too. entry<3, 2>
// is for a loop that is two ticks late. What it promises comes from the type.

#include "catalogue.hpp"

namespace controllers {

template <class Law, class Observer, class Bound, class Motion = ph::last_difference>
struct parts {
  Law law;
  Observer observer;
  Bound bound;
  Motion motion{};
};
template <class Law, class Observer, class Bound>
parts(Law, Observer, Bound) -> parts<Law, Observer, Bound>;
template <class Law, class Observer, class Bound, class Motion>
parts(Law, Observer, Bound, Motion) -> parts<Law, Observer, Bound, Motion>;

/// The wall as the environment wants it: a spring, and a damper if the scene has one.
inline ph::virtual_coupling wall(const premises& p) {
  return {.damping = p.wall_damping};
}
inline ph::reduced_energy ledger(const premises& p) {
  return {.damping = p.damping};
}

/// The reachable set of a hand that pushes with no more than the scene says.
inline ph::reachable_bound reachable(const premises& p) {
  return {.mass = p.mass, .hand_force = p.hand_force};
}

/// A local model over a half-space that follows the environment's. A light device thrown off a stiff
/// wall is faster than any hand.
template <class Space, int Latency = 0, class... Parts>
auto touch(const premises& p, const parts<Parts...>& with) {
  return ph::local_model{Space{},
                         ph::followed<ph::half_space<Space>>{},
                         ph::turn_at_once{},
                         with.law,
                         with.observer,
                         with.bound,
                         ph::late_loop_limits<Latency>{.longest_tick = p.longest_tick,
                                                       .top_speed = 100.0,
                                                       .workspace = ph::loop_limits::never,
                                                       .watchdog = p.longest_tick},
                         with.motion};
}

template <int Dofs, int Latency = 0, class Make>
controller entry(facts about, const Make& make) {
  using observer = decltype(make(premises{}).observer);
  using local = decltype(touch<d1, Latency>(premises{}, make(premises{})));
  controller c{std::move(about), local::passivity, local::latency, !observer::exact,
               local::state_type::damping_type::rubs};
  const auto offer = [&c, &make]<class Space>(Space) {
    static_assert(decltype(touch<Space, Latency>(premises{}, make(premises{})))::passivity ==
                      local::passivity,
                  "a controller promises the same in every dimension");
    c.in<Space>() = [make](const premises& p) {
      return model<Space>(touch<Space, Latency>(p, make(p)));
    };
  };
  offer(d1{});
  offer(f1{});
  if constexpr (Dofs >= 2) offer(d2{});
  if constexpr (Dofs >= 3) {
    offer(d3{});
    offer(f3{});
  }
  return c;
}

/// The usual one: the wall as it is, a ledger, and bound(premises) over it.
template <int Dofs, int Latency = 0, class Bound>
controller over_ledger(const std::string& name, const std::string& said, Bound bound) {
  return entry<Dofs, Latency>({name, "spring, reduced_energy, " + said},
                              [bound](const premises& p) {
                                return parts{wall(p), ledger(p), bound(p)};
                              });
}
/// A shaper before it: shape(premises), and then strict_bound or what else is said.
template <class Shape, class Bound>
controller over_ledger(facts about, Shape shape, const Bound& bound) {
  return entry<3>(std::move(about), [shape, bound](const premises& p) {
    return parts{ph::shaped{wall(p), shape(p)}, ledger(p), bound};
  });
}

}  // namespace controllers
