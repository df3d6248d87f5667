// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How an entry of the catalogue is written:
//
//     entry<3>({"strict FBA", "spring, reduced_energy, strict_bound"},
//              []<class Space>(Space, const known_in<Space>& p) {
//                return touch<Space>(p, ledger<Space>(p), ph::strict_bound<Space>{});
//              })
//
// entry<3> offers it in 1, 2 and 3 dimensions, entry<1> in one; in 1 and 3 in float, too. The tag
// comes from the type.

#include "catalogue.hpp"

namespace controllers {

template <class Space>
ph::loop_limits<Space> limits(const known_in<Space>& p) {
  return {.longest_tick = p.longest_tick};
}

template <class Space>
ph::reduced_energy<Space> ledger(const known_in<Space>& p) {
  return {.damping = p.damping};
}

/// A local model over a half-space that follows the environment's.
template <class Space, class Contact, class Observer, class Bound,
          class Motion = ph::last_difference<Space>>
auto touch(const known_in<Space>& p, const Contact& contact, const Observer& observer,
           const Bound& bound, const Motion& motion = {}) {
  return ph::local_model{Space{},           ph::following<ph::half_space<Space>>{},
                         ph::snap<Space>{}, contact,
                         observer,          bound,
                         limits<Space>(p),  motion};
}
/// The same with the wall as the environment wants it: a spring, and a damper if the scene has one.
template <class Space, class Observer, class Bound>
auto touch(const known_in<Space>& p, const Observer& observer, const Bound& bound) {
  return touch<Space>(p, ph::virtual_coupling<Space>{.damping = p.wall_damping}, observer, bound);
}

namespace detail {
template <class Space, class Make>
void offer(controller& c, auto controller::*where, const Make& make) {
  using local = decltype(make(Space{}, known_in<Space>{}));
  static_assert(local::passivity == decltype(make(d1{}, premises{}))::passivity,
                "a controller promises the same in every dimension");
  c.*where = [make](const premises& p) {
    return model<Space>(make(Space{}, p.template in<typename Space::scalar>()));
  };
}
}  // namespace detail

template <int Dofs, class Make>
controller entry(facts about, const Make& make) {
  controller c{std::move(about), decltype(make(d1{}, premises{}))::passivity, {}, {}, {}, {}, {}};
  detail::offer<d1>(c, &controller::in_1, make);
  if constexpr (Dofs >= 2) detail::offer<d2>(c, &controller::in_2, make);
  if constexpr (Dofs >= 3) detail::offer<d3>(c, &controller::in_3, make);
  detail::offer<f1>(c, &controller::in_1_float, make);
  if constexpr (Dofs >= 3) detail::offer<f3>(c, &controller::in_3_float, make);
  return c;
}

}  // namespace controllers
