// SPDX-License-Identifier: BSD-3-Clause
// OpenHaptics: a floor for a Touch, published once by this thread, felt in the driver's servo thread.
//
// Tried: compiled against the headers of OpenHaptics 3.0, not linked: nobody may ship its library. The
// adapter has been run with a driver of our own behind the same declarations.

#include <passive_haptics/adapters/open_haptics.hpp>
#include <passive_haptics/passive_haptics.hpp>

#include <chrono>
#include <cstdio>
#include <thread>

namespace ph = passive_haptics;
using scene = ph::space<double, 3>;
using plane = ph::half_space<scene>;

int complain(const ph::parameter_fault& fault) {
  std::fprintf(stderr, "%s is %g, and should be %s\n", fault.parameter, fault.value, fault.remedy);
  return 1;
}

int main() {
  ph::exchange<plane> inbox;
  // State less mass and damping than your device has, and a hand stronger than any that will hold it.
  ph::adapters::open_haptics touch{
      ph::make_touch<scene>(
          {.mass = 0.045, .damping = 0.05, .force_limit = 3.3, .longest_tick = 0.002},
          {.force = 5.0}),
      [&inbox](auto& wall, const auto&) {
        if (const plane* news = inbox.take()) wall.update(*news);
      }};
  if (const auto fault = touch.open()) return complain(fault);
  if (const auto fault = touch.start()) return complain(fault);
  hdStartScheduler();  // once, for all devices

  inbox.publish({.point = {0.0, 0.0, 0.0}, .normal = {0.0, 1.0, 0.0}, .stiffness = 500.0});
  std::this_thread::sleep_for(std::chrono::minutes(1));

  touch.stop();
  hdStopScheduler();
  std::printf("the ledger ends at %.1f mJ, %lu errors\n", 1e3 * touch.last().energy,
              touch.errors());
  return touch.stopped_by() == HD_SUCCESS ? 0 : 1;
}
