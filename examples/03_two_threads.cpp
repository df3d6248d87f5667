// SPDX-License-Identifier: BSD-3-Clause
// The shape of a real application: a slow environment thread, and a haptic loop that measures its
// ticks and never waits. One exchange carries the constraint to the loop, a second one carries where the
// device is and what it feels back; both hold the newest value only, and nobody ever blocks.

#include <passive_haptics/passive_haptics.hpp>

#include <chrono>
#include <cstdio>
#include <thread>
#include <utility>

namespace ph = passive_haptics;
using scene = ph::space<float, 3>;
using plane = ph::half_space<scene>;
struct felt {
  scene::coordinates position, force;  // scene::vector is Eigen's and stays in its thread
};

/// Any slow simulation: here a soft plane that gives way to the device, a little more each time.
void environment(ph::exchange<plane>& to_loop, ph::exchange<felt>& from_loop) {
  float height = 0;
  for (int updates = 20; updates > 0;) {
    std::this_thread::sleep_for(std::chrono::milliseconds(3));  // solving …
    const felt* newest = from_loop.take();
    if (newest == nullptr) continue;
    if (newest->position[2] < height) height -= 1e-4F;
    const float K = --updates == 0 ? 1000 : 500;  // N/m; marks the last one
    to_loop.publish({.point = {0, 0, height}, .normal = {0, 0, 1}, .stiffness = K});
  }
}

int main() {
  ph::exchange<plane> to_loop;
  ph::exchange<felt> from_loop;
  auto touch = ph::make_touch<scene>(
      {.mass = 0.1, .damping = 0.5, .force_limit = 9, .longest_tick = 2e-3}, {.force = 5});
  std::thread world([&] { environment(to_loop, from_loop); });
  scene::vector x(0, 0, -0.001F);
  bool good = true;
  auto now = std::chrono::steady_clock::now();
  while (touch.target().stiffness < 1000) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));  // until the next tick is due
    if (x(2) > -0.005F) x(2) -= 1e-4F;                          // a hand that presses on
    const auto before = std::exchange(now, std::chrono::steady_clock::now());
    if (const plane* newest = to_loop.take()) touch.update(*newest);
    const auto out = touch.tick(x, now - before);
    from_loop.publish({x, out.force});
    good = good && out.force(2) >= 0 && out.energy >= 0;
  }
  world.join();
  std::printf("last plane received, lowered by %.1f mm\n",
              -1e3 * static_cast<double>(scene::vector(touch.target().point)(2)));
  std::printf("force never inwards, energy never below zero: %s\n", good ? "yes" : "no");
}
