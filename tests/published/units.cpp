// SPDX-License-Identifier: BSD-3-Clause
// The controllers of others in other units (support/units.hpp).
#include "support/units.hpp"

#include <passive_haptics/published/published.hpp>

using namespace in_units;

TEST_CASE("what others have published is felt alike in any units", "[law][units]") {
  const auto in = []<class Space>(Space, const auto& bound, const auto& ledger) {
    return [=](const units& u) {
      return ph::local_model{Space{},
                             followed<ph::half_space<Space>>(u),
                             ph::turn_limited{.rate = 2.0 / u.s},
                             damped(u),
                             ledger(u),
                             bound(u),
                             limits(u)};
    };
  };
  const auto plain = [](const units& u) {
    return ph::reduced_energy{.damping = 0.05 * u.damp(), .loan = 2e-3 * u.J()};
  };
  const auto tank = [](const units& u) { return ph::energy_tank{.reserve = 1e-5 * u.J()}; };
  indifferent<d2>(all_others, in(d2{}, tank, plain), planes<d2>, by_itself<d2>);
  const auto predicting = [](const units& u) {
    return ph::two_layer_tank{.wanted = 2e-3 * u.J(),
                              .refill = 5e3 * u.damp() / u.J(),
                              .max_damping = 5.0 * u.damp(),
                              .force_per_joule = 4000.0 * u.N / u.J(),
                              .cap = 4e-3 * u.J(),
                              .loan = 1e-3 * u.J()};
  };
  indifferent<d2>(all_others, in(d2{}, predicting, plain), planes<d2>, by_itself<d2>);
  const auto series = [](const units& u) {
    return ph::series_passivity_controller{.max_damping = 20.0 * u.damp(),
                                           .threshold = 1e-5 * u.J(),
                                           .least_speed = 1e-3 * u.speed(),
                                           .least_travel = 1e-6 * u.m,
                                           .reset_after = 0.3 * u.s,
                                           .loan = 1e-5 * u.J()};
  };
  indifferent<d2>(all_others, in(d2{}, series, plain), planes<d2>, by_itself<d2>);
  const auto counted = [](const units& u) {
    return ph::series_controller_with_damping{
        .max_damping = 20.0 * u.damp(), .threshold = 1e-5 * u.J(), .reset_after = 0.3 * u.s};
  };
  indifferent<d2>(all_others, in(d2{}, counted, plain), planes<d2>, by_itself<d2>);
  const auto bounding = [](const units& u) {
    return ph::energy_bounding{.slope = 40.0 * u.stiff(), .storage = 30.0 * u.stiff()};
  };
  const auto tight = [](const units& u) {
    return ph::tight_energy_bounding{.storage = 80.0 * u.stiff()};
  };
  const auto sector = [](const units& u) { return ph::sector_bound{.slope = 90.0 * u.stiff()}; };
  indifferent<d2>(all_others, in(d2{}, bounding, plain), planes<d2>, by_itself<d2>);
  indifferent<d2>(all_others, in(d2{}, tight, plain), planes<d2>, by_itself<d2>);
  indifferent<d1>(all_others, in(d1{}, sector, plain), planes<d1>, by_itself<d1>);
}

TEST_CASE("shapers of others are felt alike in any units", "[law][units]") {
  const auto with = [](const auto& shaper) {
    return [=](const units& u) {
      return ph::local_model{d2{},
                             followed<ph::half_space<d2>>(u),
                             ph::turn_limited{.rate = 2.0 / u.s},
                             ph::shaped{ph::spring{}, shaper(u)},
                             ph::reduced_energy{.damping = 0.5 * u.damp(), .loan = 1e-4 * u.J()},
                             ph::strict_bound{},
                             limits(u)};
    };
  };
  const auto grows = [](const units& u) {
    return ph::nonlinear_coupling{
        .initial = 200.0 * u.stiff(), .rate = 2e4 * u.stiff() / u.s, .most = 1200.0 * u.stiff()};
  };
  const auto steps = [](const units& u) {
    return ph::stiffness_increment{
        .initial = 200.0 * u.stiff(), .step = 100.0 * u.stiff(), .reset_after = 0.1 * u.s};
  };
  const auto offset = [](const units& u) {
    return ph::force_augmentation{.low = 300.0 * u.stiff(), .step = 0.2 * u.N};
  };
  const auto gate = [](const units& u) {
    return ph::set_position_modulation{
        .loan = 1e-5 * u.J(), .cap = 1e-3 * u.J(), .ask_again = 0.02 * u.s};
  };
  indifferent<d2>(all_others, with(grows), planes<d2>, by_itself<d2>);
  indifferent<d2>(all_others, with(steps), planes<d2>, by_itself<d2>);
  indifferent<d2>(all_others, with(offset), planes<d2>, by_itself<d2>);
  indifferent<d2>(all_others, with(gate), planes<d2>, by_itself<d2>);
}
