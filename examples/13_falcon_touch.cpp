// SPDX-License-Identifier: BSD-3-Clause
// A wall for the Falcon, 800 N/m at z = 0.12 m, for ten seconds: push the grip in until you feel it.
//     13_falcon_touch [firmware.bin]
//     13_falcon_touch --simulate         a simulated Falcon, and a hand that pushes with 2.9 N
//
// A packet device holds a command one tick late: late_loop_limits<1> says so, once, for every bound.
// make_touch of an encoder_device keeps its promise on the steps of the encoders: dry friction, stated from
// below, pays for them, and the wall is no stiffer than it can pay for.

#include "falcon_ready.hpp"
#include <passive_haptics/passive_haptics.hpp>

template <class Device>
int touch(Device& grip) {
  // What nobody has published of a Falcon: identify your own, and state less damping and friction than
  // it has, and more presliding.
  constexpr ph::encoder_device stated{.mass = 0.1,         // kg
                                      .damping = 0.2,      // N·s/m
                                      .friction = 0.15,    // N
                                      .presliding = 1e-5,  // m
                                      .quantum = 1.03e-4,  // m, a count of every leg
                                      .force_limit = 8.0,  // N
                                      .longest_tick = 2.5e-3,
                                      .latency = 1};  // ticks: a force leaves with the next packet
  using plane = ph::half_space<scene>;
  auto wall = ph::make_touch<scene, plane, ph::late_loop_limits<1>>(stated, {.force = 5});  // N
  wall.update({{0, 0, 0.12}, {0, 0, 1}, 800.0});

  scene::vector force = scene::zero();
  double least_energy = 0;
  for (int n = 1; n <= 10'000 && grip.where() != falcon::state::fault; ++n) {
    const auto out = wall.tick(grip.exchange(force));
    force = out.force;
    least_energy = std::min(least_energy, out.energy);
    if (n % 2000 == 0) {
      std::printf("%2d s: %.1f mm deep, %.1f N, %s\n", n / 1000, out.depth * 1e3, force(2),
                  ph::to_string(out.what));
    }
  }
  std::printf("asked for 800 N/m, displays %.0f N/m\n", wall.law().stiffness());
  std::printf("the ledger was never below %.1f uJ, where it begins\n", least_energy * 1e6);
  return 0;
}

int main(int argc, char** argv) {
  simulated_falcon simulated{.runs = true, .homed = true};
  simulated.body.damping = 0.4;
  simulated.body.friction = 0.3;
  const ph::simulation::impedance_hand<scene> hand{// comes slowly, then pushes on
                                                   .stiffness = 300,
                                                   .limit = 2.9,
                                                   .target = {0, 0, 0.16},
                                                   .target_velocity = {0, 0, -0.05}};
  return with_falcon(argc, argv, falcon::cautious_gain<double>, simulated, hand,
                     [](auto& grip) { return touch(grip); });
}
