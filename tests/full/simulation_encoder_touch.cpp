// SPDX-License-Identifier: BSD-3-Clause
// A sample of bench/encoders: a gentle touch of a wall of 10 kN/m on a light device with encoders of
// 55 µm, whose friction is elastic. It stays as stiff as the device can pay for; a ledger that credits no
// friction starves, and the hand sinks in.
#include "support/catch.hpp"
#include "support/half_told.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/compositions.hpp>
#include <passive_haptics/energy_observer/quantised_energy.hpp>
#include <passive_haptics/motion_estimator/mass_observer.hpp>
#include <passive_haptics/simulation/challenge.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/loop.hpp>
#include <passive_haptics/simulation/search.hpp>

#include <random>

namespace sim = ph::simulation;

namespace {

constexpr sim::device_preset preset = sim::touch_like;
constexpr double presliding = 15e-6;
constexpr double surface = 0.37 * preset.quantum;

constexpr ph::encoder_device stated = half_told(preset, presliding);

struct felt {
  double least_stiffness = 1e9;  ///< of the touches [N/m]
  double least_energy = 0.0;     ///< at the port [J]
};

/// Five touches: from 3 mm outside at 10 mm/s till a hand of 300 N/m presses with 1.2 N, a second of
/// rest there, and away. The stiffness is that of the half second after. Ticks of 1 ms (1 ± jitter).
template <class Space, class Model>
felt touched(Model model, double displayed, double jitter = 0.0) {
  using scalar = typename Space::scalar;
  using hand = sim::impedance_hand<Space>;
  auto p = preset.without_friction<Space>();
  p.start = surface - 3e-3;
  sim::device<Space, hand, sim::slider_and_spring> device(
      p, hand{.stiffness = 300.0, .damping = 5.0, .own_mass = 0.15},
      preset.friction_of(presliding));
  (void)model.update({scalar(surface), scalar(-1), scalar(1e4)});
  const double deep = 1.2 / 300.0 + 1.2 / displayed;
  const int there = static_cast<int>((3e-3 + deep) / 10e-6);
  const int one = 2 * there + 1000;
  double force = 0.0, depth = 0.0;
  felt result;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> either_way(-1.0, 1.0);
  const auto go = [&](const auto& now) {
    if (jitter > 0.0) REQUIRE(device.set_period(1e-3 * (1.0 + jitter * either_way(random))));
    const int n = now.tick % one;
    const double at = n < there ? n * 10e-6 : n < there + 1000 ? there * 10e-6 : (one - n) * 10e-6;
    device.hand().aim(surface - 3e-3 + at,
                      n < there          ? 10e-3
                      : n < there + 1000 ? 0.0
                                         : -10e-3,
                      device.time());
  };
  const auto feel = [&](const auto& now) {
    const int n = now.tick % one - there;
    if (n == 499) force = depth = 0.0;
    if (n >= 500 && n < 1000) {
      force -= static_cast<double>(now.force);
      depth += std::max(0.0, now.position - surface);
    }
    if (n == 999) {
      result.least_stiffness = std::min(result.least_stiffness, depth > 0.0 ? force / depth : 0.0);
    }
  };
  result.least_energy = sim::run(device, model, 5 * one, sim::idle, go, feel).least_energy;
  return result;
}

template <class Space>
auto without_friction() {
  return ph::local_model{
      Space{},
      ph::followed<ph::half_space<Space>>{},
      ph::turn_limited{.rate = 2.0},
      ph::damped_spring{.mass = stated.mass, .force_limit = stated.force_limit},
      ph::quantised_energy{.damping = stated.damping, .quantum = stated.quantum},
      ph::bound_chain{ph::reachable_bound{.mass = stated.mass, .hand_force = 5.0},
                      ph::actuator_limit{.most = stated.force_limit}},
      ph::loop_limits{.longest_tick = stated.longest_tick},
      ph::mass_observer{.mass = stated.mass, .quantum = stated.quantum}};
}

}  // namespace

TEMPLATE_TEST_CASE("a gentle touch of encoder_touch is as stiff as was budgeted, first and last",
                   "[simulation]", d1, f1) {
  const double budget = ph::design::stiffness_budget(stated).stiffness;
  const felt wall =
      touched<TestType>(ph::make_touch<TestType>(stated, ph::known_hand{.force = 5.0}), budget);
  CHECK(budget > 2000.0);
  CHECK(wall.least_stiffness > 0.9 * budget);
  CHECK(wall.least_stiffness < 1.1 * budget);
  CHECK(wall.least_energy >= -1e-12);
}

TEST_CASE("a gentle touch of encoder_touch stays what it is in ticks of 0.95 to 1.05 ms",
          "[simulation][jitter]") {
  auto loop = stated;
  loop.longest_tick = 1.05e-3;
  const double budget = ph::design::stiffness_budget(loop).stiffness;
  const felt wall =
      touched<d1>(ph::make_touch<d1>(loop, ph::known_hand{.force = 5.0}), budget, 0.05);
  CHECK(wall.least_stiffness > 0.9 * budget);
  CHECK(wall.least_stiffness < 1.1 * budget);
  CHECK(wall.least_energy >= -1e-12);
}

TEST_CASE("a gentle touch on encoders is lost where no friction is credited", "[simulation]") {
  const felt wall = touched<d1>(without_friction<d1>(), 2000.0);
  CHECK(wall.least_stiffness < 500.0);
  CHECK(wall.least_energy >= -1e-12);
}

namespace {

/// A device that is just what is stated of it, with nothing to spare, under a hand of at most that force [N].
constexpr sim::circumstances just_as_stated(double hand_force) {
  return {.damping = stated.damping,
          .mass = stated.mass,
          .friction = stated.friction,
          .presliding = stated.presliding,
          .hand_force = hand_force,
          .quantum = stated.quantum,
          .force_limit = stated.force_limit};
}
auto told_of_hand(double hand_force) {
  return ph::make_touch<d1>(stated, ph::known_hand{.force = hand_force + stated.friction});
}

/// The least energy that hands which tap, push and tremble leave at the port [J].
double least_energy_under_hands(const auto& touch, const sim::circumstances& world) {
  double least = 0.0;
  for (const auto by :
       {sim::adversary::tapping, sim::adversary::random_tapping, sim::adversary::trembling}) {
    const auto verdict = sim::challenge(touch, by, world, 40);
    CAPTURE(to_string(by), verdict.least_energy, verdict.worst_seed);
    CHECK(verdict.largest_force > 0.1);
    least = std::min(least, verdict.least_energy);
  }
  return least;
}

}  // namespace

TEST_CASE("no hand of 5 N taps or trembles energy out of encoder_touch", "[simulation]") {
  const auto touch = told_of_hand(5.0);
  CHECK(least_energy_under_hands(touch, just_as_stated(5.0)) >= -1e-12);
  CHECK(sim::worst_push(touch, just_as_stated(5.0), 500).energy >= -1e-12);
  CHECK(least_energy_under_hands(told_of_hand(50.0), just_as_stated(50.0)) >= -1e-12);

  // Controls: the hands are strong enough to find a statement that is untrue.
  auto lighter = just_as_stated(5.0);
  lighter.mass /= 3.0;
  CHECK(least_energy_under_hands(touch, lighter) < -1e-5);
  CHECK(least_energy_under_hands(touch, just_as_stated(50.0)) < -1e-4);
  auto misled = touch;
  REQUIRE_FALSE(misled.set(ph::reachable_bound{.mass = 1e3 * stated.mass, .hand_force = 5e-6}));
  CHECK(sim::worst_push(misled, just_as_stated(5.0), 500).energy < -1e-7);
}

TEST_CASE("encoder_touch a tick late loses nothing to hands of 5 N, and on time it would",
          "[simulation]") {
  sim::circumstances world{.damping = preset.damping,
                           .mass = preset.mass,
                           .friction = preset.friction,
                           .presliding = presliding,
                           .hand_force = 5.0,
                           .quantum = preset.quantum,
                           .force_limit = preset.force_limit,
                           .latency = 1};
  const double push = world.hand_force + preset.friction;
  const ph::known_hand hand{.force = push};
  auto late = stated;
  late.latency = 1;
  const auto told = ph::make_touch<d1, ph::half_space<d1>, ph::late_loop_limits<1>>(late, hand);
  const auto untold = ph::make_touch<d1>(stated, hand);
  double control = 0.0;
  for (const auto by :
       {sim::adversary::tapping, sim::adversary::random_tapping, sim::adversary::trembling}) {
    const auto verdict = sim::challenge(told, by, world, 40);
    CAPTURE(to_string(by), verdict.least_energy, verdict.worst_seed);
    CHECK(verdict.least_energy >= -1e-12);
    CHECK(verdict.largest_force > 0.1);
    control = std::min(control, sim::challenge(untold, by, world, 40).least_energy);
  }
  CHECK(control < -1e-6);
}
