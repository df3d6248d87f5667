// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The plan of a run of attack.hpp, and how a motion or a hand acts in one of its ticks.

#include <passive_haptics/simulation/adversary.hpp>
#include <passive_haptics/simulation/circumstances.hpp>
#include <passive_haptics/simulation/prescribed_motion.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {
namespace detail {

enum class actor : std::uint8_t {
  nyquist,
  walk,
  slow_walk,
  greedy,
  rocking,
  restless,
  in_step,
  presliding,
  worst_step,
  dither,
  taps,
  pushes,
  trembles
};

struct plan {
  actor who{};
  surface_habits surface{};
  bool jitter = false, overruns = false, dropouts = false;
};

/// The plan of an adversary. The seed chooses the further changes of the surface.
[[nodiscard]] constexpr plan plan_of(adversary by, std::uint64_t seed) noexcept {
  const bool even = seed % 2 == 0;
  const bool second = seed / 2 % 2 == 0;
  const surface_habits sometimes{.jumps = even, .switches = even};
  const surface_habits hastily{.jumps = even, .switches = even || second, .hurries = true};
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
    case adversary::in_step:
      return {actor::in_step, hastily};
    case adversary::presliding:
      return {actor::presliding, hastily};
    case adversary::worst_step:
      return {actor::worst_step, hastily};
    case adversary::dither:
      return {actor::dither, sometimes};
    case adversary::trembling:
      return {actor::trembles, hastily};
  }
  return {};
}

/// Any of the velocity sources.
template <class Space>
struct any_motion {
  actor who;
  nyquist_motion<Space> nyquist{};
  greedy_motion<Space> greedy{};
  rocking_motion<Space> rocking{};
  restless_motion<Space> restless{};
  in_step_motion<Space> in_step{};
  worst_step_motion<Space> worst_step{};
  dither_motion<Space> dither{};

  any_motion(actor a, const circumstances& world) noexcept : who(a) {
    if (world.quantum > 0.0) rocking.quantum = restless.quantum = world.quantum;
    if (a == actor::presliding) {
      in_step.reach = world.presliding > 0.0 ? 2.0 * world.presliding : in_step.nudge;
    }
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
      case actor::in_step:
      case actor::presliding:
        return in_step.next(view, random);
      case actor::worst_step:
        return worst_step.next(view, random);
      case actor::dither:
        return dither.next(view, random);
      default:
        return greedy.next(view, random);
    }
  }
};

/// The view of a velocity source before it moves.
template <class Space, class Friction>
adversary_view<Space> view_of(const prescribed_motion<Space, Friction>& device,
                              const surface_state<Space>& surface,
                              const typename Space::vector& command, double period) noexcept {
  using state = typename physical<Space>::vector;
  const state x = device.position();
  return {x,
          surface.normal,
          surface.depth(x),
          to_physical<Space>(device.upcoming(command)),
          period,
          device.parameters().damping};
}

/// A device and the force it is about to hold, for adversary_view::price.
template <class Space, class Friction>
struct priced {
  const prescribed_motion<Space, Friction>& device;
  const typename Space::vector& command;
  static double ask(const void* who, const typename physical<Space>::vector& next) noexcept {
    const auto& self = *static_cast<const priced*>(who);
    return self.device.price(next, self.command);
  }
};

/// Finds the ways [m] that the device may go on each axis while the sensors show the same.
template <class Space>
void find_room(adversary_view<Space>& view, const circumstances& world,
               const noisy_sensor<Space>& noise) noexcept {
  for (int i = 0; i < Space::dof; ++i) {
    double& below = component(view.room_below, i);
    double& above = component(view.room_above, i);
    below = world.noise > 0.0 ? noise.room_below(i) : 0.0;
    above = world.noise > 0.0 ? noise.room_above(i) : 0.0;
    if (!(world.quantum > 0.0)) continue;
    const double x = component(view.position, i);
    const double within = x - std::floor(x / world.quantum) * world.quantum;
    below = world.noise > 0.0 ? kernels::smaller(below, within) : within;
    const double left = 0.9999 * world.quantum - within;
    above = kernels::larger(world.noise > 0.0 ? kernels::smaller(above, left) : left, 0.0);
  }
}

/// Lets a velocity source choose the next position, and in an overrun the one at which the watchdog drops the force.
template <class Space, class Friction>
void act(prescribed_motion<Space, Friction>& device, any_motion<Space>& motion,
         const surface_state<Space>& surface, const typename Space::vector& command, double period,
         const circumstances& world, const noisy_sensor<Space>& noise,
         random_source& random) noexcept {
  using state = typename physical<Space>::vector;
  adversary_view<Space> view = view_of<Space>(device, surface, command, period);
  const state x = view.position;
  const state force = view.force;
  const double b = view.damping;
  const priced<Space, Friction> prices{device, command};
  view.presliding = world.presliding;
  view.device = &prices;
  view.ask = &priced<Space, Friction>::ask;
  find_room(view, world, noise);
  const auto rounded = [](const state& p) { return to_physical<Space>(to_port<Space>(p)); };
  const state next = rounded(motion.next(view, random));
  const double dropped = device.parameters().watchdog;
  if (!(period > dropped)) return device.move_to(next);
  const state best = clamp_norm<Space>(state(force * (dropped / (2.0 * b))), 0.02);
  device.move_via(state(x + best), random.chance(0.5) ? x : next);
}

/// The memory of a force-limited hand.
template <class Space>
struct intention {
  int ticks_left = 0;   ///< until the hand changes its mind
  double press = 0.0;   ///< steady force inwards [N]
  double tremor = 0.0;  ///< force on each axis in phase with the model's [N]
  typename physical<Space>::coordinates force{};  ///< last force of the model [N]
};

/// The force of a hand that presses and trembles: along the model's force where that has grown, against it where it fell.
template <class Space>
void tremble(striking_hand<Space>& hand, intention<Space>& mind,
             const surface_state<Space>& surface, const typename physical<Space>::vector& force,
             random_source& random) noexcept {
  using state = typename physical<Space>::vector;
  const double most = hand.taps.limit;
  if (mind.ticks_left-- <= 0) {
    mind.ticks_left = static_cast<int>(random.uniform(20.0, 200.0));
    mind.press = most * random.uniform(-0.1, 0.8);
    mind.tremor = most * std::exp(random.uniform(-7.0, 0.0));
  }
  const state change = force - state(mind.force);
  mind.force = force;
  state push = surface.normal * -mind.press;
  for (int i = 0; i < Space::dof; ++i) {
    const double by = component(change, i);
    component(push, i) += by > 0.0 ? mind.tremor : by < 0.0 ? -mind.tremor : 0.0;
  }
  hand.tapping = false;
  hand.push = push;
}

/// A force-limited hand acts: it taps, trembles, or changes its push every 1 to 40 ticks.
template <class Space, class Device>
void act(Device& device, intention<Space>& mind, actor who, const surface_state<Space>& surface,
         const typename Space::vector& command, random_source& random) noexcept {
  striking_hand<Space>& hand = device.hand();
  hand.taps.surface = surface.point;
  hand.taps.normal = surface.normal;
  if (who == actor::trembles) {
    return tremble<Space>(hand, mind, surface, to_physical<Space>(command), random);
  }
  if (who == actor::taps || mind.ticks_left-- > 0) return;
  mind.ticks_left = static_cast<int>(random.uniform(0.0, 40.0));
  hand.tapping = random.chance(0.3);
  const double most = hand.taps.limit;
  const double along = random.uniform();
  hand.push =
      along < 0.3 ? typename physical<Space>::vector(surface.normal * most)
      : along < 0.7
          ? typename physical<Space>::vector(-surface.normal * most)
          : typename physical<Space>::vector(random.direction<Space>() * (most * random.uniform()));
}

}  // namespace detail
}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
