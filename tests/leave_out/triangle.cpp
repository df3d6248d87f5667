// SPDX-License-Identifier: BSD-3-Clause
// The control: a scene that needs all that the wall does without, so that the search is known to find.
#include <passive_haptics/passive_haptics.hpp>

namespace ph = passive_haptics;
using scene = ph::space<double, 3>;

scene::vector facet_force(const scene::vector& position, double dt) {
  static ph::exchange<ph::triangle<scene>> mailbox;
  static ph::passive_port facets{
      scene{},
      ph::contacts{ph::local_contact{ph::followed<ph::triangle<scene>>{},
                                     ph::turn_limited{.rate = 4},
                                     ph::shaped{ph::spring{}, ph::thesis_rule{}}}},
      ph::reduced_energy{.damping = 0.3}, ph::no_bound{},
      ph::watched_loop_limits<>{.longest_tick = 0.001}};
  if (const auto* next = mailbox.take()) {
    static_cast<void>(facets.source().contact<0>().update(*next));
  }
  return facets.tick(position, ph::seconds{dt}).force;
}
