// SPDX-License-Identifier: BSD-3-Clause
// A force that somebody's renderer makes, a wall of 8 kN/m, at a handle behind a cable of 75 Hz (cable.hpp). Shaken at
// 31 Hz, a guard that was told the mass alone gives energy away.
#include "cable.hpp"
#include <passive_haptics/compliant/compositions.hpp>

double renderer(double x) {
  return x < 0 ? -8000 * x : 0;
}

double guarded(const char* told, auto guard) {
  return drawn_from(told, guard, {.rate = 197.2}, [&](const auto& sample) {
    return guard.tick(sample, renderer(sample.position));
  });
}

int main() {
  const double untold = guarded("the mass", ph::make_guard<scene>(device, {.force = 5}));
  const double is_told = guarded("the cable", ph::make_guard<scene>(device, cable, {.force = 5}));
  return untold > 1e-3 && is_told < 1e-9 ? 0 : 1;
}
