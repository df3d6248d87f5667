// SPDX-License-Identifier: BSD-3-Clause
// CHAI3D: a ball of 2 kN/m, felt for a minute, with a port between the tool and the device.
//
// Tried: with CHAI3D 3.3 without its graphics, in front of a device that was simulated; and without a device.
// docs/adapters.md has more figures.

#include <passive_haptics/adapters/chai3d.hpp>
#include <passive_haptics/passive_haptics.hpp>

#include <chrono>
#include <cstdio>
#include <devices/CHapticDeviceHandler.h>
#include <thread>
#include <tools/CToolCursor.h>
#include <world/CShapeSphere.h>

namespace ph = passive_haptics;
using scene = ph::space<double, 3>;

int complain(const ph::parameter_fault& fault) {
  std::fprintf(stderr, "%s is %g, and should be %s\n", fault.parameter, fault.value, fault.remedy);
  return 1;
}

int main() {
  chai3d::cHapticDeviceHandler handler;
  chai3d::cWorld world;
  auto* ball = new chai3d::cShapeSphere(0.03);  // the world deletes what it is given
  ball->createEffectSurface();
  ball->setStiffness(2000.0);
  world.addChild(ball);
  auto* tool = new chai3d::cToolCursor(&world);
  world.addChild(tool);

  chai3d::cGenericHapticDevicePtr bare;
  handler.getDevice(bare, 0);
  // State less mass and damping than your device has, and a hand stronger than any that will hold it.
  const auto port = ph::make_guard<scene>(
      {.mass = 0.1, .damping = 0.1, .force_limit = 8.0, .longest_tick = 0.002}, {.force = 5.0});
  const auto device = ph::adapters::make_passive_device(bare, port);
  if (const auto fault = device->check()) return complain(fault);
  tool->setHapticDevice(device);  // instead of the bare one; all else as it was

  if (!tool->start()) {  // opens the device, and looks whether it speaks in metres
    const auto fault = device->check();
    return complain(fault ? fault : ph::parameter_fault{"device", 0.0, "connected and powered"});
  }
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (std::chrono::steady_clock::now() < end) {
    world.computeGlobalPositions(true);
    tool->updateFromDevice();
    tool->computeInteractionForces();
    tool->applyToDevice();
    std::this_thread::sleep_for(std::chrono::microseconds(800));
  }
  tool->stop();
  std::printf("the ledger ends at %.1f mJ\n", 1e3 * device->last().energy);
}
