// SPDX-License-Identifier: BSD-3-Clause
#include "compose_touch.hpp"

namespace experiments {

void compose_triangles(std::vector<composition>& all) {
  using triangle = ph::triangle<volume>;
  compose_over<triangle>(all, "triangle, turn_at_once", ph::turn_at_once{});
  compose_over<triangle>(all, "triangle, turn_limited", ph::turn_limited{.rate = 3.0});
}

}  // namespace experiments
