// SPDX-License-Identifier: BSD-3-Clause
#include "compose_touch.hpp"

namespace experiments {

void compose_walls(std::vector<composition>& all) {
  using wall = ph::half_space<ph::space<double, 1>>;
  compose_over<wall>(all, "wall", ph::turn_at_once{});
  compose_door<wall>(all, "wall");
}

}  // namespace experiments
