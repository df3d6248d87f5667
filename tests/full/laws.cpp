// SPDX-License-Identifier: BSD-3-Clause
// Every policy of the library under every law of its role, in 1, 2 and 3 dimensions and in joint
// coordinates, float and double.
#include "support/obedience.hpp"
#include <passive_haptics/published/published.hpp>

namespace {

constexpr double b = 0.03;
constexpr ph::reachable_bound reachable{.mass = 0.1, .hand_force = 5.0};
constexpr ph::actuator_limit motors{.most = 5.0};
constexpr ph::damping_and_friction rubbing{b, 0.2, 1e-5};
using compensated = ph::basic_reduced_energy<ph::isotropic_damping, ph::ledger_sum::compensated>;
using two_joints = ph::joint_space<float, 2>;
using arm = ph::joint_space<double, 7>;

/// What any port can be given.
template <class P>
void anywhere() {
  constexpr auto coefficients = every_axis<P>();
  using axes = ph::diagonal_damping<P::dof>;
  obey<role::damping, P>(coefficients, every_friction<P>());
  obey<role::inertia, P>(every_mass<P>());
  obey<role::observer, P>(
      ph::no_observer{}, ph::basic_reduced_energy<axes>{.damping = coefficients},
      ph::basic_capped_energy<axes>{.damping = coefficients, .cap = 1e-5},
      ph::basic_quantised_energy<axes>{.damping = coefficients, .quantum = 1e-5},
      ph::basic_dual_ledger<ph::diagonal_damping_and_friction<P::dof>, ph::encoder_steps<P::dof>>{
          .damping = every_friction<P>(), .quantum = every_step<P>()});
  obey<role::bound, P>(ph::no_bound{}, ph::strict_bound{}, ph::memoryless_bound{},
                       ph::per_axis_bound{}, ph::energy_tank{}, ph::predicting_tank{},
                       ph::reachable_work_bound<P::dof>{.inertia = every_mass<P>(), .hand = 10.0},
                       every_motor<P>(), ph::bound_chain{ph::strict_bound{}, every_motor<P>()});

  CHECK(laws::spends_at_most_the_ledger<P>(ph::strict_bound{}));
  CHECK(laws::spends_at_most_the_ledger<P>(ph::energy_tank{}));
  CHECK(laws::spends_at_most_the_ledger<P>(ph::bound_chain{ph::strict_bound{}, every_motor<P>()}));
  CHECK(laws::spends_at_most_the_ledger<P>(ph::bound_chain{ph::no_bound{}, ph::strict_bound{}}));
  // the controls: what does not promise strict does spend more
  CHECK_FALSE(laws::spends_at_most_the_ledger<P>(ph::no_bound{}));
  CHECK_FALSE(laws::spends_at_most_the_ledger<P>(ph::predicting_tank{}));
}

}  // namespace

TEMPLATE_TEST_CASE("every policy obeys the laws of its role", "[law]", d1, f1, d2, f2, d3, f3) {
  using S = TestType;
  anywhere<S>();
  obey<role::damping, S>(ph::isotropic_damping{b}, rubbing, ph::damping_and_friction{b, 0.0, 0.0});
  obey<role::inertia, S>(ph::isotropic_inertia{0.1});
  obey<role::observer, S>(ph::reduced_energy{.damping = b},
                          ph::reduced_energy{.damping = b, .loan = 0.01}, compensated{.damping = b},
                          ph::dual_ledger{.damping = rubbing, .quantum = 1e-5},
                          ph::dual_ledger{.damping = rubbing, .quantum = 0.0, .loan = 0.01},
                          ph::capped_energy{.damping = b, .cap = 1e-5},
                          ph::capped_energy{.damping = b, .reset_after = 0.002},
                          ph::quantised_energy{.damping = b, .quantum = 1e-5});
  obey<role::bound, S>(reachable, motors, ph::bound_chain{ph::strict_bound{}, motors});
  CHECK_FALSE(laws::spends_at_most_the_ledger<S>(reachable));
  obey<role::normals, S>(ph::turn_at_once{}, ph::turn_limited{50.0});
  obey<role::contact_law, S>(ph::spring{}, ph::damped_spring{.mass = 0.1}, ph::virtual_coupling{},
                             ph::virtual_coupling{.stiffness = 2000.0, .damping = 0.02},
                             ph::shaped{ph::spring{}, ph::force_rate_limit{.rate = 100.0}},
                             ph::capped{ph::damped_spring{.mass = 0.1}, 800.0},
                             ph::eased{ph::damped_spring{.mass = 0.1}});
  CHECK(laws::turns_at_most<S>(ph::turn_limited{50.0}, 50));
  CHECK(laws::turns_at_most<S>(ph::turn_at_once{}, 3200));
}

TEMPLATE_TEST_CASE("every policy for joints obeys the laws of its role", "[law]", two_joints, arm) {
  anywhere<TestType>();
}
