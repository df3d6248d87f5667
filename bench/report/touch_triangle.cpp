// SPDX-License-Identifier: BSD-3-Clause
#include "compose_touch.hpp"

namespace experiments {

std::vector<composition> triangle_compositions() {
  using space = ph::space<double, 3>;
  auto all = compositions_over<space, ph::triangle<space>>("triangle", "snap", ph::snap<space>{});
  for (auto& c : compositions_over<space, ph::triangle<space>>(
           "triangle", "rotate_limited", ph::rotate_limited<space>{.rate = 3.0})) {
    all.push_back(std::move(c));
  }
  return all;
}

}  // namespace experiments
