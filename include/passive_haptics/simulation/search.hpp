// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// An adversary that is tuned until it draws the most energy it can from one model:
//
//     const auto found = sim::worst_motion(model, world, 2000);     // no force can stop it
//     const auto pushed = sim::worst_push(model, world, 2000);      // hand_force, mass: exact device
//     std::printf("%g J, by pressing %g m deep in %d ticks\n", found.energy,
//                 found.parameters.depth, found.parameters.press_ticks);
//
// Both repeat the cycle of tuned_motion.hpp, on time and with every sample, and an evolution strategy looks for
// its worst numbers. A loss that it finds is a counterexample; if it finds none, that proves nothing.

#include <passive_haptics/simulation/attack.hpp>
#include <passive_haptics/simulation/tuned_motion.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {

/// The worst cycle that a search has found.
struct search_result {
  cycle_parameters parameters{};
  double energy = 0.0;  ///< least port energy [J]; −∞: a force not finite; NaN: impossible world
  int evaluations = 0;
};

namespace detail {

/// The objective of the search: the energy lost, or, as long as none is lost, the smallest share (port energy)/(energy
/// that damper and friction have taken), so that the search has a slope to descend.
struct damage {
  double least = 0.0;       ///< least port energy [J]
  double share_left = 1.0;  ///< in [0, 1]
  [[nodiscard]] bool worse_than(const damage& other) const noexcept {
    constexpr double nothing = -1e-13;  // rounding
    if (least < nothing || other.least < nothing) return least < other.least;
    return share_left < other.share_left;
  }
};

/// One run of the cycle `where`; act(device, surface, command) is the hand.
template <class Space, class Device>
damage go_round(const subject<Space>& model, Device& device, surface_state<Space> surface,
                bool moves, const cycle& where, const circumstances& situation, auto act) noexcept {
  const auto first = surface.point;
  damage result;
  noisy_sensor<Space> noise(situation.noise, noise_habit::against_force, 1);
  auto commanded = typename physical<Space>::coordinates{};
  const auto world = [&](auto& now) noexcept {
    if (situation.noise > 0.0) spoil<Space>(now.sample, noise, now.position, commanded);
    const bool jumped = moves && where.jumped();
    const double K = jumped ? where.p.after_jump : where.p.stiffness;
    const typename physical<Space>::vector point =
        first + surface.normal * (jumped ? where.p.jump : 0.0);
    if (!moves || (now.tick > 0 && point == surface.point && K == surface.stiffness)) return;
    surface.point = point;
    surface.stiffness = K;
    model.update(surface);
  };
  const auto hand = [&](const auto& now) noexcept {
    commanded = to_physical<Space>(now.force);
    act(device, surface, now.force);
  };
  const auto watch = [&](const auto&) noexcept {
    const double paid = device.meter().total().damping + device.meter().friction();
    if (!(paid > 1e-9)) return;
    result.share_left = kernels::smaller(result.share_left, device.meter().with_friction() / paid);
  };
  result.least = run(device, model, situation.ticks, world, hand, watch).least_energy;
  if (result.least == result.least) return result;
  return {-std::numeric_limits<double>::infinity(), 0.0};  // a force that is no number
}

/// Looks for the worst damage_of(point) by a (1+1) evolution strategy on the unit cube. Half of the numbers
/// mutate at a time, the step grows with success and shrinks with failure (one-fifth rule), and when it has
/// become small the search starts anew from the best of eight random points.
template <class Point>
std::pair<Point, damage> most_damage(auto damage_of, int evaluations, std::uint64_t seed) noexcept {
  random_source random(seed);
  Point best{};
  damage most = damage_of(best);
  Point here{};
  damage now;
  double step = 0.0;
  int fresh = 0;
  for (int used = 1; used < evaluations; ++used) {
    const bool exploring = step < 2e-3;
    Point trial = here;
    for (double& t : trial) {
      if (exploring) {
        t = random.uniform();
      } else if (random.chance(0.5)) {
        const double bell = random.uniform() + random.uniform() + random.uniform() - 1.5;
        t = std::abs(t + 2.0 * step * bell);  // reflected at both ends
        if (t > 1.0) t = kernels::larger(2.0 - t, 0.0);
      }
    }
    const damage tried = damage_of(trial);
    const bool better = tried.worse_than(now);
    if (better || (exploring && fresh == 0)) {
      here = trial;
      now = tried;
    }
    if (now.worse_than(most)) {
      best = here;
      most = now;
    }
    if (exploring) {
      if (++fresh == 8) step = 0.3;
    } else {
      step *= better ? 1.5 : 0.92;
      if (step < 2e-3) fresh = 0;
    }
  }
  return {best, most};
}

/// The search with a velocity source, or if `limited` with a hand of limited force.
template <class Space>
search_result look_for_worst(const subject<Space>& model, const circumstances& world,
                             int evaluations, std::uint64_t seed, bool limited) noexcept {
  using state = typename physical<Space>::vector;
  if (world.check()) return {{}, nothing_known, 0};
  auto parameters = world.device_of<Space>();
  const auto run = [&](const cycle_parameters& p) -> damage {
    random_source random(seed);
    model.restart();
    surface_state<Space> surface{physical<Space>::zero(), random.direction<Space>(), p.stiffness};
    const bool moves = !model.brings_its_own(surface);
    const double height = kernels::larger(p.rest, 0.0) * p.depth;
    parameters.start = state(surface.point + surface.normal * height);
    tuned_motion<Space> motion{{p}};
    if (!limited) {
      const auto act = [&](auto& d, const surface_state<Space>& s,
                           const typename Space::vector& command) {
        const state next = motion.next(view_of<Space>(d, s, command, world.longest_tick), random);
        d.move_to(to_physical<Space>(to_port<Space>(next)));
      };
      return with_motion<Space>(parameters, world, [&](auto& device) {
        return go_round<Space>(model, device, surface, moves, motion.where, world, act);
      });
    }
    striking_hand<Space> hand;
    hand.tapping = false;
    hand.taps = {surface.point, surface.normal, world.hand_force};
    const auto act = [&](auto& d, const surface_state<Space>& s,
                         const typename Space::vector& /*command*/) {
      motion.where.advance(s.depth(d.position()));
      motion.where.count();
      const bool in =
          motion.where.stage == cycle_stage::press || motion.where.stage == cycle_stage::hold;
      const double share = in ? -1.0 / p.press_ticks : kernels::smaller(p.retreat, 1.0);
      const bool resting = motion.where.stage == cycle_stage::rest;
      d.hand().push = state(s.normal * (resting ? 0.0 : share * world.hand_force));
    };
    return with_hand<Space>(parameters, hand, world, [&](auto& device) {
      return go_round<Space>(model, device, surface, moves, motion.where, world, act);
    });
  };
  const auto [point, most] = most_damage<cycle_parameters::unit_cube>(
      [&](const cycle_parameters::unit_cube& u) { return run(cycle_parameters::at(u, world)); },
      evaluations, seed);
  return {cycle_parameters::at(point, world), most.least, evaluations};
}

}  // namespace detail

/// The worst cycle of a velocity source found in `evaluations` runs of circumstances::ticks.
template <class Model, lay_for<Model> Lay = usual_lay<Model>>
[[nodiscard]] search_result worst_motion(const Model& model, const circumstances& world = {},
                                         int evaluations = 2000, std::uint64_t seed = 1,
                                         const Lay& lay = {}) noexcept {
  under_test<Model, Lay> tested{model, model, lay};
  return detail::look_for_worst(subject<space_of<Model>>(tested), world, evaluations, seed, false);
}

/// The worst cycle found of a hand of at most circumstances::hand_force on a device of
/// circumstances::mass, which reachable_bound and reachable_work_bound assume.
template <class Model, lay_for<Model> Lay = usual_lay<Model>>
[[nodiscard]] search_result worst_push(const Model& model, const circumstances& world = {},
                                       int evaluations = 2000, std::uint64_t seed = 1,
                                       const Lay& lay = {}) noexcept {
  under_test<Model, Lay> tested{model, model, lay};
  return detail::look_for_worst(subject<space_of<Model>>(tested), world, evaluations, seed, true);
}

}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
