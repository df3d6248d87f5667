// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One run of challenge.hpp: who does what in the loop of a simulation. Compiled once per Space.

#include <passive_haptics/simulation/adversary.hpp>
#include <passive_haptics/simulation/circumstances.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/loop.hpp>
#include <passive_haptics/simulation/prescribed_motion.hpp>
#include <passive_haptics/simulation/subject.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {

/// One tick of a run, for whoever watches.
template <class Space>
struct moment {
  int tick;
  double time;                                ///< at its start [s]
  typename physical<Space>::vector position;  ///< true [m]
  surface_state<Space> surface;
  bool sample_lost;
  typename physical<Space>::vector force;  ///< commanded [N]
  double energy;                           ///< at the port, so far [J]
};

namespace detail {

/// Someone to call every tick, or nobody.
template <class Space>
struct spectator {
  void* who = nullptr;
  void (*see)(void*, const moment<Space>&) = nullptr;
};

inline constexpr double nothing_known = std::numeric_limits<double>::quiet_NaN();

/// What a run has shown.
struct run_outcome {
  double least_energy = 0.0;
  double largest_force = 0.0;
};

enum class actor : std::uint8_t {
  nyquist,
  walk,
  slow_walk,
  greedy,
  rocking,
  restless,
  taps,
  pushes
};

struct plan {
  actor who{};
  surface_habits surface{};
  bool jitter = false, overruns = false, dropouts = false;
};

/// Who does what; seeds differ in what else happens.
[[nodiscard]] constexpr plan plan_of(adversary by, std::uint64_t seed) noexcept {
  const bool even = seed % 2 == 0;
  const bool second = seed / 2 % 2 == 0;
  const surface_habits sometimes{.jumps = even, .switches = even};
  switch (by) {
    case adversary::nyquist:
      return {actor::nyquist, sometimes};
    case adversary::random_walk:
      return {actor::walk, sometimes};
    case adversary::greedy:
      return {actor::greedy, sometimes};
    case adversary::jumping_surface:
      return {actor::slow_walk, {.jumps = true, .switches = even}};
    case adversary::flipping_normal:
      return {second ? actor::greedy : actor::slow_walk, {.flips = true, .switches = even}};
    case adversary::jitter:
      return {second ? actor::greedy : actor::walk, sometimes, true};
    case adversary::overruns:
      return {actor::greedy, sometimes, second, true};
    case adversary::rocking:
      return {actor::rocking, sometimes};
    case adversary::dropouts:
      return {second ? actor::greedy : actor::nyquist, sometimes, false, false, true};
    case adversary::tapping:
      return {actor::taps, {.jumps = even, .switches = second}};
    case adversary::random_tapping:
      return {actor::pushes, {.jumps = even, .flips = second && even, .switches = even}};
    case adversary::kitchen_sink:
      return {actor::restless, {.jumps = true, .flips = even, .switches = true}, true, true, true};
  }
  return {};
}

/// The velocity sources, one at a time.
template <class Space>
struct any_motion {
  actor who;
  nyquist_motion<Space> nyquist{};
  greedy_motion<Space> greedy{};
  rocking_motion<Space> rocking{};
  restless_motion<Space> restless{};

  any_motion(actor a, double quantum) noexcept : who(a) {
    if (quantum > 0.0) rocking.quantum = restless.quantum = quantum;
  }
  auto next(const adversary_view<Space>& view, random_source& random) noexcept {
    switch (who) {
      case actor::nyquist:
        return nyquist.next(view, random);
      case actor::walk:
        return random_walk<Space>{}.next(view, random);
      case actor::slow_walk:
        return random_walk<Space>{.speed = 0.02}.next(view, random);
      case actor::rocking:
        return rocking.next(view, random);
      case actor::restless:
        return restless.next(view, random);
      default:
        return greedy.next(view, random);
    }
  }
};

/// A velocity source acts: where to, and in an overrun where to be when the force is dropped.
template <class Space>
void act(prescribed_motion<Space>& device, any_motion<Space>& motion,
         const surface_state<Space>& surface, const typename Space::vector& command, double period,
         random_source& random) noexcept {
  using state = typename physical<Space>::vector;
  const state x = device.position();
  const state force = to_physical<Space>(device.upcoming(command));
  const double b = device.parameters().damping;
  const auto rounded = [](const state& p) { return to_physical<Space>(to_port<Space>(p)); };
  const state next =
      rounded(motion.next({x, surface.normal, surface.depth(x), force, period, b}, random));
  const double dropped = device.parameters().watchdog;
  if (!(period > dropped)) return device.move_to(next);
  const state best = clamp_norm<Space>(state(force * (dropped / (2.0 * b))), 0.02);
  device.move_via(state(x + best), random.chance(0.5) ? x : next);
}

/// A force-limited hand acts: taps, or changes its mind every 1 to 40 ticks.
template <class Space, class Device>
void act(Device& device, int& ticks_left, bool only_taps, const surface_state<Space>& surface,
         random_source& random) noexcept {
  striking_hand<Space>& hand = device.hand();
  hand.taps.surface = surface.point;
  hand.taps.normal = surface.normal;
  if (only_taps || ticks_left-- > 0) return;
  ticks_left = static_cast<int>(random.uniform(0.0, 40.0));
  hand.tapping = random.chance(0.3);
  const double most = hand.taps.limit;
  const double along = random.uniform();
  hand.push =
      along < 0.3 ? typename physical<Space>::vector(surface.normal * most)
      : along < 0.7
          ? typename physical<Space>::vector(-surface.normal * most)
          : typename physical<Space>::vector(random.direction<Space>() * (most * random.uniform()));
}

/// A run: world, sensor and clock as they are planned; move(device, command, period) is the hand.
template <class Space, class Device>
run_outcome play(const subject<Space>& model, Device& device, erratic_surface<Space>& surface,
                 const circumstances& world, const plan& how, random_source& random,
                 const spectator<Space>& watch, auto move) noexcept {
  const erratic_clock clock{world.longest_tick, how.jitter, how.overruns};
  erratic_sensor sensor{how.dropouts};
  bool lost = false;
  const auto before = [&](auto& now) noexcept {
    if (surface.update(now.time, now.position)) model.update(surface.now());
    lost = sensor.loses_one(random);
    if (lost) now.sample = {};
  };
  const auto act = [&](const auto& now) noexcept {
    const double period = clock.next(random);
    if (how.jitter || how.overruns) device.set_period(period);
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

/// The surface a run begins with: the model's own if that never moves, any through the origin if not.
template <class Space>
[[nodiscard]] surface_state<Space> first_surface(const subject<Space>& model,
                                                 const circumstances& world,
                                                 random_source& random) noexcept {
  surface_state<Space> surface{physical<Space>::zero(), random.direction<Space>(),
                               random.uniform(world.softest, world.stiffest)};
  if (!model.brings_its_own(surface)) model.update(surface);
  return surface;
}

/// One run.
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
  auto parameters = world.device_of<Space>();
  parameters.start = first.point;

  if (!is_force_limited(by)) {
    prescribed_motion<Space> device(parameters);
    any_motion<Space> motion(how.who, world.quantum);
    const auto move = [&](auto& d, const typename Space::vector& command, double period) {
      act<Space>(d, motion, surface.now(), command, period, random);
    };
    return play<Space>(model, device, surface, world, how, random, watch, move);
  }
  parameters.start = state(first.point + first.normal * random.uniform(0.0, 2e-3));
  striking_hand<Space> hand;
  hand.taps = {first.point, first.normal, world.hand_force};
  simulation::device<Space, striking_hand<Space>> device(parameters, hand);
  int ticks_left = 0;
  const auto move = [&](auto& d, const typename Space::vector& /*command*/, double /*period*/) {
    act<Space>(d, ticks_left, how.who == actor::taps, surface.now(), random);
  };
  return play<Space>(model, device, surface, world, how, random, watch, move);
}

}  // namespace detail

}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
