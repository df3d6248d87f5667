// SPDX-License-Identifier: BSD-3-Clause
// The tutorial's third step: your device. What the library asks of it, and what a tick says when the loop
// is late or a sample is bad.

#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/runner/haptic_device.hpp>

#include <cstdio>

namespace ph = passive_haptics;
using scene = ph::space<double, 1>;

/// What stands for the functions of a vendor here: a slider that is pushed in by 0.05 mm a tick, a loop
/// that once takes 3 ms, and a cable that once falls silent.
namespace vendor {
int tick = 0;
bool read_counts(double& counts) {
  ++tick;
  counts = 1000 - 10 * tick;
  return tick != 40;
}
double seconds_since_last() {
  return tick == 30 ? 3e-3 : 1e-3;
}
void set_motor(double /*newtons*/) {}
}  // namespace vendor

struct my_device {
  static constexpr double metres_per_count = 5e-6;

  ph::device_sample<scene> exchange(const double& force) noexcept {
    vendor::set_motor(force);  // at once: set after the sample, it would be held a tick late
    double counts = 0;
    const bool there = vendor::read_counts(counts);         // when the next period begins
    return {.position = metres_per_count * (counts - 800),  // m, the surface at 0
            .held = force,                                  // N, what the motor held until now
            .dt = vendor::seconds_since_last(),             // s, measured
            .valid = there};
  }
};
static_assert(ph::haptic_device<my_device>);

int main() {
  auto touch = ph::make_touch<scene>(
      {.mass = 0.1, .damping = 0.1, .force_limit = 9, .longest_tick = 1.2e-3}, {.force = 5});
  if (const auto fault = touch.check()) {
    std::printf("%s = %g: it must be %s\n", fault.parameter, fault.value, fault.remedy);
    return 1;
  }
  if (!touch.update({.point = 0, .normal = 1, .stiffness = 1000})) return 1;

  my_device device;
  double force = 0;
  for (int ms = 1; ms <= 50; ++ms) {
    const auto out = touch.tick(device.exchange(force));
    force = out.force;
    if (ms % 10 == 0) std::printf("%2d: %4.2f N, %s\n", ms, out.force, ph::to_string(out.what));
  }
}
