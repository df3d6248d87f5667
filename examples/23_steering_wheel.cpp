// SPDX-License-Identifier: BSD-3-Clause
// A steering wheel with end stops: one degree of freedom that turns. Nothing in the library knows a metre
// from a radian, so one stands for the other in every parameter; `rotary` chooses the defaults that are a
// length or a speed.
//
//   position m → rad     speed m/s → rad/s            force N → N·m
//   mass kg → kg·m²      damping N·s/m → N·m·s/rad    stiffness N/m → N·m/rad
//
// Joules stay joules, and so do the promises. No Eigen is needed.

#include <passive_haptics/compositions.hpp>
#include <passive_haptics/simulation/device.hpp>

#include <cstdio>

namespace ph = passive_haptics;
namespace sim = ph::simulation;
using joint = ph::space<double, 1>;  // rad, N·m
using stop = ph::half_space<joint>;

constexpr double inertia = 0.02, damping = 0.02;    // kg·m² and N·m·s/rad: lower bounds
constexpr double driver_most = 6, motor_most = 20;  // N·m
constexpr double degree = 3.14159265358979 / 180;

int main() {
  auto wheel = ph::make_contacts<joint>({.mass = inertia,
                                         .damping = damping,
                                         .force_limit = motor_most,
                                         .longest_tick = 1e-3,  // s
                                         .rotary = true},
                                        {.force = driver_most}, ph::slots<stop, 2>{});
  wheel.source().update(0, stop{.point = 140 * degree, .normal = -1, .stiffness = 400});  // N·m/rad
  wheel.source().update(1, stop{.point = -140 * degree, .normal = 1, .stiffness = 400});

  sim::device<joint, sim::constant_hand<joint>> device{
      {.mass = inertia, .damping = damping, .friction = 0.05, .force_limit = motor_most}, {}};
  auto sample = device.exchange(0);
  const auto drive = [&](const char* what, double torque, int ms) {
    device.hand().push = torque;
    double force = 0;
    for (int n = 0; n < ms; ++n) sample = device.exchange(force = wheel.tick(sample).force);
    std::printf("%-15s %6.1f deg  %4.1f rad/s  stop %5.1f N·m\n", what, sample.position / degree,
                device.velocity() + 0.0, force + 0.0);
  };
  drive("turned left", 2, 200);
  drive("into the stop", 2, 800);
  drive("pressed harder", driver_most, 500);
  drive("let go", 0, 500);
  drive("thrown right", -1, 500);
  drive("held there", -1, 1000);
  std::printf("the port has created %.1f mJ\n", -1e3 * device.meter().minimum() + 0.0);
}
