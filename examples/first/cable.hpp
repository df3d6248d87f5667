// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A handle behind a cable: 10 of 100 g move with the motor and its encoder, and the cable rings at 75 Hz. A hand that
// shakes it in tune draws energy from what was told the mass alone, and none from what was told the cable.
#include <passive_haptics/compliant/compositions.hpp>
#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/simulation/compliant_device.hpp>

#include <cmath>
#include <cstdio>

namespace ph = passive_haptics;
namespace sim = ph::simulation;
using scene = ph::space<double, 1>;
using plane = ph::half_space<scene>;

constexpr ph::exact_device device{
    .mass = 0.1, .damping = 0.1, .force_limit = 9, .longest_tick = 1e-3};
inline const ph::chain_transmission<2> cable{
    ph::two_masses(0.1, 0.1, 75, 0.03, 0.1)};  // kg, share, Hz, ζ, N·s/m

/// Pushes with 2.5 N onto a wall, and with 2.5 N to and fro; onto the wall opposite after every `turns` seconds.
struct shaking_hand {
  double rate = 471.2;  ///< [rad/s]
  double turns = 1e9;   ///< [s]
  double force(double t, double, double) const {
    return (std::fmod(t, 2 * turns) < turns ? -2.5 : 2.5) + 2.5 * std::sin(rate * t);
  }
  double mass() const { return 0.0; }
  ph::parameter_fault check() const { return {}; }
};

/// The energy that the hand draws from a port in ten seconds [J]; tick(sample) is its tick.
inline double drawn_from(const char* told, const auto& port, const shaking_hand& hand,
                         const auto& tick) {
  sim::compliant_device<scene, shaking_hand> handle(
      {.mass = 0.1, .share = 0.1, .mode = 75, .start = 0.01}, hand);
  auto sample = handle.exchange(0);
  for (int ms = 0; ms < 10000; ++ms) sample = handle.exchange(tick(sample).force);
  std::printf("told %s: %.1f mJ drawn, at most %.0f N/m shown\n", told,
              -1e3 * handle.minimum() + 0.0, port.explain().shown);
  return -handle.minimum();
}
