// SPDX-License-Identifier: BSD-3-Clause
// Two walls of a groove, 20 mm apart, at a handle behind a cable of 75 Hz (cable.hpp), pushed onto in turn.
#include "cable.hpp"
#include <passive_haptics/compliant/compositions.hpp>

double groove(const char* told, auto port) {
  if (!port.source().update(0, plane{.point = 0.00, .normal = 1, .stiffness = 8000}) ||
      !port.source().update(1, plane{.point = 0.02, .normal = -1, .stiffness = 8000})) {
    return 1;
  }
  return drawn_from(told, port, {.turns = 1},
                    [&](const auto& sample) { return port.tick(sample); });
}

int main() {
  const ph::slots<plane, 2> walls{};
  const double untold = groove("the mass", ph::make_contacts<scene>(device, {.force = 5}, walls));
  const double is_told =
      groove("the cable", ph::make_contacts<scene>(device, cable, {.force = 5}, walls));
  return untold > 1e-3 && is_told < 1e-9 ? 0 : 1;
}
