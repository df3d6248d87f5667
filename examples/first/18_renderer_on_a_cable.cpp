// SPDX-License-Identifier: BSD-3-Clause
// A force that somebody's renderer makes, a wall of 8 kN/m, at a handle behind a cable of 75 Hz: 10 of 100 g move with
// the motor. A hand that shakes it at 31 Hz draws energy from a guard that was told the mass alone.
#include <passive_haptics/compliant/compositions.hpp>
#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/simulation/compliant_device.hpp>

#include <cmath>
#include <cstdio>

namespace ph = passive_haptics;
namespace sim = ph::simulation;
using scene = ph::space<double, 1>;

double renderer(double x) {
  return x < 0 ? -8000 * x : 0;
}

/// Pushes with 2.5 N onto the wall, and with 2.5 N to and fro.
struct shaking_hand {
  double force(double t, double, double) const { return -2.5 + 2.5 * std::sin(197.2 * t); }
  double mass() const { return 0.0; }
  ph::parameter_fault check() const { return {}; }
};

double drawn_from(const char* told, auto guard) {
  sim::compliant_device<scene, shaking_hand> device(
      {.mass = 0.1, .share = 0.1, .mode = 75, .start = 0.01});
  auto sample = device.exchange(0);
  for (int ms = 0; ms < 10000; ++ms) {
    sample = device.exchange(guard.tick(sample, renderer(sample.position)).force);
  }
  std::printf("told %s: %.1f mJ drawn\n", told, -1e3 * device.minimum() + 0.0);
  return -device.minimum();
}

int main() {
  constexpr ph::exact_device device{
      .mass = 0.1, .damping = 0.1, .force_limit = 9, .longest_tick = 1e-3};
  const ph::chain_transmission<2> cable{
      ph::two_masses(0.1, 0.1, 75, 0.03, 0.1)};  // kg, share, Hz, ζ, N·s/m
  const double untold = drawn_from("the mass", ph::make_guard<scene>(device, {.force = 5}));
  const double is_told =
      drawn_from("the cable", ph::make_guard<scene>(device, cable, {.force = 5}));
  return untold > 1e-3 && is_told < 1e-9 ? 0 : 1;
}
