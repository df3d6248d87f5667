// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Devices whose encoders have steps, with a ledger that may or may not know of them.
#include "support/scenes.hpp"
#include <passive_haptics/simulation/adversary.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/prescribed_motion.hpp>

#include <algorithm>
#include <utility>

namespace sim = ph::simulation;

inline constexpr double step = 6e-5;  // [m]

constexpr ph::quantised_energy sure(double quantum = step) {
  return {.damping = 0.03, .quantum = quantum};
}

/// strict_bound on this ledger against a motion that no force can stop; least port energy.
template <class Space, class Motion>
double attacked(const auto& observer, Motion motion, std::uint64_t seed) {
  using state = typename sim::physical<Space>::vector;
  auto model = following_half_space<Space>(ph::spring{}, observer, ph::strict_bound{});
  sim::random_source random(seed);
  const state normal = random.direction<Space>();
  sim::jumping_surface jumps(5e-4, seed);
  sim::prescribed_motion<Space> device({.damping = 0.03, .quantum = step});
  auto sample = device.exchange(Space::zero());
  double offset = 1.0;
  for (int n = 0; n < 2000; ++n) {
    const double moved = jumps.offset(device.time());
    if (moved != offset) {
      offset = moved;
      (void)model.update({state(normal * offset), normal, 2e4});
    }
    const auto out = model.tick(sample);
    const double depth = offset - sim::physical<Space>::dot(device.position(), normal);
    device.move_to(motion.next(
        {.position = device.position(), .normal = normal, .depth = depth, .force = out.force},
        random));
    sample = device.exchange(out.force);
  }
  return device.meter().minimum();
}

/// The worst of seven motions and so many seeds.
template <class Space>
double worst_attack(const auto& observer, std::uint64_t seeds) {
  double worst = 0.0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    for (const double speed : {0.5, 0.06, 0.03}) {
      const sim::random_walk<Space> walk{.speed = speed};
      const sim::greedy_motion<Space> greedy{.speed = speed};
      worst = std::min(
          {worst, attacked<Space>(observer, walk, seed), attacked<Space>(observer, greedy, seed)});
    }
    const sim::nyquist_motion<Space> to_and_fro{.amplitude = 2.9e-5};
    worst = std::min(worst, attacked<Space>(observer, to_and_fro, seed));
  }
  return worst;
}

/// A random hand on random forces: the most by which the observer exceeds the truth [J].
template <class Space>
double worst_overstatement(const auto& parameters, double amplitude, std::uint64_t seed) {
  using state = typename sim::physical<Space>::vector;
  auto observer = at<Space>(parameters);
  sim::random_source random(seed);
  sim::prescribed_motion<Space> device({.damping = 0.03, .quantum = step});
  auto sample = device.exchange(Space::zero());
  typename Space::vector last = sample.position;
  state force = Space::zero();
  double worst = -1.0;
  for (int n = 0; n < 3000; ++n) {
    // A force that changes with the true position within the step: what hurts most.
    if (random.chance(0.5)) force = state(random.direction<Space>() * 5.0);
    const double toward = random.chance(0.5) ? 1.0 : -1.0;
    device.move_to(device.position() + force * (toward * amplitude * random.uniform() / 5.0));
    sample = device.exchange(force);
    (void)observer.update(typename Space::vector(sample.position) - last, sample.held, sample.dt);
    last = sample.position;
    worst = std::max(worst, observer.value() - device.meter().value());
  }
  return worst;
}
/// The worst of it over many hands: by the ledger that knows of the steps, and by the plain one.
template <class Space>
std::pair<double, double> overstatements() {
  double plain = -1.0, worst = -1.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (const double amplitude : {1e-5, 1e-4, 1e-3}) {
      worst = std::max(worst, worst_overstatement<Space>(sure(), amplitude, seed));
      plain = std::max(plain, worst_overstatement<Space>(thesis_ledger(), amplitude, seed));
    }
  }
  return {worst, plain};
}
