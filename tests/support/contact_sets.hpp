// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Sets of contacts by themselves: no ledger and no bound.
#include "support/scenes.hpp"
#include <passive_haptics/contact/contact_set.hpp>

/// A port that gives what its source asks for.
template <class Space, class Source>
auto open_port(const Source& source) {
  return ph::passive_port{Space{}, source, ph::no_observer{}, ph::no_bound{}, thesis_loop};
}
template <class Space, int Count, class Friction = ph::frictionless>
auto planes(const ph::pursuit& pace = {}, const Friction& friction = {}) {
  return open_port<Space>(ph::contact_set{ph::proxy_spring{.mass = 0.1}, pace, friction,
                                          ph::slots<ph::half_space<Space>, Count>{}});
}
