// SPDX-License-Identifier: BSD-3-Clause
// libnifalcon: a wall for the Falcon, felt for a minute. The library has a driver of its own
// (docs/falcon.md), so this is for programs that are built on libnifalcon.
//
// Tried: compiled against libnifalcon's headers (master of 2019), and run on its core, with a simulated
// Falcon in the place of its firmware and kinematics. No Falcon was there.

#include <passive_haptics/base/stopwatch.hpp>
#include <passive_haptics/passive_haptics.hpp>

#include <array>
#include <chrono>
#include <cstdio>
#include <falcon/core/FalconDevice.h>
#include <falcon/firmware/FalconFirmwareNovintSDK.h>
#include <falcon/kinematic/FalconKinematicStamper.h>

namespace ph = passive_haptics;
using scene = ph::space<double, 3>;

int main() {
  libnifalcon::FalconDevice falcon;
  falcon.setFalconFirmware<libnifalcon::FalconFirmwareNovintSDK>();
  falcon.setFalconKinematic<libnifalcon::FalconKinematicStamper>();
  if (!falcon.open(0) || !(falcon.isFirmwareLoaded() || falcon.loadFirmware(10U))) {
    std::fputs("no Falcon, or one that takes no firmware\n", stderr);
    return 1;
  }
  // A force leaves with the next packet, so it is held one tick late. Encoders with steps: what pays for them
  // is dry friction, stated from below. Identify your own Falcon: examples/18_falcon_identify.cpp.
  using plane = ph::half_space<scene>;
  auto wall = ph::make_touch<scene, plane, ph::late_loop_limits<1>>(
      ph::encoder_device{.mass = 0.1,
                         .damping = 0.2,
                         .friction = 0.15,
                         .presliding = 1e-5,
                         .quantum = 1.03e-4,
                         .force_limit = 8.0,
                         .longest_tick = 2.5e-3,
                         .latency = 1},
      {.force = 5.0});
  wall.update({.point = {0.0, 0.0, 0.12}, .normal = {0.0, 0.0, 1.0}, .stiffness = 800.0});

  ph::stopwatch watch;
  double since_packet = 0.0;
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (std::chrono::steady_clock::now() < end) {
    const bool fresh = falcon.runIOLoop();  // sends the last force, reads the encoders
    since_packet += watch.lap(1e-3);
    if (!fresh) continue;  // no new packet came, and the position is the old one
    const std::array<double, 3> p = falcon.getPosition();
    const auto f = wall.tick(scene::vector(p[0], p[1], p[2]), ph::seconds{since_packet}).force;
    falcon.setForce({f[0], f[1], f[2]});
    since_packet = 0.0;
  }

  falcon.setForce({0.0, 0.0, 0.0});
  falcon.runIOLoop();
  falcon.close();
}
