// SPDX-License-Identifier: BSD-3-Clause
// The control: a scene that needs all that the wall does without, so that the search is known to find.
#include <passive_haptics/passive_haptics.hpp>

namespace ph = passive_haptics;
using scene = ph::space<double, 3>;

scene::vector facet_force(const scene::vector& position, double dt) {
  static ph::exchange<ph::triangle<scene>> mailbox;
  static ph::local_model facet{scene{},
                               ph::following<ph::triangle<scene>>{},
                               ph::rotate_limited<scene>{.rate = 4},
                               ph::spring<scene>{},
                               ph::reduced_energy<scene>{.damping = 0.3},
                               ph::thesis_bound<scene>{}};
  if (const auto* next = mailbox.take()) static_cast<void>(facet.retarget(*next));
  return facet.tick(position, dt).force;
}
