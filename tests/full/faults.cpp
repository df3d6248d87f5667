// SPDX-License-Identifier: BSD-3-Clause
// Bad input for every bound, shaper, law and constraint, float and double. Bounds never see a
// constraint, so each bound meets half-spaces, and each other constraint what differs in its source.
#include "support/bad_input.hpp"

namespace {

template <class Constraint>
std::vector<any_model> models_over() {
  const auto of = [](const auto&... parts) { return bad_input::over<Constraint>(parts...); };
  const ph::spring spring;
  const ph::damped_spring damped{.mass = 0.1};
  const ph::strict_bound strict;
  const ph::reachable_bound reachable{.mass = 0.1, .hand_force = 5.0};
  const ph::actuator_limit motors{.most = 9.0};
  const ph::force_rate_limit rate{.rate = 100.0};
  std::vector<any_model> models{of(spring, strict),
                                of(ph::shaped{spring, ph::thesis_rule{}}, ph::no_bound{}),
                                of(ph::shaped{damped, rate}, ph::bound_chain{reachable, motors})};
  if constexpr (!requires(Constraint c) { c.a; }) {
    const ph::late_loop_limits<1> late{.longest_tick = 1e-3, .top_speed = 100.0, .watchdog = 1e-3};
    const ph::late_loop_limits<3> later{.longest_tick = 1e-3, .top_speed = 100.0, .watchdog = 1e-3};
    for (auto& model : {of(spring, ph::no_bound{}), of(damped, strict), of(spring, strict, late),
                        of(spring, strict, later), of(spring, reachable), of(damped, reachable),
                        of(spring, motors), of(ph::shaped{spring, rate}, ph::no_bound{})}) {
      models.push_back(model);
    }
  }
  return models;
}

template <class Constraint>
void each(void (*test)(any_model)) {
  for (const any_model& model : models_over<Constraint>()) test(model);
}

}  // namespace

TEMPLATE_TEST_CASE("a bad sample gives force zero and an event, and costs credit", "[fault]",
                   ph::half_space<d1>, ph::half_space<f1>, ph::segment<d2>, ph::segment<f2>,
                   ph::half_space<d3>, ph::half_space<f3>, ph::triangle<d3>, ph::triangle<f3>) {
  each<TestType>(bad_input::samples);
}

TEMPLATE_TEST_CASE("an unusable target is refused with an event and the last good one stays",
                   "[fault]", ph::half_space<d1>, ph::half_space<f1>, ph::segment<d2>,
                   ph::segment<f2>, ph::half_space<d3>, ph::half_space<f3>, ph::triangle<d3>,
                   ph::triangle<f3>) {
  each<TestType>(bad_input::targets);
}

TEMPLATE_TEST_CASE("a force beyond all numbers is no force", "[fault]", ph::half_space<d1>,
                   ph::half_space<f1>, ph::segment<d2>, ph::segment<f2>, ph::half_space<d3>,
                   ph::half_space<f3>, ph::triangle<d3>, ph::triangle<f3>) {
  each<TestType>(bad_input::stiffness);
}

TEMPLATE_TEST_CASE("the very first sample and a reported force may be bad, too", "[fault]", d1, f1,
                   d3, f3) {
  bad_input::first_samples<TestType>();
}

TEMPLATE_TEST_CASE("bad parameters are named, and tick with force zero", "[fault]", d1, f1, d3,
                   f3) {
  bad_input::all_parameters<TestType>();
}
