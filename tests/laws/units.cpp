// SPDX-License-Identifier: BSD-3-Clause
// Ports of the core in other units (support/units.hpp).
#include "support/units.hpp"

#include <passive_haptics/compositions.hpp>
#include <passive_haptics/motion_estimator/mass_observer.hpp>

using namespace in_units;

TEST_CASE("one surface is felt alike in any units, whichever way it is turned", "[law][units]") {
  const auto wall = [](const units& u) {
    return ph::local_model{d1{},
                           followed<ph::half_space<d1>>(u),
                           ph::turn_at_once{},
                           damped(u),
                           ph::reduced_energy{.damping = 0.03 * u.damp()},
                           reach(u),
                           limits(u)};
  };
  indifferent<d1>(all_others, wall, planes<d1>, by_itself<d1>);
  const auto floor = [](const units& u) {
    return ph::local_model{
        d3{},
        followed<ph::half_space<d3>>(u),
        ph::turn_limited{.rate = 1.0 / u.s},
        ph::virtual_coupling{.stiffness = 2000.0 * u.stiff(), .damping = 0.02 * u.damp()},
        ph::capped_energy{.damping = 0.05 * u.damp(),
                          .loan = 1e-3 * u.J(),
                          .cap = 2e-3 * u.J(),
                          .reset_after = 0.5 * u.s},
        ph::strict_bound{},
        late<1>(u)};
  };
  indifferent<d3>(all_others, floor, planes<d3>, by_itself<d3>);
  const auto facet = [](const units& u) {
    using kept = ph::basic_reduced_energy<ph::isotropic_damping, ph::ledger_sum::compensated>;
    return ph::local_model{
        d3{},
        followed<ph::triangle<d3>>(u),
        ph::turn_limited{.rate = 1.0 / u.s},
        ph::shaped{ph::spring{}, ph::force_rate_limit{.rate = 100.0 * u.N / u.s}},
        kept{.damping = 0.03 * u.damp()},
        ph::bound_chain{reach(u), ph::actuator_limit{.most = 2.0 * u.N}},
        ph::watched_loop_limits<>{
            .longest_tick = 1e-3 * u.s, .top_speed = 5.0 * u.speed(), .workspace = 2.0 * u.m}};
  };
  indifferent<d3>(all_others, facet, triangles, by_itself<d3>);
}

TEST_CASE("what eases, forgives and watches is felt alike in any units of force", "[law][units]") {
  const auto touch = [](const units& u) {
    return ph::local_model{
        d3{},
        followed<ph::half_space<d3>>(u),
        ph::turn_limited{.rate = 2.0},
        ph::eased{damped(u), ph::news_pace{.least_force_rate = 5.0 * u.N,
                                           .usual_force_rate = 19.5 * u.N,
                                           .most_force_rate = 50.0 * u.N}},
        ph::forgiving{ph::reduced_energy{.damping = 0.05 * u.damp()}, 0.02 * u.J()},
        ph::bound_chain{ph::watched{reach(u)}, ph::actuator_limit{.most = 8.0 * u.N}},
        limits(u)};
  };
  indifferent<d3>(other_forces, touch, planes<d3>, by_itself<d3>);
  const auto moved = [](const units& u) {
    return [u](auto& port, int n) {
      const double rises = 5e-4 * 9.0 * std::cos(9e-3 * n);
      (void)port.update(plane<d3>(u, n),
                        ph::surface_motion<d3>{
                            .velocity = u.vector<d3>({0.0, 0.0, rises}, u.speed()), .age = 0.01});
    };
  };
  indifferent<d3>(other_forces, touch, moved, by_itself<d3>);
  const auto settled = [](const units& u) {
    return ph::passive_port{
        d3{},
        ph::settled_force{.mass = 0.1 * u.kg(),
                          .slide_fraction = 0.0,  // its dry friction is stated in newtons
                          .force_limit = 8.0 * u.N},
        ph::forgiving{ph::reduced_energy{.damping = 0.05 * u.damp()}, 0.02 * u.J()},
        ph::bound_chain{reach(u), ph::actuator_limit{.most = 8.0 * u.N}}, late<1>(u)};
  };
  indifferent<d3>(other_forces, settled, none, given<d3>);
  const auto on_a_line = [](const units& u) {
    return ph::passive_port{
        d1{}, ph::settled_force{.mass = 0.1 * u.kg(), .force_limit = 8.0 * u.N},
        ph::reduced_energy{.damping = 0.05 * u.damp()},
        ph::bound_chain{ph::watched{reach(u)}, ph::actuator_limit{.most = 8.0 * u.N}}, limits(u)};
  };
  indifferent<d1>(other_forces, on_a_line, none, given<d1>);
}

TEST_CASE("friction on encoders is felt alike in any units", "[law][units]") {
  const auto steps = [](const units& u) {
    return ph::local_model{d3{},
                           followed<ph::half_space<d3>>(u),
                           ph::turn_limited{.rate = 2.0 / u.s},
                           ph::capped{damped(u), 1200.0 * u.stiff(), 1e-3 * u.J()},
                           ph::dual_ledger{.damping = {.coefficient = 0.05 * u.damp(),
                                                       .coulomb = 0.13 * u.N,
                                                       .presliding = 15e-6 * u.m},
                                           .quantum = 55e-6 * u.m,
                                           .loan = 1e-4 * u.J(),
                                           .window = 0.032 * u.s},
                           ph::bound_chain{reach(u), ph::thermal_limit{.peak = 4.0 * u.N,
                                                                       .continuous = 1.0 * u.N,
                                                                       .time_constant = 0.5 * u.s}},
                           limits(u),
                           ph::edge_observer{.quantum = 55e-6 * u.m, .presliding = 15e-6 * u.m}};
  };
  indifferent<d3>({.m = 4.0, .N = 0.25, .q = 55e-6}, steps, planes<d3>, by_itself<d3>);
  const auto each_axis = [](const units& u) {
    const double b = 0.05 * u.damp(), c = 0.13 * u.N, p = 15e-6 * u.m, q = 55e-6 * u.m;
    using ledger =
        ph::basic_dual_ledger<ph::diagonal_damping_and_friction<2>, ph::encoder_steps<2>>;
    return ph::passive_port{
        d2{}, ph::given_force{.stale_after = 0.05 * u.s, .fade = 0.02 * u.s},
        ledger{.damping = {{b, 2.0 * b}, {c, 2.0 * c}, {p, 2.0 * p}},
               .quantum = {{q, 2.0 * q}},
               .window = 0.032 * u.s},
        ph::bound_chain{ph::strict_bound{}, ph::actuator_limit{.most = 3.0 * u.N}}, limits(u)};
  };
  indifferent<d2>(others_in_steps, each_axis, none, given<d2>);
  const auto observed = [](const units& u) {
    return ph::local_model{d1{},
                           followed<ph::half_space<d1>>(u),
                           ph::turn_at_once{},
                           damped(u),
                           ph::quantised_energy{.damping = 0.1 * u.damp(), .quantum = 55e-6 * u.m},
                           reach(u),
                           late<2>(u),
                           ph::mass_observer{.mass = 0.1 * u.kg(), .quantum = 55e-6 * u.m}};
  };
  indifferent<d1>({.m = 4.0, .N = 0.25, .q = 55e-6}, observed, planes<d1>, by_itself<d1>);
}

TEST_CASE("surfaces in slots are felt alike in any units, whichever way they are turned",
          "[law][units]") {
  const auto rows = [](const units& u) {
    return ph::passive_port{
        d3{},
        ph::contact_set{proxy(u), pace(u), rough(u), ph::slots<ph::half_space<d3>, 2>{},
                        ph::slots<ph::triangle<d3>, 1>{}, ph::slots<ph::sphere<d3>, 1>{}},
        ph::reduced_energy{.damping = 0.05 * u.damp()}, reach(u), limits(u)};
  };
  const auto shown = [](const units& u) {
    return [u](auto& port, int n) {
      auto& source = port.source();
      CHECK(source.update(0, plane<d3>(u, n)));
      auto side = plane<d3>(u, n);
      side.normal = u.vector<d3>({1.0, 0.1, 0.3}, 1.0);
      side.point = u.vector<d3>({-4e-3, 0.0, 0.0}, u.m);
      if (n % 165 == 132)
        source.release(1);
      else
        CHECK(source.update(1, side));
      if (n % 99 == 0) CHECK(source.update(0, triangle(u, n)));
      if (n % 132 == 0)
        CHECK(source.update(0, ph::sphere<d3>{u.vector<d3>({0.01, 0.0, -0.02}, u.m), 0.02 * u.m,
                                              700.0 * u.stiff()}));
    };
  };
  indifferent<d3>(all_others, rows, shown, by_itself<d3>);
  const auto many = [](const units& u) {
    return ph::passive_port{d3{},
                            ph::contact_set{proxy(u), pace(u), ph::slots<ph::half_space<d3>, 2>{},
                                            ph::slots<ph::quadric<d3>, 4>{}},
                            ph::reduced_energy{.damping = 0.05 * u.damp()}, reach(u), late<1>(u)};
  };
  const auto bowls = [](const units& u) {
    return [u](auto& port, int n) {
      auto& source = port.source();
      CHECK(source.update(0, plane<d3>(u, n)));
      for (int i = 0; i < 4; ++i) {
        const double a = 1.5 * i + 1e-3 * n;
        CHECK(source.update(
            i, ph::quadric<d3>{
                   .point = u.vector<d3>({5e-3 * std::cos(a), 5e-3 * std::sin(a), 5e-4}, u.m),
                   .normal = u.vector<d3>({0.1 * i, 0.1, 1.0}, 1.0),
                   .tangent = u.vector<d3>({1.0, 0.5, 0.0}, 1.0),
                   .curvature = 20.0 / u.m,
                   .cross_curvature = -10.0 / u.m,
                   .stiffness = 600.0 * u.stiff(),
                   .thickness = 0.02 * u.m}));
      }
    };
  };
  indifferent<d3>(other_lengths, many, bowls, by_itself<d3>);
}
