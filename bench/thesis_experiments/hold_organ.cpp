// SPDX-License-Identifier: BSD-3-Clause
#include "organ.hpp"
#include <passive_haptics/environment/rigid_modes.hpp>

namespace experiments {

/// Fixes the lowest nodes, which must be enough to hold the organ.
void stroke_scene::hold() {
  const double lowest = box_.min()(up_) + 0.15 * box_.sizes()(up_);
  for (std::size_t i = 0; i < mesh().nodes.size(); ++i) {
    if (mesh().nodes[i](up_) < lowest) fixed_.push_back(static_cast<int>(i));
  }
  const int modes = env::rigid_modes_left(mesh(), fixed_);
  if (modes == 0) return;
  const int parts = env::find_parts(mesh()).count;
  if (parts > 1) {
    throw unusable_organ(organ_,
                         "is held by the lowest 15 % along " + axis(up_) +
                             ", which do not hold all of its " + std::to_string(parts) +
                             " separate parts",
                         "keep one part, or join them");
  }
  throw unusable_organ(organ_,
                       "is held by the " + std::to_string(fixed_.size()) +
                           " nodes in the lowest 15 % along " + axis(up_) +
                           ", and can still turn about them",
                       "mesh it finer, or turn it until a broad side is down");
}

}  // namespace experiments
