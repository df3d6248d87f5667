// SPDX-License-Identifier: BSD-3-Clause
// Force Dimension's DHD: a floor for an omega, felt for a minute. The SDK says how heavy the handle is.
//
// Tried: compiled against the signatures that Force Dimension publishes, not linked. The adapter has been
// run with an SDK of our own behind the same declarations.

#include <passive_haptics/adapters/force_dimension.hpp>
#include <passive_haptics/passive_haptics.hpp>

#include <cstdio>

namespace ph = passive_haptics;
using scene = ph::space<double, 3>;

int complain(const ph::parameter_fault& fault) {
  std::fprintf(stderr, "%s is %g, and should be %s\n", fault.parameter, fault.value, fault.remedy);
  return 1;
}

int main() {
  ph::adapters::force_dimension<scene> omega;
  if (const auto fault = omega.open()) return complain(fault);
  // The SDK knows no damping: state less than your device has, and a hand stronger than any that will hold it.
  auto touch = ph::make_touch<scene>({.mass = 0.8 * omega.least_mass(),
                                      .damping = 0.1,
                                      .force_limit = 12.0,
                                      .longest_tick = 0.001},
                                     {.force = 10.0});
  if (const auto fault = touch.check()) return complain(fault);
  touch.update({.point = {0.0, 0.0, 0.0}, .normal = {0.0, 0.0, 1.0}, .stiffness = 4000.0});
  auto sample = omega.exchange(scene::zero());
  for (const double end = dhdGetTime() + 60.0; dhdGetTime() < end;) {
    touch.enable_forces(omega.forces_on());             // its button may have switched them off
    sample = omega.exchange(touch.tick(sample).force);  // the call paces the loop
  }

  std::printf("%lu ticks saturated, %lu failed\n", omega.saturated(), omega.failed());
  return omega.failed() == 0 ? 0 : 1;
}
