// SPDX-License-Identifier: BSD-3-Clause
// Sets of contacts, here of one wall, smooth and rough. What several of them do is in bench/contacts.
#include "../common/set_of_one.hpp"
#include "compose.hpp"

namespace controllers {

namespace {

template <class Space, class Friction, class Bound>
auto set(const premises& p, const Bound& bound) {
  return experiments::set_of_one{Space{},
                                 ph::proxy_spring{.mass = p.mass},
                                 ph::pursuit{},
                                 Friction{},
                                 ledger(p),
                                 bound,
                                 ph::late_loop_limits<0>{.longest_tick = p.longest_tick,
                                                         .top_speed = 100.0,
                                                         .workspace = ph::loop_limits::never,
                                                         .watchdog = p.longest_tick}};
}

/// In one dimension nothing rubs: there the rough one is the smooth one.
template <class Friction, class Bound>
controller entry_of(const std::string& name, const std::string& said, Bound bound) {
  controller c{{name, said, false}};
  const auto offer = [&c, bound]<class Space>(Space) {
    c.tag = decltype(set<Space, Friction>(premises{}, bound(premises{})))::passivity;
    c.in<Space>() = [bound](const premises& p) {
      return model<Space>(set<Space, Friction>(p, bound(p)));
    };
  };
  offer(d1{});
  offer(f1{});
  offer(d2{});
  offer(d3{});
  offer(f3{});
  return c;
}

}  // namespace

std::vector<controller> contact_controllers() {
  const auto strict = [](const premises&) { return ph::strict_bound{}; };
  return {
      entry_of<ph::frictionless>("contact set, strict", "contact_set, reduced_energy, strict_bound",
                                 strict),
      entry_of<ph::frictionless>("contact set, reachable",
                                 "contact_set, reduced_energy, reachable_bound", reachable),
      entry_of<ph::stick_slip>("rough contact, strict",
                               "contact_set with stick_slip, reduced_energy, strict_bound", strict),
      entry_of<ph::stick_slip>("rough contact, reachable",
                               "contact_set with stick_slip, reduced_energy, reachable_bound",
                               reachable)};
}

}  // namespace controllers
