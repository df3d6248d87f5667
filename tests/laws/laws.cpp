// SPDX-License-Identifier: BSD-3-Clause
// The policies of the library under the laws of their roles: in space, in joint coordinates, and at
// compile time where there is no Eigen in them. In every dimension and precision: full/laws.cpp. That
// each law also rejects a policy that breaks it: laws_broken.cpp.
#include "support/obedience.hpp"

namespace {

constexpr double b = 0.03;
constexpr ph::reachable_bound reachable{.mass = 0.1, .hand_force = 5.0};
constexpr ph::actuator_limit motors{.most = 5.0};
using compensated = ph::basic_reduced_energy<ph::isotropic_damping, ph::ledger_sum::compensated>;

template <class S>
constexpr bool obeyed_in_one_dimension() {
  using enum role;
  return obeys<damping, S>(ph::isotropic_damping{b}, every_axis<S>(),
                           ph::damping_and_friction{b, 0.2, 1e-5},
                           ph::damping_and_friction{b, 0.0, 0.0}) &&
         obeys<inertia, S>(ph::isotropic_inertia{0.1}, every_mass<S>()) &&
         obeys<observer, S>(ph::no_observer{}, ph::reduced_energy{.damping = b, .loan = 0.01},
                            compensated{.damping = b},
                            ph::capped_energy{.damping = b, .cap = 1e-5, .reset_after = 0.002},
                            ph::quantised_energy{.damping = b, .quantum = 1e-5}) &&
         obeys<bound, S>(ph::no_bound{}, ph::strict_bound{}, reachable, motors) &&
         obeys<normals, S>(ph::turn_at_once{}, ph::turn_limited{50.0}) &&
         obeys<contact_law, S>(ph::spring{}, ph::damped_spring{.mass = 0.1}, ph::virtual_coupling{},
                               ph::virtual_coupling{.stiffness = 2000.0, .damping = 0.02}) &&
         obeys<constraint, S>(wall<S>(100)) && laws::turns_at_most<S>(ph::turn_limited{50.0}, 50) &&
         laws::turns_at_most<S>(ph::turn_at_once{}, 3200) &&
         laws::keeps_the_newest<S>(ph::followed<ph::half_space<S>>{}, wall<S>(100));
}

static_assert(obeyed_in_one_dimension<d1>());
static_assert(obeyed_in_one_dimension<f1>());

}  // namespace

TEMPLATE_TEST_CASE("what belongs to a contact obeys the laws of its role", "[law]", f2, d3) {
  using S = TestType;
  obey<role::normals, S>(ph::turn_at_once{}, ph::turn_limited{50.0});
  obey<role::contact_law, S>(ph::spring{}, ph::damped_spring{.mass = 0.1}, ph::virtual_coupling{},
                             ph::virtual_coupling{.stiffness = 2000.0, .damping = 0.02},
                             ph::shaped{ph::spring{}, ph::force_rate_limit{.rate = 100.0}});
  CHECK(laws::turns_at_most<S>(ph::turn_limited{50.0}, 50));
  CHECK(laws::turns_at_most<S>(ph::turn_at_once{}, 3200));
}

TEMPLATE_TEST_CASE("what belongs to a port in space obeys the laws of its role", "[law]", f2, d3) {
  using S = TestType;
  obey<role::damping, S>(ph::isotropic_damping{b}, every_axis<S>(),
                         ph::damping_and_friction{b, 0.2, 1e-5},
                         ph::damping_and_friction{b, 0.0, 0.0});
  obey<role::inertia, S>(ph::isotropic_inertia{0.1}, every_mass<S>());
  obey<role::observer, S>(ph::no_observer{}, ph::reduced_energy{.damping = b},
                          compensated{.damping = b});
}

TEST_CASE("what belongs to a port of joints obeys the laws of its role", "[law]") {
  using arm = ph::joint_space<double, 7>;
  obey<role::damping, arm>(every_axis<arm>());
  obey<role::inertia, arm>(every_mass<arm>());
  obey<role::observer, arm>(
      ph::basic_reduced_energy<ph::diagonal_damping<7>>{.damping = every_axis<arm>()});
  obey<role::bound, arm>(ph::strict_bound{}, every_motor<arm>());
}

TEST_CASE("every constraint measures depth", "[law]") {
  using enum role;
  obey<constraint, d2>(ph::half_space<d2>{{1, 2}, {1, 1}, 100});
  obey<constraint, f3>(ph::half_space<f3>{{1, 2, 3}, {1, 1, 1}, 100});
  obey<constraint, d2>(ph::segment<d2>{.a = {1, 0}, .b = {0, 1}, .stiffness = 100});
  obey<constraint, f2>(ph::segment<f2>{.a = {1, 0}, .b = {0, 1}, .stiffness = 100});
  obey<constraint, d3>(
      ph::triangle<d3>{.a = {1, 0, 0}, .b = {0, 1, 1}, .c = {1, 3, 0}, .stiffness = 100});
  obey<constraint, f3>(
      ph::triangle<f3>{.a = {1, 0, 0}, .b = {0, 1, 1}, .c = {1, 3, 0}, .stiffness = 100});
}

TEST_CASE("a followed constraint of any kind keeps the newest", "[law]") {
  const ph::freshness soon{.stale_after = 0.01, .fade = 0.02};
  CHECK(laws::keeps_the_newest<f1>(ph::followed<ph::half_space<f1>>{soon}, wall<f1>(100)));
  CHECK(laws::keeps_the_newest<d1>(ph::followed{wall<d1>(7)}, wall<d1>(100)));
  CHECK(laws::keeps_the_newest<d3>(ph::followed<ph::half_space<d3>>{},
                                   ph::half_space<d3>{{1, 2, 3}, {1, 1, 1}, 100}));
  CHECK(laws::keeps_the_newest<f2>(ph::followed<ph::segment<f2>>{soon},
                                   ph::segment<f2>{.a = {1, 0}, .b = {0, 1}, .stiffness = 100}));
  CHECK(laws::keeps_the_newest<d3>(
      ph::followed<ph::triangle<d3>>{},
      ph::triangle<d3>{.a = {1, 0, 0}, .b = {0, 1, 1}, .c = {1, 3, 0}, .stiffness = 100}));
}
