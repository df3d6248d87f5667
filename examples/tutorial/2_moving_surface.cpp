// SPDX-License-Identifier: BSD-3-Clause
// The tutorial's second step: the surface moves, and is published 30 times a second. Once a spring takes
// it as it comes, once a touch follows it.

#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/simulation/device.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace ph = passive_haptics;
namespace sim = ph::simulation;
using scene = ph::space<double, 1>;
using plane = ph::half_space<scene>;

/// A surface that breathes by 3 mm once a second.
plane world(int ms) {
  return {.point = 0.003 * std::sin(2 * 3.14159265 * 1e-3 * ms), .normal = 1, .stiffness = 2000};
}

/// Presses into it for 3 s; force(sample, news) is called a thousand times a second, news is rarely there.
void press(const char* how, auto force) {
  sim::device<scene, sim::impedance_hand<scene>> device{
      {.mass = 0.1, .damping = 0.1, .start = 0.01},
      {.stiffness = 300, .limit = 5, .target = -0.01}};
  auto sample = device.exchange(0);
  double largest_step = 0, last = 0;
  plane news;
  for (int ms = 0; ms < 3000; ++ms) {
    const bool told = ms % 33 == 0;
    if (told) news = world(ms);
    const double f = force(sample, told ? &news : nullptr);
    if (ms > 500) largest_step = std::max(largest_step, std::abs(f - last));
    last = f;
    sample = device.exchange(f);
  }
  std::printf("%-7s largest step of the force %4.2f N, created %5.1f mJ\n", how, largest_step,
              0 - 1e3 * device.meter().minimum());
}

int main() {
  plane told;
  press("spring:", [&](const auto& now, const plane* news) {
    if (news != nullptr) told = *news;
    return told.stiffness * std::max(told.at(now.position).depth, 0.0);
  });

  auto touch = ph::make_touch<scene>(
      {.mass = 0.1, .damping = 0.1, .force_limit = 9, .longest_tick = 1e-3}, {.force = 5});
  press("touch:", [&](const auto& now, const plane* news) {
    if (news != nullptr) touch.update(*news);
    return touch.tick(now).force;
  });
}
