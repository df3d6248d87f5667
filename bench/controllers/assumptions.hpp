// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the table of assumptions is made of: worlds, untruths about them, and what hands draw.

#include "tables.hpp"
#include <passive_haptics/compositions.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/loop.hpp>
#include <passive_haptics/simulation/prescribed_motion.hpp>
#include <passive_haptics/simulation/search.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

namespace controllers {

// -------------------------------------------------------------------------- what hands have drawn

/// What the worst of these hands has drawn [J], and who that was.
struct drawn {
  double joules = 0.0;
  std::string by{};

  void count(double least_energy, const char* who) {
    if (-least_energy <= joules || std::isnan(joules)) return;  // NaN counts, and stays
    *this = {-least_energy, who};
  }
};

/// A velocity source presses against a world that resists with `pressed` newtons, and lets itself be pushed
/// out farther by one that asks for `pushed`: what motors of less than `pressed` have not taken in.
template <class Loop, class Lay>
[[nodiscard]] double load_and_unload(Loop loop, const Lay& lay, const sim::circumstances& world,
                                     double pressed, double pushed) {
  constexpr int in = 300, out = 300;  // [ticks]
  constexpr double stiffness = 1e4;   // [N/m]
  sim::prescribed_motion<ph::space<double, 1>> device(world.device_of<ph::space<double, 1>>());
  const auto press = [&](const auto& now) {
    const double force = now.tick < in ? pressed : pushed;
    lay(loop,
        sim::surface_state<ph::space<double, 1>>{now.position + force / stiffness, 1.0, stiffness});
  };
  const auto move = [&](const auto& now) {
    device.move_to(now.position + (now.tick < in ? -1e-3 : 3e-3));
  };
  return sim::run(device, loop, in + out, press, move).least_energy;
}

/// Presses motors in, of which the world asks more than they hold, and gives way to what asks for less.
struct yielding_hand {
  using vector = sim::physical<ph::space<double, 1>>::vector;
  double in = 0.0, out = 0.0;  ///< inwards [N]
  double turns = 0.0;          ///< [s]
  [[nodiscard]] vector force(double t, const vector& /*x*/, const vector& /*v*/) const noexcept {
    return vector(t < turns ? -in : -out);
  }
  [[nodiscard]] double mass() const noexcept { return 0.0; }
  [[nodiscard]] ph::parameter_fault check() const noexcept { return {}; }
};
/// The same of a hand that is limited in force: weak motors have not taken in what the ledger was told.
template <class Loop, class Lay>
[[nodiscard]] double press_and_give_way(Loop loop, const Lay& lay, const sim::circumstances& world,
                                        double turns) {
  using space = ph::space<double, 1>;
  constexpr double stiffness = 300.0;  // [N/m]
  const double motors = std::min(world.force_limit, 0.8 * world.hand_force);
  const yielding_hand hand{.in = std::min(1.02 * motors + 1.05 * world.friction, world.hand_force),
                           .out = 0.25 * motors,
                           .turns = turns};
  auto body = world.device_of<space>();
  body.friction = world.friction;
  sim::device<space, yielding_hand> device(body, hand);
  return sim::
      run(device, loop, 1500,
          [&](const auto& now) {
            const double force = (now.time < turns ? 6.0 : 0.9) * motors;
            lay(loop, sim::surface_state<space>{now.position + force / stiffness, 1.0, stiffness});
          })
          .least_energy;
}

/// All of them: a challenge of so many runs each, and a search of five times as many.
template <class Loop, class Lay>
[[nodiscard]] drawn most_drawn(const Loop& loop, const Lay& lay, const sim::circumstances& world,
                               const std::vector<sim::adversary>& hands, const effort& how) {
  drawn most;
  bool any_motion = false;
  for (const auto by : hands) {
    most.count(sim::challenge(loop, by, world, how.runs, how.first, lay).least_energy,
               to_string(by));
    any_motion = any_motion || !sim::is_force_limited(by);
  }
  if (any_motion) {
    most.count(sim::worst_motion(loop, world, 5 * how.runs, how.first, lay).energy, "worst motion");
    if constexpr (sim::space_of<Loop>::dof == 1) {
      for (const double pushed : {0.3, 1.0, 3.0}) {
        most.count(load_and_unload(loop, lay, world, 12.0, pushed), "load and unload");
      }
    }
  } else {
    most.count(sim::worst_push(loop, world, 5 * how.runs, how.first, lay).energy, "worst push");
    if constexpr (sim::space_of<Loop>::dof == 1) {
      for (const double turns : {0.05, 0.1, 0.2}) {
        most.count(press_and_give_way(loop, lay, world, turns), "press and give way");
      }
    }
  }
  return most;
}

// ----------------------------------------------------------------- what is stated, and is not true

/// Something that is stated of a world, and worlds in which it is untrue, the least untrue first.
template <class World>
struct statement {
  std::string what;
  std::function<std::string(const World&)> show;  ///< what is so there, with its unit
  std::vector<World> untrue;
};
/// Factors by which a lower bound, and an upper one, is untrue.
inline const std::vector<double> less{1.0 / 3.0, 0.1, 0.01}, more{3.0, 10.0, 100.0};

/// One that is untrue by each of these factors; `member` is in SI units, and shown in units of `unit`.
template <class World, class Base>
[[nodiscard]] statement<World> scaled(const char* what, double Base::*member, const char* pattern,
                                      double unit, const World& world,
                                      const std::vector<double>& factors) {
  statement<World> s{
      what, [=](const World& w) { return ex::format(pattern, w.*member / unit); }, {}};
  for (const double factor : factors) {
    s.untrue.push_back(world);
    s.untrue.back().*member *= factor;
  }
  return s;
}
/// One that is untrue by each of these values.
template <class World, class Base, class Number>
[[nodiscard]] statement<World> replaced(const char* what, Number Base::*member, const char* pattern,
                                        double unit, const World& world,
                                        const std::vector<Number>& values) {
  statement<World> s{
      what, [=](const World& w) { return ex::format(pattern, w.*member / unit); }, {}};
  for (const Number& value : values) {
    s.untrue.push_back(world);
    s.untrue.back().*member = value;
  }
  return s;
}

/// A row of the table: what hands draw while all is true, and while one statement is not.
struct trial {
  using attack = std::function<drawn(const effort& how)>;
  struct untruth {
    std::string true_value;
    attack by;
  };
  std::string composition, assumption, stated;
  attack kept;
  std::vector<untruth> untrue;
  bool unpaid = false;  ///< no hand of ours draws anything from its violation
};
template <class World, class Attack>
[[nodiscard]] trial trial_of(const std::string& composition, const World& stated,
                             const statement<World>& s, const Attack& attack) {
  const auto in = [attack](const World& world) {
    return [=](const effort& how) { return attack(world, how); };
  };
  trial t{composition, s.what, s.show(stated), in(stated), {}};
  for (const auto& world : s.untrue) t.untrue.push_back({s.show(world), in(world)});
  return t;
}

/// The rows of meshes, of tools in six degrees of freedom and of transmissions that give.
[[nodiscard]] std::vector<trial> trials_of_companions();

}  // namespace controllers
