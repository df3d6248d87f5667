// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The ports that are proved not to block: every observer, bound, shaper, contact law, constraint, supply
// and source at least once, in 1, 2 and 3 dimensions and of joints, float and double.

#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/published/published.hpp>

namespace ph = passive_haptics;

inline constexpr ph::loop_limits loop{.longest_tick = 0.001};

/// Calls visit(model) for every composition over `supply`.
template <class Space, class Supply, class Visit>
void each_over(const Supply& supply, Visit visit) {
  const ph::reduced_energy plain{.damping = 0.3};
  const ph::spring spring;
  const ph::damped_spring damped{.mass = 0.1};
  const ph::strict_bound strict;
  const ph::reachable_bound reachable{.mass = 0.1, .hand_force = 5};
  const ph::actuator_limit motors{.most = 9};
  const ph::last_difference difference;
  const auto with = [&](const auto& law, const auto& observer, const auto& bound,
                        const auto& limits, const auto& motion) {
    visit(ph::local_model{Space{}, supply, ph::turn_limited{.rate = 4}, law, observer, bound,
                          limits, motion});
  };
  const auto bounded = [&](const auto& bound) { with(spring, plain, bound, loop, difference); };
  const auto shaped = [&](const auto&... shapers) {
    with(ph::shaped{spring, shapers...}, plain, strict, loop, difference);
  };
  bounded(strict);
  bounded(ph::memoryless_bound{});
  bounded(ph::per_axis_bound{});
  bounded(ph::energy_bounding{});
  bounded(ph::tight_energy_bounding{});
  bounded(ph::energy_tank{});
  bounded(ph::predicting_tank{});
  bounded(ph::two_layer_tank{.wanted = 0.01, .max_damping = 1});
  bounded(ph::series_passivity_controller{.max_damping = 10});
  bounded(ph::series_controller_with_damping{.max_damping = 10});
  bounded(ph::basic_reachable_work_bound<ph::isotropic_inertia>{.inertia = {0.1}, .hand = 5});
  if constexpr (Space::dof == 1) bounded(ph::sector_bound{});
  with(spring, plain, strict, ph::late_loop_limits<2>{.longest_tick = 0.001}, difference);
  with(spring, plain, reachable, ph::watched_loop_limits<1>{.longest_tick = 0.001}, difference);
  with(damped, plain, ph::bound_chain{reachable, motors}, loop, difference);
  with(ph::virtual_coupling{.stiffness = 2000, .damping = 0.1}, plain, motors, loop, difference);
  with(spring, ph::quantised_energy{.damping = 0.3, .quantum = 1e-5}, strict, loop,
       ph::mass_observer{.mass = 0.1, .quantum = 1e-5});
  with(spring, ph::capped_energy{.damping = 0.3, .cap = 0.1, .reset_after = 1}, strict, loop,
       difference);
  with(spring, ph::dual_ledger{.damping = {0.3, 0.1, 1e-5}, .quantum = 1e-5}, reachable, loop,
       difference);
  with(spring, ph::no_observer{}, ph::no_bound{}, loop, difference);
  shaped(ph::nonlinear_coupling{.initial = 100, .rate = 1000});
  shaped(ph::stiffness_increment{.initial = 100, .step = 10});
  shaped(ph::force_augmentation{.low = 100, .step = 0.1});
  shaped(ph::reference_energy{{.max_damping = 10}});
  if constexpr (Supply::moves) {
    shaped(ph::thesis_rule{});
    shaped(ph::set_position_modulation{});
    shaped(ph::published_set_position_modulation{});
    with(ph::shaped{damped, ph::force_rate_limit{.rate = 50}}, plain, reachable, loop, difference);
  }
}

/// Two contacts of one port, one that moves and one that does not.
template <class Space>
auto corner(const ph::half_space<Space>& plane) {
  return ph::passive_port{
      Space{},
      ph::contacts{
          ph::local_contact{ph::followed{plane}, ph::turn_limited{.rate = 4}, ph::spring{}},
          ph::local_contact{ph::fixed{plane}, ph::turn_at_once{}, ph::spring{}}},
      ph::reduced_energy{.damping = 0.3}, ph::strict_bound{}, loop};
}

/// Force in, force out.
template <class Port>
auto guarded() {
  ph::diagonal_damping<Port::dof> b;
  b.coefficients.fill(0.3);
  ph::motor_limits<Port::dof> motors;
  motors.most.fill(3.0);
  using ledger =
      ph::basic_reduced_energy<ph::diagonal_damping<Port::dof>, ph::ledger_sum::compensated>;
  return ph::passive_port{Port{}, ph::given_force{}, ledger{.damping = b},
                          ph::bound_chain{ph::strict_bound{}, motors}, loop};
}

template <class Scalar, class Visit>
void each_model(Visit visit) {
  using one = ph::space<Scalar, 1>;
  using two = ph::space<Scalar, 2>;
  using three = ph::space<Scalar, 3>;
  each_over<one>(ph::fixed{ph::half_space<one>{0, 1, 1000}}, visit);
  each_over<one>(ph::followed{ph::half_space<one>{0, 1, 1000}}, visit);
  each_over<two>(ph::followed{ph::segment<two>{{1, 0}, {-1, 0}, 1000}}, visit);
  each_over<three>(ph::fixed{ph::half_space<three>{{0, 0, 0}, {0, 0, 1}, 1000}}, visit);
  each_over<three>(ph::followed{ph::triangle<three>{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}, 1000}},
                   visit);
  visit(corner(ph::half_space<one>{0, 1, 1000}));
  visit(corner(ph::half_space<three>{{0, 0, 0}, {0, 0, 1}, 1000}));
  visit(guarded<two>());
  visit(guarded<ph::joint_space<Scalar, 7>>());
}
