// SPDX-License-Identifier: BSD-3-Clause
// A handle behind a cable: 10 of 100 g move with the motor and its encoder, and the cable rings at 75 Hz. A hand that
// shakes it in that tune draws energy from a wall that was told the mass alone; from one that was told the cable, none.
#include <passive_haptics/compliant/compositions.hpp>
#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/simulation/compliant_device.hpp>

#include <cmath>
#include <cstdio>

namespace ph = passive_haptics;
namespace sim = ph::simulation;
using scene = ph::space<double, 1>;

/// Pushes with 2.5 N onto the wall, and with 2.5 N to and fro.
struct shaking_hand {
  double force(double t, double, double) const { return -2.5 + 2.5 * std::sin(471.2 * t); }
  double mass() const { return 0.0; }
  ph::parameter_fault check() const { return {}; }
};

template <class Touch>
double drawn_from(const char* told, Touch touch) {
  sim::compliant_device<scene, shaking_hand> device(
      {.mass = 0.1, .share = 0.1, .mode = 75, .start = 0.01});
  if (!touch.update({.point = 0, .normal = 1, .stiffness = 8000})) return 1;
  auto sample = device.exchange(0);
  for (int ms = 0; ms < 10000; ++ms) sample = device.exchange(touch.tick(sample).force);
  const auto e = touch.explain();
  std::printf("told %s: %.1f mJ drawn, of %.0f N/m it shows %.0f\n", told,
              -1e3 * device.minimum() + 0.0, e.asked, e.shown);
  return -device.minimum();
}

int main() {
  constexpr ph::exact_device device{
      .mass = 0.1, .damping = 0.1, .force_limit = 9, .longest_tick = 1e-3};
  const ph::chain_transmission<2> cable{
      ph::two_masses(0.1, 0.1, 75, 0.03, 0.1)};  // kg, share, Hz, ζ, N·s/m
  const double untold = drawn_from("the mass", ph::make_touch<scene>(device, {.force = 5}));
  const double is_told =
      drawn_from("the cable", ph::make_touch<scene>(device, cable, {.force = 5}));
  return untold > 1e-3 && is_told < 1e-9 ? 0 : 1;
}
