// SPDX-License-Identifier: BSD-3-Clause
// Two walls on one device: a floor and a wall that meet in a corner, in ONE passive port.
//
// One local model for each wall looks as good, and both types say `strict`. But each of them counts
// the whole damping of the device as its own and spends it, so the hand is paid twice for it. The
// rule is one port per device; several contacts are one source of it.

#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/simulation/device.hpp>

#include <cmath>
#include <cstdio>

namespace ph = passive_haptics;
namespace sim = ph::simulation;
using scene = ph::space<double, 2>;
using vector = scene::vector;

/// A hand of 5 N drives into the corner, and out again as soon as it is inside, for two seconds.
void attack(const char* name, auto force_at) {
  const double r = std::sqrt(0.5);
  sim::device<scene, sim::tapping_hand<scene>> device{
      {.mass = 0.1, .damping = 0.1, .start = {0.005, 0.005}}, {.normal = {r, r}, .limit = 5.0}};
  auto sample = device.exchange(vector::Zero());
  for (int tick = 0; tick < 2000; ++tick) sample = device.exchange(force_at(sample.position));
  std::printf("%-16s least port energy %5.1f mJ\n", name, device.meter().minimum() * 1e3);
}

int main() {
  const ph::fixed ground{ph::half_space<scene>{{0, 0}, {0, 1}, 3000}};  // a point, n, K
  const ph::fixed side{ph::half_space<scene>{{0, 0}, {1, 0}, 3000}};
  const ph::reduced_energy ledger{.damping = 0.1};
  const ph::loop_limits limits{.longest_tick = 1e-3};

  const ph::local_contact floor{ground, ph::turn_at_once{}, ph::spring{}};
  const ph::local_contact wall{side, ph::turn_at_once{}, ph::spring{}};
  ph::passive_port corner{scene{}, ph::contacts{floor, wall}, ledger, ph::strict_bound{}, limits};
  attack("one port", [&](const vector& x) { return corner.tick(x, 1e-3).force; });

  const auto alone = [&](const auto& plane) {
    return ph::local_model{
        scene{}, plane, ph::turn_at_once{}, ph::spring{}, ledger, ph::strict_bound{}, limits};
  };
  auto one = alone(ground), other = alone(side);
  static_assert(decltype(one)::passivity == ph::guarantee::strict);  // and yet, on one device:
  attack("two local models", [&](const vector& x) -> vector {
    return one.tick(x, 1e-3).force + other.tick(x, 1e-3).force;
  });
}
