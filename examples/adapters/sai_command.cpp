// SPDX-License-Identifier: BSD-3-Clause
// sai: the command force of a HapticDeviceController, through a port. Compiled by hand only:
// docs/adapters.md says against what.

#include <passive_haptics/passive_haptics.hpp>

#include <HapticDeviceController.h>

namespace ph = passive_haptics;
using scene = ph::space<double, 3>;

/// The device is behind Redis, so a force is held a tick late at least: measure it (measure_latency).
using late_guard = ph::force_guard<scene, ph::late_loop_limits<1>>;

late_guard guard_of(ph::exact_device device, const ph::known_hand& hand) {
  device.longest_tick = 0.002;
  device.latency = 1;
  return ph::make_guard<scene, ph::late_loop_limits<1>>(device, hand);
}

SaiPrimitives::HapticControllerOutput command(SaiPrimitives::HapticDeviceController& controller,
                                              const SaiPrimitives::HapticControllerInput& input,
                                              double dt, late_guard& port) {
  auto out = controller.computeHapticControl(input);
  out.device_command_force =
      port.tick(input.device_position, ph::seconds{dt}, out.device_command_force).force;
  out.device_command_moment.setZero();  // no ledger counts it
  return out;  // metres and newtons in the device's base frame, as they were
}
