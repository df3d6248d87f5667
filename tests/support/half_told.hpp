// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What is told of a simulated device: half of its damping and friction, and the rest as it is.

#include "support/scenes.hpp"
#include <passive_haptics/design/described_device.hpp>
#include <passive_haptics/simulation/presets.hpp>

constexpr ph::encoder_device half_told(const ph::simulation::device_preset& is, double presliding) {
  return {.mass = is.mass,
          .damping = is.damping / 2.0,
          .friction = is.friction / 2.0,
          .presliding = presliding,
          .quantum = is.quantum,
          .force_limit = is.force_limit};
}
