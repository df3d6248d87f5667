// SPDX-License-Identifier: BSD-3-Clause
// HAPI: a renderer whose forces go through a port. Compiled by hand only: docs/adapters.md says against what.

#include <passive_haptics/passive_haptics.hpp>

#include <HAPI/GodObjectRenderer.h>
#include <HAPI/HAPIHapticsDevice.h>

namespace ph = passive_haptics;
using scene = ph::space<double, 3>;

/// Sees the sum of all shapes. Take out the torque: no ledger counts it.
class passive_renderer : public HAPI::GodObjectRenderer {
 public:
  // The form with dt: HAPI never calls the other one where this one is there.
  HAPI::HAPIForceEffect::EffectOutput renderHapticsOneStep(HAPI::HAPIHapticsDevice* device,
                                                           const HapticShapeVector& shapes,
                                                           HAPI::HAPITime dt) override {
    const auto asked = HAPI::GodObjectRenderer::renderHapticsOneStep(device, shapes, dt);
    const HAPI::Vec3 p = device->getRawPosition();  // metres, before any calibration
    const scene::vector wanted(asked.force.x, asked.force.y, asked.force.z);
    const auto out = port_.tick(scene::vector(p.x, p.y, p.z), ph::seconds{dt}, wanted);
    return {HAPI::Vec3(out.force[0], out.force[1], out.force[2])};
  }

 private:
  // State less mass and damping than your device has, and a hand stronger than any that will hold it.
  ph::force_guard<scene> port_ = ph::make_guard<scene>(
      {.mass = 0.1, .damping = 0.1, .force_limit = 8.0, .longest_tick = 0.002}, {.force = 5.0});
};
