// SPDX-License-Identifier: BSD-3-Clause
// Encoders of 60 µm, which are felt: dry friction pays for the stiffness, and the force steps by K q at most.
#include "judge.hpp"

using scene = ph::space<double, 1>;

int main() {
  const ph::encoder_device stated{.mass = 0.2,          // kg: half or less of what was identified
                                  .damping = 0.5,       // N·s/m
                                  .friction = 0.15,     // N
                                  .presliding = 10e-6,  // m: more than was identified
                                  .quantum = 60e-6,     // m
                                  .force_limit = 9};    // N
  auto touch = ph::make_touch<scene>(stated, {.force = 5.5});
  const auto shown = touch.update({.point = 0, .normal = 1, .stiffness = 5000}).stiffness;
  std::printf("asked for 5000 N/m, which friction does not pay for: %.0f N/m\n", shown);

  session<scene> finger({.mass = 0.25, .damping = 1, .quantum = 60e-6, .start = 0.02}, 5, 0.3,
                        8e-6);
  finger.floor_of(shown, stated.quantum, stated.mass);
  finger.hold(-0.01, 3, [&](const auto& sample) { return touch.tick(sample).force; });
  return finger.verdict(touch.explain(), 0.5 * 0.3 * 8e-6);
}
