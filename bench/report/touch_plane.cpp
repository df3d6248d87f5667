// SPDX-License-Identifier: BSD-3-Clause
#include "compose_touch.hpp"

namespace experiments {

void compose_planes(std::vector<composition>& all) {
  using plane = ph::half_space<volume>;
  compose_over<plane>(all, "plane, turn_at_once", ph::turn_at_once{});
  compose_over<plane>(all, "plane, turn_limited", ph::turn_limited{.rate = 3.0});
}

}  // namespace experiments
