// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One run of challenge.hpp: an adversary in the loop of a simulation. It is compiled once per Space.

#include <passive_haptics/simulation/attack_plan.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/loop.hpp>
#include <passive_haptics/simulation/subject.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {

/// One tick of a run, for the `watch` of replay().
template <class Space>
struct moment {
  int tick;
  double time;                                ///< at its start [s]
  typename physical<Space>::vector position;  ///< true [m]
  surface_state<Space> surface;
  bool sample_lost;
  typename physical<Space>::vector force;  ///< commanded [N]
  double energy;                           ///< port energy so far, with dry friction [J]
};

namespace detail {

/// A function to call every tick, or none.
template <class Space>
struct spectator {
  void* who = nullptr;
  void (*see)(void*, const moment<Space>&) = nullptr;
};

inline constexpr double nothing_known = std::numeric_limits<double>::quiet_NaN();

struct run_outcome {
  double least_energy = 0.0;   ///< at the port [J], ≤ 0
  double largest_force = 0.0;  ///< commanded [N]
};

/// Adds the error of a noisy sensor to a sample, given the force that was commanded last [N].
template <class Space>
void spoil(device_sample<Space>& sample, noisy_sensor<Space>& noise,
           const typename physical<Space>::vector& position,
           const typename physical<Space>::vector& force) noexcept {
  const auto e = noise.error(position, force);
  sample.position =
      to_port<Space>(typename physical<Space>::vector(to_physical<Space>(sample.position) + e));
}

/// Plays a run with the world, sensor and clock of a plan; move(device, command, period) is the hand.
template <class Space, class Device>
run_outcome play(const subject<Space>& model, Device& device, erratic_surface<Space>& surface,
                 noisy_sensor<Space>& noise, const circumstances& world, const plan& how,
                 random_source& random, const spectator<Space>& watch, auto move) noexcept {
  const erratic_clock clock{world.longest_tick, how.jitter, how.overruns};
  erratic_sensor sensor{how.dropouts};
  bool lost = false;
  auto commanded = typename physical<Space>::coordinates{};
  const auto before = [&](auto& now) noexcept {
    if (surface.update(now.time, now.position)) model.update(surface.now());
    if (world.noise > 0.0) spoil<Space>(now.sample, noise, now.position, commanded);
    lost = sensor.loses_one(random);
    if (lost) now.sample = {};
  };
  const auto act = [&](const auto& now) noexcept {
    const double period = clock.next(random);
    if (how.jitter || how.overruns) device.set_period(period);
    commanded = to_physical<Space>(now.force);
    move(device, now.force, period);
  };
  const auto show = [&](const auto& now) noexcept {
    if (watch.see == nullptr) return;
    watch.see(watch.who, {now.tick, now.time, now.position, surface.now(), lost,
                          to_physical<Space>(now.force), device.meter().with_friction()});
  };
  const auto seen = run(device, model, world.ticks, before, act, show);
  return {seen.least_energy, seen.largest_force};
}

/// The surface at the start of a run: the model's own if it never moves, otherwise one through the origin.
template <class Space>
[[nodiscard]] surface_state<Space> first_surface(const subject<Space>& model,
                                                 const circumstances& world,
                                                 random_source& random) noexcept {
  surface_state<Space> surface{physical<Space>::zero(), random.direction<Space>(),
                               random.uniform(world.softest, world.stiffest)};
  if (!model.brings_its_own(surface)) model.update(surface);
  return surface;
}

/// use(device) for a prescribed motion, which no force can stop, with the friction of `world`.
template <class Space>
[[nodiscard]] auto with_motion(const device_parameters<Space>& parameters,
                               const circumstances& world, auto use) noexcept {
  if (world.rubs_elastically()) {
    prescribed_motion<Space, friction_like> device(parameters, world.elastic_friction());
    return use(device);
  }
  prescribed_motion<Space> device(parameters);
  return use(device);
}
/// use(device) for the exact device with that hand on it.
template <class Space>
[[nodiscard]] auto with_hand(const device_parameters<Space>& parameters,
                             const striking_hand<Space>& hand, const circumstances& world,
                             auto use) noexcept {
  if (world.rubs_elastically()) {
    device<Space, striking_hand<Space>, friction_like> rubs(parameters, hand,
                                                            world.elastic_friction());
    return use(rubs);
  }
  device<Space, striking_hand<Space>> slides(parameters, hand);
  return use(slides);
}

template <class Space>
run_outcome attack(const subject<Space>& model, adversary by, const circumstances& world,
                   std::uint64_t seed, const spectator<Space>& watch = {}) noexcept {
  using state = typename physical<Space>::vector;
  if (world.check()) return {nothing_known, 0.0};
  random_source random(seed);
  model.restart();
  const plan how = plan_of(by, seed);
  const surface_state<Space> first = first_surface(model, world, random);
  surface_state<Space> own = first;
  const surface_habits habits = model.brings_its_own(own) ? surface_habits{} : how.surface;
  erratic_surface<Space> surface(first, habits, world.jump, world.softest, world.stiffest,
                                 random.bits());
  noisy_sensor<Space> noise(world.noise, static_cast<noise_habit>(seed % 5), ~seed);
  auto parameters = world.device_of<Space>();
  parameters.start = first.point;

  if (!is_force_limited(by)) {
    any_motion<Space> motion(how.who, world);
    const auto move = [&](auto& d, const typename Space::vector& command, double period) {
      act<Space>(d, motion, surface.now(), command, period, world, noise, random);
    };
    return with_motion<Space>(parameters, world, [&](auto& device) {
      return play<Space>(model, device, surface, noise, world, how, random, watch, move);
    });
  }
  parameters.start = state(first.point + first.normal * random.uniform(0.0, 2e-3));
  striking_hand<Space> hand;
  hand.taps = {first.point, first.normal, world.hand_force};
  intention<Space> mind;
  const auto move = [&](auto& d, const typename Space::vector& command, double /*period*/) {
    act<Space>(d, mind, how.who, surface.now(), command, random);
  };
  return with_hand<Space>(parameters, hand, world, [&](auto& device) {
    return play<Space>(model, device, surface, noise, world, how, random, watch, move);
  });
}

}  // namespace detail

}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
