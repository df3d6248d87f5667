// SPDX-License-Identifier: BSD-3-Clause
// Haply's Inverse3 by its HardwareAPI: a floor, felt for a minute.
//     haply_touch /dev/ttyACM0
//
// Tried: compiled against an excerpt of our own of its Inverse3.h, and run with a simulated device behind
// it. Neither the vendor's library nor a device was there. The damping that the firmware can be told to
// simulate is no damping of the device: leave it out of `damping`.

#include <passive_haptics/base/stopwatch.hpp>
#include <passive_haptics/passive_haptics.hpp>

#include <HardwareAPI.h>
#include <chrono>
#include <cstdio>

namespace ph = passive_haptics;
namespace haply = Haply::HardwareAPI;
using scene = ph::space<double, 3>;
using inverse3 = haply::Devices::Inverse3;

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: haply_touch PORT\n", stderr);
    return 1;
  }
  haply::IO::SerialStream cable(argv[1]);
  inverse3 device(&cable);
  (void)device.DeviceWakeup();

  // The answer comes with the round trip of the force, and was taken before it: one tick late. State less mass
  // and damping than your device has, and a hand stronger than any that will hold it.
  using late = ph::late_loop_limits<1>;
  ph::touch<scene, ph::half_space<scene>, late> wall{
      scene{},
      ph::followed<ph::half_space<scene>>{},
      ph::turn_limited{.rate = 2.0},
      ph::damped_spring{.mass = 0.1, .force_limit = 8.0},
      ph::reduced_energy{.damping = 0.1},
      ph::bound_chain{ph::watched{ph::reachable_bound{.mass = 0.1, .hand_force = 5.0}},
                      ph::actuator_limit{.most = 8.0}},
      late{.longest_tick = 0.002}};
  wall.update({.point = {0.0, 0.0, 0.0}, .normal = {0.0, 0.0, 1.0}, .stiffness = 1000.0});

  ph::stopwatch watch;
  inverse3::EndEffectorForceRequest request;
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (std::chrono::steady_clock::now() < end) {
    const inverse3::EndEffectorStateResponse state = device.EndEffectorForce(request);
    if (!cable.good()) return 1;  // the firmware keeps the last force: unplug it
    const scene::vector x(state.position[0], state.position[1], state.position[2]);
    const auto force = wall.tick(x, ph::seconds{watch.lap(1e-3)}).force;
    for (int i = 0; i < 3; ++i) request.force[i] = static_cast<float>(force[i]);
  }
  (void)device.EndEffectorForce({});
}
