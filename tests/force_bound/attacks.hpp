// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Attacks that try to draw energy out of a composed model, judged by the true energy at the port. All are compiled
// once per space, so another model costs only the compilation of its tick.
//
//   worst_of         motions that no force can stop, in a world and a loop that may do anything
//   tapped           a hand of 5 N that taps a wall that jumps
//   drop             S0 of docs/design/mathematics.md § 5: a mass falls on a wall
#include "force_bound/victim.hpp"
#include <passive_haptics/simulation/adversary.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/prescribed_motion.hpp>

#include <algorithm>
#include <array>
#include <vector>

namespace attacks {

inline constexpr double inf = std::numeric_limits<double>::infinity();

/// What a run may vary besides the motion.
struct conditions {
  bool jitter = false;         ///< periods of 0.5 ms to `slowest`
  double slowest = 1.5e-3;     ///< [s]
  double lost = 0.0;           ///< share of the samples
  double late = 0.0;           ///< share of periods of 1 to 6 longest ticks
  bool watchdog = true;        ///< that drops the force after the longest tick
  double longest_tick = 1e-3;  ///< stated to the model [s]
  double force_limit = inf;    ///< of the motors [N]
  double gain = 1.0;           ///< held over commanded
  double quantum = 0.0;        ///< of the encoders [m]
  int latency = 0;             ///< of the motors, in ticks
  double friction = 0.0;       ///< dry friction that is there [N]
  std::array<double, 3> b{0.03, 0.03, 0.03};
  bool jumping = true;  ///< the surface jumps by up to ±2 mm, its normal and stiffness change
  double low = 2e3;     ///< the stiffness switches between the two [N/m]
  double high = 22e3;   ///<
  int ticks = 600;
};

struct outcome {
  double least = 0.0;    ///< energy at the port [J]
  double through = 0.0;  ///< energy that went through it, either way [J]
};

enum class motion : int { nyquist, walk, greedy, slow, worst };
inline constexpr int motions = 5;

/// One step of a motion. The last kind presses by any amount, any way; rests; or makes the motion that costs
/// the most, Δx = ½B⁻¹f, exactly or times up to two.
template <class Space>
struct any_motion {
  using vector = typename sim::physical<Space>::vector;
  motion kind;
  std::array<double, 3> b;
  sim::nyquist_motion<Space> nyquist{};

  [[nodiscard]] vector next(const sim::adversary_view<Space>& view,
                            sim::random_source& random) noexcept {
    switch (kind) {
      case motion::nyquist:
        return nyquist.next(view, random);
      case motion::walk:
        return sim::random_walk<Space>{}.next(view, random);
      case motion::greedy:
        return sim::greedy_motion<Space>{}.next(view, random);
      case motion::slow:  // what is lost, the surface gave
        return sim::random_walk<Space>{.speed = 0.02}.next(view, random);
      case motion::worst:
        break;
    }
    vector step = sim::physical<Space>::zero();
    if (random.chance(0.4)) {
      const double deep = std::pow(10.0, random.uniform(-5.0, -2.0));
      step = (random.chance(0.7) ? vector(-view.normal) : random.direction<Space>()) * deep;
    } else if (random.chance(0.8)) {
      const double share = random.chance(0.6) ? 1.0 : random.uniform(0.0, 2.0);
      for (int i = 0; i < Space::dof; ++i) {
        sim::component(step, i) = share * sim::component(view.force, i) * view.dt /
                                  (2.0 * b[static_cast<std::size_t>(i)]);
      }
    }
    return view.position + sim::clamp_norm<Space>(step, 0.02);
  }
};

/// One prescribed motion against one model. In float it stays on a grid of 2⁻²⁰ m, where positions
/// are exact.
template <class Space>
outcome attack(victim<Space>& model, motion kind, const conditions& when, std::uint64_t seed) {
  using vector = typename sim::physical<Space>::vector;
  model.restart();
  sim::random_source random(seed);
  sim::prescribed_motion<Space> device({.damping = when.b[0],
                                        .force_limit = when.force_limit,
                                        .quantum = when.quantum,
                                        .latency = when.latency});
  sim::jumping_surface jumps(2e-3, seed);
  sim::switching_stiffness stiffness(when.low, when.high, seed + 1);
  any_motion<Space> hand{kind, when.b};
  vector normal = random.direction<Space>();
  double offset = 0.0, K = when.jumping ? stiffness.stiffness(0.0) : 1e4;
  const bool still = !when.jumping || (kind == motion::nyquist && seed % 2 == 0);
  const auto publish = [&] { model.lay(vector(normal * offset), normal, K); };
  publish();

  outcome seen;
  ph::compensated_sum<double> beside;  // what the meter does not count: friction, unequal axes
  const auto hold = [&](const typename Space::vector& force, const vector& goal, double period) {
    const vector from = device.position();
    (void)device.set_period(period);
    device.move_to(goal);
    const auto sample = device.exchange(force);
    const vector step = device.position() - from;
    for (int i = 0; i < Space::dof; ++i) {
      const double s = sim::component(step, i);
      beside += (when.b[static_cast<std::size_t>(i)] - when.b[0]) * s * s /
                static_cast<double>(sample.dt);
      beside += when.friction * std::abs(s);
    }
    const vector held = sim::to_physical<Space>(sample.held);
    seen.through += std::abs(sim::physical<Space>::dot(held, step));
    seen.least = std::min(seen.least, device.meter().value() + static_cast<double>(beside));
    return sample;
  };

  auto sample = hold(Space::zero(), device.position(), 1e-3);
  for (int n = 0; n < when.ticks; ++n) {
    const double moved = jumps.offset(device.time());
    const double switched = stiffness.stiffness(device.time());
    if (!still && (moved != offset || switched != K)) {
      offset = moved;
      K = switched;
      normal = random.direction<Space>();
      publish();
    }
    if (random.chance(when.lost)) sample.valid = false;
    const typename Space::vector force = model.tick(sample);
    const bool late = random.chance(when.late);
    const double rest = when.longest_tick * random.uniform(0.01, 5.0);
    const double period = late          ? when.longest_tick + rest
                          : when.jitter ? random.uniform(0.5e-3, when.slowest)
                                        : 1e-3;
    const sim::adversary_view<Space> view{
        .position = device.position(),
        .normal = normal,
        .depth = sim::physical<Space>::dot(vector(normal * offset - device.position()), normal),
        .force = sim::to_physical<Space>(force),
        .dt = late && when.watchdog ? when.longest_tick : period,
        .damping = when.b[0]};
    vector goal = hand.next(view, random);
    if constexpr (std::is_same_v<typename Space::scalar, float>) {
      for (int i = 0; i < Space::dof; ++i) {
        double& x = sim::component(goal, i);
        x = std::round(x * 0x1p20) * 0x1p-20;
      }
    }
    const typename Space::vector held = force * static_cast<typename Space::scalar>(when.gain);
    if (!late || !when.watchdog) {
      sample = hold(held, goal, period);
      continue;
    }
    // the watchdog drops the force, then the hand goes where it looks as if it had paid
    sample = hold(held, goal, when.longest_tick);
    const auto after_it = hold(Space::zero(), vector(view.position - normal * 1e-3), rest);
    sample.position = after_it.position;
    sample.dt += after_it.dt;
  }
  return seen;
}

/// The worst of `seeds` runs of each motion.
template <class Space>
outcome worst_run(victim<Space>& model, const conditions& when, int seeds) {
  outcome worst;
  for (int run = 0; run < seeds * motions; ++run) {
    const outcome one = attack<Space>(model, static_cast<motion>(run % motions), when,
                                      static_cast<std::uint64_t>(run) + 1);
    worst.least = std::min(worst.least, one.least);
    worst.through += one.through;
  }
  return worst;
}

template <class Space, class Model>
outcome worst_of(const Model& model, const conditions& when, int seeds = 20) {
  attacked<Space, Model> one(model);
  return worst_run<Space>(one, when, seeds);
}

/// The spring of the thesis under this bound.
template <class Space, class Bound, class Limits = ph::loop_limits, class Law = ph::spring,
          class Observer = ph::reduced_energy>
auto model_of(const Bound& bound, const Limits& limits = thesis_loop, const Law& law = {},
              const Observer& observer = thesis_ledger()) {
  return ph::local_model{Space{},
                         ph::followed<ph::half_space<Space>>{},
                         ph::turn_limited{.rate = 4},
                         law,
                         observer,
                         bound,
                         limits};
}
template <class Space, class Bound>
double least_of(const Bound& bound, const conditions& when = {}, int seeds = 20) {
  const ph::loop_limits limits{
      .longest_tick = when.longest_tick, .top_speed = 100.0, .watchdog = when.longest_tick};
  return worst_of<Space>(model_of<Space>(bound, limits), when, seeds).least;
}

/// A bound that allows a little more than it may.
template <class Bound>
struct generous : Bound {
  double factor = 1.05;

  template <ph::port P>
  class on {
   public:
    constexpr explicit on(const generous& p) noexcept
        : bound_(p), factor_(ph::detail::number<typename P::scalar>(p.factor)) {}
    constexpr void reset() noexcept { ph::detail::restart(bound_); }
    [[nodiscard]] constexpr typename P::effort limit(const typename P::effort& desired,
                                                     const auto& state) noexcept {
      return ph::detail::applied<P>(bound_, desired, state).force * factor_;
    }

   private:
    ph::part_at<Bound, P> bound_;
    typename P::scalar factor_;
  };
};

/// A hand of 5 N that taps a wall of 10 kN/m for 10 s while its surface jumps by up to ±1 mm: the
/// least energy at the port. The motors are so many ticks late.
template <class Space>
double tapping(victim<Space>& model, int latency) {
  model.restart();
  model.lay(0.0, -1.0, 1e4);
  sim::jumping_surface jumps(1e-3, 1);
  double offset = 0.0;
  sim::device<Space, sim::tapping_hand<Space>> device(
      {.mass = 0.1, .start = -1e-3, .latency = latency},
      {.surface = 0.0, .normal = -1.0, .limit = 5.0});
  auto sample = device.exchange(0.0);
  for (int n = 0; n < 10000; ++n) {
    const double moved = jumps.offset(device.time());
    if (moved != offset) model.lay(moved, -1.0, 1e4);
    offset = moved;
    sample = device.exchange(model.tick(sample));
  }
  return device.meter().minimum();
}
template <class Model>
double tapped(const Model& model, int latency = 0) {
  attacked<d1, Model> one(model);
  return tapping(one, latency);
}

/// S0 of docs/design/mathematics.md § 5: 0.1 kg falls 61 mm onto 10 kN/m, for 10 s.
struct fall {
  double swing = 0.0;   ///< peak to peak after 2 s [m]
  double energy = 0.0;  ///< least at the port [J]
  std::vector<double> forces;
};
template <class Space>
fall falling(victim<Space>& model) {
  model.restart();
  model.lay(0.0, -1.0, 1e4);
  sim::device<Space> device({.lower = -0.061, .load = 0.981, .start = -0.061});
  fall result;
  double low = 1.0, high = -1.0;
  auto sample = device.exchange(0.0);
  for (int n = 0; n < 10000; ++n) {
    result.forces.push_back(model.tick(sample));
    sample = device.exchange(result.forces.back());
    if (n < 2000) continue;
    low = std::min(low, device.position());
    high = std::max(high, device.position());
  }
  result.swing = high - low;
  result.energy = device.meter().minimum();
  return result;
}
template <class Model>
fall drop(const Model& model) {
  attacked<d1, Model> one(model);
  return falling(one);
}

// Compiled in attacks.cpp; tests/full/bounds_attacks.cpp does it for the full tests.
extern template outcome worst_run(victim<d1>&, const conditions&, int);
extern template outcome worst_run(victim<d2>&, const conditions&, int);
extern template outcome worst_run(victim<d3>&, const conditions&, int);
extern template outcome worst_run(victim<f1>&, const conditions&, int);
extern template outcome worst_run(victim<f2>&, const conditions&, int);
extern template outcome worst_run(victim<f3>&, const conditions&, int);
extern template double tapping(victim<d1>&, int);
extern template fall falling(victim<d1>&);

}  // namespace attacks
