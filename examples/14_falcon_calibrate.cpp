// SPDX-License-Identifier: BSD-3-Clause
// Finds the gain k of your Falcon, DAC counts per N·m, with a spring scale hooked to the grip.
//     14_falcon_calibrate [firmware.bin]
//     14_falcon_calibrate --simulate     a simulated Falcon, whose gain is 4100; it reads itself
//
// The force asked for is F = words/k₀ at the gain assumed; the one felt is words/k, so
//     k = k₀ F/F_measured,     F_measured = ½ (F₊ + F₋)
// where the two directions of an axis are averaged: weight and dry friction drop out.

#include "falcon_ready.hpp"

constexpr double assumed = falcon::cautious_gain<double>;
constexpr double asked = 2;  // N, along one axis

/// Holds the force for four seconds and returns what the scale said [N].
template <class Device>
double measure(Device& grip, const scene::vector& force) {
  for (int n = 0; n < 4000; ++n) (void)grip.exchange(force);
  if constexpr (requires { grip.line().peer(); }) {
    const auto& arms = grip.line().peer().mechanism();
    const auto p = arms.body().position();
    const auto A = falcon::rates({{p(0), p(1), p(2)}}, arms.theta());
    const auto f = falcon::force_from(A, arms.torque());
    return scene::vector(f[0], f[1], f[2]).dot(force) / force.norm();
  } else {
    (void)grip.exchange(scene::zero());  // nobody exchanges while you type
    std::printf("what did the scale say along %+.0f %+.0f %+.0f, in newtons? ", force(0) / asked,
                force(1) / asked, force(2) / asked);
    double newtons = 0;
    return std::scanf("%lf", &newtons) == 1 ? newtons : 0.0;
  }
}

template <class Device>
int calibrate(Device& grip) {
  std::puts("hold the grip still against the scale: 4 s each along +x -x +y -y +z -z");
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    scene::vector force = scene::zero();
    force(axis) = asked;
    const double mean = (measure(grip, force) + measure(grip, -force)) / 2;
    if (!(mean > 0.1)) return std::puts("that is no force: is the wall power on?"), 1;
    const double k = assumed * asked / mean;
    std::printf("%c: %.2f N asked, %.2f N measured, k = %.0f\n", "xyz"[axis], asked, mean, k);
    sum += k;
  }
  std::printf("k = %.0f counts per N·m; three axes far apart say that k is no constant\n", sum / 3);
  return 0;
}

int main(int argc, char** argv) {
  const ph::simulation::impedance_hand<scene> hand{.stiffness = 900, .target = {0, 0, 0.125}};
  return with_falcon(argc, argv, assumed, {.gain = 4100, .runs = true, .homed = true}, hand,
                     [](auto& grip) { return calibrate(grip); });
}
