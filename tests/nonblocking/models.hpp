// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The models that are proved not to block: every observer, bound, contact law, constraint and supply
// at least once, in 1, 2 and 3 dimensions, float and double.

#include <passive_haptics/passive_haptics.hpp>

namespace ph = passive_haptics;

template <class Space>
struct parts {
  using S = typename Space::scalar;
  using vector = typename Space::vector;

  /// Calls visit(model) for every composition over `supply`.
  template <class Supply, class Visit>
  static void each(const Supply& supply, Visit visit) {
    const ph::reduced_energy<Space> plain{.damping = S(0.3)};
    const ph::quantised_energy<Space> encoder{.damping = S(0.3), .quantum = S(1e-5)};
    const ph::spring<Space> spring;
    const ph::damped_spring<Space> damped{.mass = S(0.1)};
    const ph::virtual_coupling<Space> coupling{.stiffness = S(2000), .damping = S(0.1)};
    const ph::strict_bound<Space> strict;
    const ph::reachable_bound<Space> reachable{.mass = S(0.1), .hand_force = S(5)};
    const ph::actuator_limit<Space> motors{.most = S(9)};
    const auto with = [&](const auto& contact, const auto& observer, const auto& bound,
                          const auto& motion) {
      visit(ph::local_model{Space{}, supply, ph::rotate_limited<Space>{.rate = S(4)}, contact,
                            observer, bound, ph::loop_limits<Space>{}, motion});
    };
    const ph::last_difference<Space> difference;
    with(spring, plain, strict, difference);
    with(spring, plain, ph::strict_bound<Space, 2>{}, difference);
    with(spring, plain, ph::memoryless_bound<Space>{}, difference);
    with(spring, plain, ph::per_axis_bound<Space>{}, difference);
    with(damped, plain, ph::bound_chain{reachable, motors}, difference);
    with(coupling, plain, motors, difference);
    with(spring, encoder, strict, ph::mass_observer<Space>{.mass = S(0.1), .quantum = S(1e-5)});
    with(spring, plain, ph::energy_bounding<Space>{}, difference);
    with(spring, plain, ph::tight_energy_bounding<Space>{}, difference);
    with(spring, plain, ph::energy_tank<Space>{}, difference);
    with(spring, plain, ph::two_layer_tank<Space>{.wanted = S(0.01), .max_damping = S(1)},
         difference);
    with(spring, plain, ph::series_passivity_controller<Space>{.max_damping = S(10)}, difference);
    with(spring, plain, ph::nonlinear_coupling<Space>{.initial = S(100), .rate = S(1000)},
         difference);
    with(spring, plain, ph::stiffness_increment<Space>{.initial = S(100), .step = S(10)},
         difference);
    with(spring, plain, ph::force_augmentation<Space>{.low = S(100), .step = S(0.1)}, difference);
    if constexpr (Space::dof == 1) with(spring, plain, ph::sector_bound<Space>{}, difference);
    with(spring, ph::no_observer<Space>{}, ph::no_bound<Space>{}, difference);
    if constexpr (Supply::moves) {
      with(spring, plain, ph::thesis_bound<Space>{}, difference);
      with(spring, plain, ph::set_position_modulation<Space>{}, difference);
      with(damped, plain, ph::bound_chain{ph::force_rate_limit<Space>{.rate = S(50)}, reachable},
           difference);
    }
  }
};

template <class Scalar, class Visit>
void each_model(Visit visit) {
  using one = ph::space<Scalar, 1>;
  using two = ph::space<Scalar, 2>;
  using three = ph::space<Scalar, 3>;
  parts<one>::each(ph::rigid{ph::half_space<one>{0, 1, 1000}}, visit);
  parts<one>::each(ph::following{ph::half_space<one>{0, 1, 1000}}, visit);
  parts<two>::each(ph::following{ph::segment<two>{{1, 0}, {-1, 0}, 1000}}, visit);
  parts<three>::each(ph::rigid{ph::half_space<three>{{0, 0, 0}, {0, 0, 1}, 1000}}, visit);
  parts<three>::each(ph::following{ph::triangle<three>{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}, 1000}},
                     visit);
}
