// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The two-port against hands, environments and networks that try to draw energy out of it. Judged
// by the true energy of both ports: the device's meter and the environment's own account.
#include "two_port/sides.hpp"
#include <passive_haptics/simulation/adversary.hpp>
#include <passive_haptics/simulation/channel.hpp>
#include <passive_haptics/simulation/loop.hpp>
#include <passive_haptics/simulation/prescribed_motion.hpp>

#include <array>

namespace two_ends {

enum class motion : int { nyquist, random, greedy };

struct conditions {
  sim::channel_parameters up{}, down{};
  motion by = motion::greedy;
  double damping = 0.03;    ///< of the device [N·s/m]
  double speed = 0.5;       ///< of the hand, at most [m/s]
  double slowest = 1e-3;    ///< longest period of the environment [s]
  double lost_samples = 0;  ///< probability
  double overruns = 0;      ///< probability of a tick of 2 to 20 ms; a watchdog acts after 1 ms
  bool settles = false;     ///< the environment reports the work it did
  bool jitter = true;       ///< periods of the device of 0.5 to 1 ms
  int ticks = 600;
};

struct outcome {
  double least = 0.0;           ///< of the sum of both ports' true energy so far [J]
  double to_hand = 0.0;         ///< what the device's motors gave to the hand [J]
  double to_environment = 0.0;  ///< what the tool gave to the environment [J]
  double least_ledger = 0.0;    ///< of the two [J], if they have one and no tick was late
};

enum class world : int { wild, wall };

/// One of the two.
template <class Space>
struct environment_of {
  world kind = world::wild;
  moving_wall<Space> wall{};
  wild_environment<Space> wild{};

  vector_of<Space> force() const { return kind == world::wild ? wild.force() : wall.force(); }
  double move(const vector_of<Space>& step, double dt, sim::random_source& random) {
    return kind == world::wild ? wild.move(step, dt, random) : wall.move(step, dt, random);
  }
};

template <class Space, class Master, class Remote>
outcome run(Master master, Remote remote, environment_of<Space> environment,
            const vector_of<Space>& normal, const conditions& when, std::uint64_t seed) {
  using scalar = typename Space::scalar;
  sim::random_source random(seed);
  sim::channel<packet_of<Space>> up(when.up, seed + 1), down(when.down, seed + 2);
  sim::prescribed_motion<Space> device({.damping = when.damping, .watchdog = 1e-3});
  sim::nyquist_motion<Space> nyquist{};
  outcome result;
  double at_environment = 0.0, next_step = 0.0, last_step = 0.0, to_hand = 0.0;
  const auto n_true = sim::to_physical<Space>(normal);

  const auto world = [&](auto& now) {
    const bool late = random.chance(when.overruns);
    const double period = when.jitter ? random.uniform(0.5e-3, 1e-3) : 1e-3;
    device.set_period(late ? random.uniform(2e-3, 20e-3) : period);
    while (const auto* packet = up.take(now.time)) master.receive(*packet);
    if (random.chance(when.lost_samples)) now.sample = {};
  };
  const auto hand = [&](const auto& now) {
    down.send(master.packet(), now.time);
    if (now.time >= next_step) {
      const double dt = next_step > 0.0 ? now.time - last_step : 1e-3;
      while (const auto* packet = down.take(now.time)) remote.receive(*packet);
      const auto step = remote.step(environment.force(), ph::seconds{dt});
      const double work = environment.move(step.displacement, dt, random);
      if (when.settles) remote.settle(static_cast<scalar>(work));
      at_environment += work;
      result.to_environment += std::max(-work, 0.0);
      up.send(remote.packet(environment.force()), now.time);
      last_step = now.time;
      next_step = now.time + random.uniform(1e-3, when.slowest);
      if constexpr (requires { remote.energy(); }) {
        result.least_ledger = std::min(result.least_ledger, static_cast<double>(remote.energy()));
      }
    }
    const sim::adversary_view<Space> view{.position = now.position,
                                          .normal = n_true,
                                          .depth = -sim::physical<Space>::dot(now.position, n_true),
                                          .force = sim::to_physical<Space>(now.force),
                                          .dt = 0.75e-3,
                                          .damping = when.damping};
    switch (when.by) {
      case motion::nyquist:
        return device.move_to(nyquist.next(view, random));
      case motion::random:
        return device.move_to(
            sim::random_walk<Space>{.speed = when.speed, .range = 1e-2}.next(view, random));
      case motion::greedy:
        return device.move_to(sim::greedy_motion<Space>{.speed = when.speed}.next(view, random));
    }
  };
  const auto watch = [&](const auto& now) {
    const double given = device.meter().total().actuator;
    result.to_hand += std::max(given - to_hand, 0.0);
    to_hand = given;
    result.least = std::min(result.least, device.meter().value() + at_environment);
    if (!(when.overruns > 0.0)) {  // a late tick may leave a debt: the worse of two stories
      result.least_ledger = std::min(result.least_ledger, static_cast<double>(now.out.energy));
    }
  };
  sim::run(device, master, when.ticks, world, hand, watch);
  return result;
}

/// 0 to 300 ms, up to 100 ms of jitter, 0 to 90 % loss, duplication, in order or not.
inline sim::channel_parameters any_channel(sim::random_source& random) {
  return {.delay = random.chance(0.2) ? 0.0 : random.uniform(0.0, 0.3),
          .jitter = random.chance(0.3) ? 0.0 : random.uniform(0.0, 0.1),
          .loss = random.chance(0.2) ? 0.0 : random.uniform(0.0, 0.9),
          .duplication = random.chance(0.5) ? 0.0 : random.uniform(),
          .in_order = random.chance(0.3)};
}

/// One random run: all of it drawn from the seed.
template <class Space, bool Controlled>
outcome attack(world kind, std::uint64_t seed, int ticks = 600) {
  sim::random_source random(seed * 77);
  const vector_of<Space> normal = sim::to_port<Space>(random.direction<Space>());
  conditions when{.up = any_channel(random), .down = any_channel(random)};
  when.by = static_cast<motion>(random.bits() % 3);
  when.damping = random.chance(0.5) ? 0.03 : random.uniform(0.03, 3.0);
  when.slowest = random.chance(0.3) ? 1e-3 : random.uniform(1e-3, 0.05);
  when.speed = random.chance(0.5) ? 0.5 : 10.0;
  when.lost_samples = random.chance(0.3) ? 0.05 : 0.0;
  when.overruns = random.chance(0.3) ? 0.05 : 0.0;
  when.ticks = ticks;
  constexpr std::array shares{1.0, 0.5, 0.0};
  const double share = shares[random.bits() % 3];
  const double K = random.uniform(100.0, 20000.0);
  when.settles = kind == world::wall && random.chance(0.5);
  environment_of<Space> environment{.kind = kind, .wall = {.stiffness = K}};
  environment.wall.normal = normal;
  if constexpr (Controlled) {
    const auto master = side_of<Space>({.damping = when.damping, .share = share});
    ph::admittance_parameters p;
    p.stiffness = kind == world::wall ? K : 0.0;
    p.drift_rate = random.chance(0.5) ? 0.0 : 20.0;
    return run<Space>(master, ph::admittance_side<Space>{p}, environment, normal, when, seed);
  } else {
    return run<Space>(bare_master<Space>{}, bare_remote<Space>{}, environment, normal, when, seed);
  }
}

struct tally {
  double least = 0.0, to_hand = 0.0, to_environment = 0.0, least_ledger = 0.0;
  int losing = 0, hands = 0, environments = 0;

  void count(const outcome& o) {
    least = std::min(least, o.least);
    least_ledger = std::min(least_ledger, o.least_ledger);
    to_hand += o.to_hand;
    to_environment += o.to_environment;
    losing += o.least < -1e-3 ? 1 : 0;
    hands += o.to_hand > 1e-6 ? 1 : 0;
    environments += o.to_environment > 1e-6 ? 1 : 0;
  }
};

}  // namespace two_ends
