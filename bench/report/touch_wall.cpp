// SPDX-License-Identifier: BSD-3-Clause
#include "compose_touch.hpp"

namespace experiments {

std::vector<composition> wall_compositions() {
  using space = ph::space<double, 1>;
  return compositions_over<space, ph::half_space<space>>("wall", "-", ph::snap<space>{});
}

}  // namespace experiments
