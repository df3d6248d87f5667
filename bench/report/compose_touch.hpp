// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How a list of compositions is made: every contact law with the reachable bound, every bound with
// the plain spring, over one shape and one way to turn normals.

#include "../common/median.hpp"
#include "../thesis_experiments/volume.hpp"
#include "touch.hpp"
#include <passive_haptics/compositions.hpp>
#include <passive_haptics/environment/contact_surface.hpp>
#include <passive_haptics/published/published.hpp>
#include <passive_haptics/simulation/loop.hpp>
#include <passive_haptics/simulation/prescribed_motion.hpp>
#include <passive_haptics/simulation/quiet.hpp>
#include <passive_haptics/simulation/schedule.hpp>

#include <chrono>

namespace experiments {

template <class Constraint>
Constraint constraint_of(const answer& a) {
  using space = typename Constraint::space_type;
  if constexpr (space::dof == 1) {
    return {a.point.z(), 1.0, a.stiffness};
  } else if constexpr (requires(Constraint t) { t.thickness; }) {
    return {.a = a.nodes[0], .b = a.nodes[1], .c = a.nodes[2], .stiffness = a.stiffness};
  } else {
    return {a.point, a.normal, a.stiffness};
  }
}

/// What stands along z in one dimension.
inline vector3 in_world(double z) {
  return {0.0, 0.0, z};
}
inline vector3 in_world(const vector3& v) {
  return v;
}

struct asked_there {
  answer operator()(const auto& environment, const vector3& x, const vector3& held) const {
    return environment(x, held);
  }
};
/// Asked where the hand will be, and told how it gives way.
struct asked_ahead {
  env::ahead where{};
  answer operator()(const auto& environment, const vector3& x, const vector3& held) {
    answer said = environment(where(x), held);
    said.point = said.rest;
    said.stiffness = said.soft;
    return said;
  }
};

/// The hand holds still for a second, and the environment goes on answering: since when is the force quiet, and how
/// stiff is it, pressed by 1 µm along itself?
template <class Model>
void hold_still(Model& model, const auto& environment, auto& ask, const typename Model::pose& at,
                double period, double tick, felt& run) {
  using space = typename Model::port_type;
  using scalar = typename space::scalar;
  sim::quiet_judge<space> judge;
  typename Model::effort force = space::zero();
  for (int n = 0; tick * n < 1.0; ++n) {
    if (std::fmod(tick * n, period) < tick) {
      const answer said = ask(environment, in_world(at), in_world(force));
      run.asked = said.stiffness;
      model.update(constraint_of<typename Model::constraint_type>(said));
    }
    force = model.tick(at, ph::seconds{scalar(tick)}).force;
    judge.add(force, space::zero(), tick, {});
  }
  run.quiet = judge.since();
  const scalar size = space::norm(force), by(1e-6);
  if (!(size > scalar(0))) return;
  const typename Model::effort push = space::scaled(force, scalar(1) / size);
  const typename Model::pose deeper = at - push * by;
  for (int n = 0; n < 9; ++n) (void)model.tick(deeper, ph::seconds{scalar(tick)});
  const auto then = model.tick(deeper, ph::seconds{scalar(tick)}).force;
  run.shown = space::dot(then - force, push) / by;
}

/// The scene in virtual time: a tick each `tick` [s], an answer of the environment each `period` [s].
template <class Model, class Ask = asked_there>
felt run_touch(Model model, const touch_scene& scene, double period, double tick, Ask ask = {}) {
  using space = typename Model::port_type;
  const auto hand = [&](int n) { return position_in<space>(scene.hand(tick * n)); };
  const auto environment = scene.fresh();
  sim::prescribed_motion<space> device({.period = tick, .start = hand(0)});
  sim::update_schedule schedule(1, period, period);
  const int each = static_cast<int>(1e-3 / tick + 0.5);
  felt run;
  const int last = static_cast<int>(scene.to / tick + 0.5) - 1;
  Model held = model;  // as it is when the hand comes to hold still
  std::vector<double> spent;
  const auto answered = [&](const auto& now) {
    if (!schedule.due(tick * now.tick + tick / 2.0)) return;
    const auto begin = std::chrono::steady_clock::now();
    const answer said = ask(environment, in_world(now.sample.position), in_world(now.sample.held));
    const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - begin;
    spent.push_back(took.count());
    model.update(constraint_of<typename Model::constraint_type>(said));
  };
  const auto move = [&](const auto& now) {
    if (now.tick % each == 0) {
      run.force.push_back(in_world(now.force));
      run.depth.push_back(now.out.depth);
    }
    if (now.tick == last) held = model;
    device.move_to(hand(now.tick + 1));
  };
  sim::run(device, model, static_cast<int>(scene.duration / tick + 0.5), answered, move);
  run.update_ns = median(spent);
  hold_still(held, environment, ask, hand(last), period, tick, run);
  return run;
}

/// All contact laws and bounds over one shape, "wall" or "plane, turn_limited".
template <class Constraint, class Normals>
void compose_over(std::vector<composition>& all, const std::string& shape, const Normals& normals) {
  using space = typename Constraint::space_type;
  const auto add = [&](const std::string& contact, const std::string& limit, const auto& law,
                       const auto& observer, const auto& bound) {
    const ph::followed<Constraint> supply{ph::freshness{.stale_after = 10.0}};
    const ph::local_model model{space{}, supply, normals, law, observer, bound, loop};
    all.push_back({model.passivity, space::dof,
                   candidate_of(shape + ", " + contact + ", " + limit, model),
                   [model](const touch_scene& scene, double rate) {
                     return run_touch(model, scene, 1.0 / rate, 1e-3);
                   }});
  };
  const ph::spring spring;
  const ph::reduced_energy ledger{.damping = 0.03};
  const ph::reachable_bound reachable{.mass = 0.1, .hand_force = 5.0};
  const ph::no_bound none;
  const ph::thesis_rule thesis;
  add("spring", "none", spring, ph::no_observer{}, none);
  add("spring", "strict", spring, ledger, ph::strict_bound{});
  add("spring", "memoryless", spring, ledger, ph::memoryless_bound{});
  add("spring", "EBA, tight", spring, ledger, ph::tight_energy_bounding{});
  add("spring", "thesis", ph::shaped{spring, thesis}, ledger, none);
  add("spring", "reachable", spring, ledger, reachable);
  add("spring", "thesis, reachable", ph::shaped{spring, thesis}, ledger, reachable);
  add("spring", "force rate, reachable", ph::shaped{spring, ph::force_rate_limit{.rate = 20.0}},
      ledger, reachable);
  add("spring", "tank, worst case", spring, ledger, ph::energy_tank{});
  add("spring", "PSPM", ph::shaped{spring, ph::set_position_modulation{}}, ledger, none);
  add("spring", "PO/PC", spring, ph::no_observer{},
      ph::series_passivity_controller{.max_damping = 50.0});
  add("damped spring", "reachable", ph::damped_spring{.mass = 0.1}, ledger, reachable);
  add("virtual coupling", "reachable", ph::virtual_coupling{.stiffness = 5e3, .damping = 0.5},
      ledger, reachable);
}

/// What the door gives, told as all are told; and told all that a body can say, with a loan.
template <class Constraint>
void compose_door(std::vector<composition>& all, const std::string& shape) {
  using space = typename Constraint::space_type;
  const ph::reduced_energy ledger{.damping = 0.03, .loan = 2e-4};
  auto model = ph::make_touch<space, Constraint>(
      {.mass = 0.1, .damping = ledger.damping.coefficient, .force_limit = 9.0}, {.force = 5.0});
  all.push_back({model.passivity, space::dof, candidate_of(shape + ", make_touch", model),
                 [model](const touch_scene& scene, double rate) {
                   return run_touch(model, scene, 1.0 / rate, 1e-3);
                 }});
  (void)model.set(ledger);
  model.reset();
  all.push_back({model.passivity, space::dof,
                 candidate_of(shape + ", make_touch, asked ahead, lent", model),
                 [model](const touch_scene& scene, double rate) {
                   return run_touch(model, scene, 1.0 / rate, 1e-3, asked_ahead{});
                 }});
}

}  // namespace experiments
