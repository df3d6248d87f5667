// SPDX-License-Identifier: BSD-3-Clause
// Two walls of a groove, 20 mm apart, felt at a handle behind a cable of 75 Hz: 10 of 100 g move with the motor. A hand
// that pushes to and fro in that tune draws energy from contacts that were told the mass alone.
#include <passive_haptics/compliant/compositions.hpp>
#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/simulation/compliant_device.hpp>

#include <cmath>
#include <cstdio>

namespace ph = passive_haptics;
namespace sim = ph::simulation;
using scene = ph::space<double, 1>;
using plane = ph::half_space<scene>;

/// Pushes with 2.5 N, and with 2.5 N to and fro: onto one wall for a second, then onto the other.
struct shaking_hand {
  double force(double t, double, double) const {
    return (std::fmod(t, 2.0) < 1.0 ? -2.5 : 2.5) + 2.5 * std::sin(471.2 * t);
  }
  double mass() const { return 0.0; }
  ph::parameter_fault check() const { return {}; }
};

double drawn_from(const char* told, auto groove) {
  groove.source().update(0, plane{.point = 0.00, .normal = 1, .stiffness = 8000});
  groove.source().update(1, plane{.point = 0.02, .normal = -1, .stiffness = 8000});
  sim::compliant_device<scene, shaking_hand> device(
      {.mass = 0.1, .share = 0.1, .mode = 75, .start = 0.01});
  auto sample = device.exchange(0);
  for (int ms = 0; ms < 10000; ++ms) sample = device.exchange(groove.tick(sample).force);
  std::printf("told %s: %.1f mJ drawn\n", told, -1e3 * device.minimum() + 0.0);
  return -device.minimum();
}

int main() {
  constexpr ph::exact_device device{
      .mass = 0.1, .damping = 0.1, .force_limit = 9, .longest_tick = 1e-3};
  const ph::chain_transmission<2> cable{
      ph::two_masses(0.1, 0.1, 75, 0.03, 0.1)};  // kg, share, Hz, ζ, N·s/m
  const ph::slots<plane, 2> walls{};
  const double untold =
      drawn_from("the mass", ph::make_contacts<scene>(device, {.force = 5}, walls));
  const double is_told =
      drawn_from("the cable", ph::make_contacts<scene>(device, cable, {.force = 5}, walls));
  return untold > 1e-3 && is_told < 1e-9 ? 0 : 1;
}
