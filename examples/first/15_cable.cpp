// SPDX-License-Identifier: BSD-3-Clause
// A wall at a handle behind a cable of 75 Hz (cable.hpp): 3.0 mJ are drawn from one that was told the mass alone.
#include "cable.hpp"
#include <passive_haptics/compliant/compositions.hpp>

double wall(const char* told, auto touch) {
  if (!touch.update({.point = 0, .normal = 1, .stiffness = 8000})) return 1;
  return drawn_from(told, touch, {}, [&](const auto& sample) { return touch.tick(sample); });
}

int main() {
  const double untold = wall("the mass", ph::make_touch<scene>(device, {.force = 5}));
  const double is_told = wall("the cable", ph::make_touch<scene>(device, cable, {.force = 5}));
  return untold > 1e-3 && is_told < 1e-9 ? 0 : 1;
}
