// SPDX-License-Identifier: BSD-3-Clause
// What the Python module must find: a device, a hand and a touch, composed and run here without it. A
// line for each scene: where the device ends, the least port energy, the sum of all forces.
#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/friction_elastic.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace ph = passive_haptics;
namespace sim = ph::simulation;
using line = ph::space<double, 1>;
using scene = ph::space<double, 3>;
using hand = sim::impedance_hand<line>;

namespace {

constexpr double period = 1e-3;
constexpr hand person{.stiffness = 200.0, .damping = 2.0, .limit = 5.0, .target = -0.01};

template <class Touch, class Device>
void run(Touch touch, Device device, double stiffness) {
  touch.update({scene::zero(), scene::vector(0, 0, 1), stiffness});
  double least = std::numeric_limits<double>::infinity();
  double sum = 0.0;
  double end = 0.0;
  auto sample = device.exchange(0.0);
  for (int n = 0; n < 1000; ++n) {
    const double force =
        touch.tick(scene::vector(0, 0, sample.position), ph::seconds{sample.dt}).force(2);
    least = std::min(least, device.meter().with_friction());
    sum += force;
    end = device.position();
    sample = device.exchange(force);
  }
  std::printf("%a %a %a\n", end, least, sum);
}

}  // namespace

int main() {
  const double longest = period * 1.000001;
  run(ph::make_touch<scene>(
          {.mass = 0.1, .damping = 0.03, .force_limit = 9, .longest_tick = longest}, {.force = 5}),
      sim::device<line, hand>({.mass = 0.1, .damping = 0.03, .force_limit = 9, .start = 0.02},
                              person),
      3000.0);
  constexpr double c = 0.13;
  constexpr double p = 15e-6;
  constexpr double q = 20e-6;
  run(ph::make_touch<scene>(ph::encoder_device{.mass = 0.045,
                                               .damping = 0.05,
                                               .friction = c,
                                               .presliding = p,
                                               .quantum = q,
                                               .force_limit = 3.3,
                                               .longest_tick = longest},
                            {.force = 5.0 + c}),
      sim::device<line, hand, sim::slider_and_spring>(
          {.mass = 0.045, .damping = 0.05, .force_limit = 3.3, .quantum = q, .start = 0.02}, person,
          {.level = {c}, .presliding = {p}}),
      2000.0);
}
