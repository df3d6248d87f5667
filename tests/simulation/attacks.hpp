// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Prescribed motions against any composition, judged by the exact port-energy meter and never by the
// observer.
#include "support/scenes.hpp"
#include <passive_haptics/simulation/adversary.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/loop.hpp>
#include <passive_haptics/simulation/prescribed_motion.hpp>
#include <passive_haptics/simulation/subject.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace sim = ph::simulation;

namespace simulated {

/// What a run may vary besides the motion.
struct conditions {
  bool jumping = true;  ///< the surface jumps by up to ±2 mm, its normal turns anywhere
  bool jitter = false;  ///< periods of 0.5 to 1.5 ms
  int latency = 0;      ///< of the actuators, in ticks
  int ticks = 600;
};

enum class motion : int { nyquist, random, greedy, jumps };
inline constexpr std::array all_motions{motion::nyquist, motion::random, motion::greedy,
                                        motion::jumps};

/// One prescribed motion against one model; the least true port energy [J].
template <class Space>
double attack(const sim::subject<Space>& model, motion by, const conditions& when,
              std::uint64_t seed) {
  using state = typename sim::physical<Space>::vector;
  sim::random_source random(seed);
  sim::prescribed_motion<Space> device({.damping = 0.03, .latency = when.latency});
  sim::jumping_surface jumps(2e-3, seed);
  sim::switching_stiffness stiffness(2e3, 22e3, seed + 1);
  sim::surface_state<Space> surface{.normal = random.direction<Space>(),
                                    .stiffness = stiffness.stiffness(0.0)};
  sim::nyquist_motion<Space> nyquist;
  double offset = 0.0;
  model.update(surface);
  const auto world = [&](const auto& now) {
    if (when.jitter) device.set_period(random.uniform(0.5e-3, 1.5e-3));
    if (!when.jumping || (by == motion::nyquist && seed % 2 != 0)) return;
    const double moved = jumps.offset(now.time);
    const double switched = stiffness.stiffness(now.time);
    if (moved == offset && switched == surface.stiffness) return;
    offset = moved;
    const state normal = random.direction<Space>();
    surface = {state(normal * offset), normal, switched};
    model.update(surface);
  };
  const auto hand = [&](const auto& now) {
    const sim::adversary_view<Space> view{.position = now.position,
                                          .normal = surface.normal,
                                          .depth = surface.depth(now.position),
                                          .force = sim::to_physical<Space>(now.force),
                                          .dt = static_cast<double>(now.sample.dt),
                                          .damping = 0.03};
    switch (by) {
      case motion::nyquist:
        return device.move_to(nyquist.next(view, random));
      case motion::random:
        return device.move_to(sim::random_walk<Space>{}.next(view, random));
      case motion::greedy:
        return device.move_to(sim::greedy_motion<Space>{}.next(view, random));
      case motion::jumps:  // a slow hand: what is lost, the surface gave
        return device.move_to(sim::random_walk<Space>{.speed = 0.02}.next(view, random));
    }
  };
  return sim::run(device, model, when.ticks, world, hand).least_energy;
}

/// The same against a copy of the model.
template <class Space, class Model>
double attack_by(motion kind, const Model& model, const conditions& when, std::uint64_t seed) {
  const sim::usual_lay<Model> lay{};
  sim::under_test<Model, sim::usual_lay<Model>> tested{model, model, lay};
  return attack(sim::subject<Space>(tested), kind, when, seed);
}

/// The parts of a composition with a surface that turns and jumps, in any space.
template <class Law, class Bound, class Limits = ph::loop_limits>
struct composition {
  Law law{};
  Bound bound{};
  Limits limits = thesis_loop;

  template <class Space>
  [[nodiscard]] auto in() const {
    return ph::local_model{Space{},
                           ph::followed<ph::half_space<Space>>{},
                           ph::turn_limited{.rate = 4.0},
                           law,
                           thesis_ledger<Space>(),
                           bound,
                           limits};
  }
};

template <class Law, class Bound, class Limits = ph::loop_limits>
constexpr composition<Law, Bound, Limits> composed(const Law& law, const Bound& bound,
                                                   const Limits& limits = thesis_loop) {
  return {law, bound, limits};
}
/// The thesis's own rule, with nothing behind it.
inline constexpr ph::shaped thesis_spring{ph::spring{}, ph::thesis_rule{}};

/// The least port energy of `runs` runs over all four motions and 1, 2 and 3 dimensions.
template <class Law, class Bound, class Limits>
double worst_of(const composition<Law, Bound, Limits>& made, int runs, const conditions& when) {
  double worst = 0.0;
  for (int run = 0; run < runs; ++run) {
    const auto kind = static_cast<motion>(run % 4);
    const auto seed = static_cast<std::uint64_t>(run) + 1;
    switch (run / 4 % 3) {
      case 0:
        worst = std::min(worst, attack_by<d1>(kind, made.template in<d1>(), when, seed));
        break;
      case 1:
        worst = std::min(worst, attack_by<d2>(kind, made.template in<d2>(), when, seed));
        break;
      default:
        worst = std::min(worst, attack_by<d3>(kind, made.template in<d3>(), when, seed));
    }
  }
  return worst;
}

/// A hand that taps with 5 N on a device of 0.1 kg, every twentieth sample being no number; the least
/// port energy over the seeds 1, 2, ...
template <class Law, class Bound, class Limits>
double worst_with_lost_samples(const Law& law, const Bound& bound, const Limits& limits,
                               std::uint64_t seeds) {
  double worst = 0.0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    auto model = following_half_space<d1>(law, thesis_ledger(), bound, limits);
    sim::random_source random(seed);
    const double K = random.uniform(500.0, 20000.0);
    model.update(wall<d1>(K));
    sim::device<d1, sim::tapping_hand<d1>> device(
        {.mass = 0.1, .start = -1e-3, .latency = Limits::latency},
        {.surface = 0.0, .normal = -1.0, .limit = 5.0});
    const auto world = [&](auto& now) {
      if (now.tick % 35 == 0) model.update({random.uniform(-2e-3, 2e-3), -1.0, K});
      if (random.chance(0.05)) now.sample.position = std::nan("");
    };
    worst = std::min(worst, sim::run(device, model, 2000, world).least_energy);
  }
  return worst;
}

}  // namespace simulated
