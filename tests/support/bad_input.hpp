// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Bad input for any model. The answer must be force zero or the last good constraint, and an event, and the
// ledger must never gain credit.
#include "support/any_model.hpp"
#include "support/catch.hpp"

namespace bad_input {

inline void press(any_model& model, int ticks) {
  for (int n = 0; n < ticks; ++n) (void)model.press(0.001 + 1e-5 * n);
}

/// A bad sample gives force zero and an event, and costs credit.
inline void samples(any_model fresh) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  struct bad {
    const char* name;
    double x, dt;  ///< x = `good` stands for a good place
  };
  const double T = 0.001, here = 0.0012, good = 0.5;
  const std::vector<bad> all{{"NaN position", nan, T},
                             {"infinite position", infinity, T},
                             {"−infinite position", -infinity, T},
                             {"jump of 1 km", 1000, T},
                             {"jump to the end of numbers", fresh.largest(), T},
                             {"dt = 0", good, 0},
                             {"dt < 0", good, -T},
                             {"dt NaN", good, nan},
                             {"dt infinite", good, infinity}};
  REQUIRE(fresh.update());
  press(fresh, 20);
  REQUIRE(any_model(fresh).press(here).what != ph::event::rejected_sample);  // the control
  for (const bad& sample : all) {
    INFO(sample.name);
    any_model model = fresh;
    const auto tick = [&] {
      return sample.x == good ? model.press(here, sample.dt) : model.go_to(sample.x, sample.dt);
    };
    const double before = model.energy();
    const auto out = tick();
    CHECK(out.what == ph::event::rejected_sample);
    CHECK_FALSE(out.pushes());
    CHECK(out.energy <= before);
    double credit = model.energy();
    for (int n = 0; n < 5; ++n) {  // repeated, without a motion that could earn credit
      CHECK_FALSE(tick().pushes());
      CHECK(model.energy() <= credit);
      credit = model.energy();
    }
    const auto after = model.press(here);  // contact comes back from the first good sample on
    CHECK(after.what != ph::event::rejected_sample);
    CHECK(after.is_finite());
    CHECK(model.energy() <= credit);
  }
}

/// An unusable target is refused with an event, and the last good one stays.
inline void targets(any_model model) {
  for (std::size_t i = 0; i < model.bad_ones(); ++i) {  // before the first good target
    CHECK_FALSE(model.update_badly(i));
    const auto out = model.press(0.001);
    CHECK_FALSE(out.pushes());
    CHECK(out.what == ph::event::rejected_target);
  }
  REQUIRE(model.update());
  press(model, 20);
  for (std::size_t i = 0; i < model.bad_ones(); ++i) {
    any_model twin = model;
    CHECK_FALSE(model.update_badly(i));
    const auto out = model.press(0.0012), undisturbed = twin.press(0.0012);
    CHECK(out.what == ph::event::rejected_target);
    CHECK(undisturbed.what != ph::event::rejected_target);
    CHECK(out.force == undisturbed.force);
    CHECK(out.energy == undisturbed.energy);
  }
}

/// A force that would overflow becomes zero.
inline void stiffness(any_model model) {
  REQUIRE(model.update(model.largest()));
  for (int n = 0; n < 50; ++n) CHECK(model.press(n % 2 == 0 ? 0.5 : 0.45).is_finite());
}

/// check() names a bad parameter, and a model with one ticks with force zero.
inline void parameters(any_model model, const char* parameter) {
  const auto fault = model.check();
  REQUIRE(fault);
  CHECK(std::string(fault.parameter) == parameter);
  CHECK_FALSE(std::string(fault.remedy).empty());
  for (int n = 0; n < 3; ++n) {
    const auto out = model.press(0.001);
    CHECK(out.what == ph::event::rejected_parameters);
    CHECK_FALSE(out.pushes());
  }
}

/// A model over a constraint that the environment moves.
template <class Constraint, class Limits = ph::loop_limits>
any_model over(const auto& law, const auto& bound, const Limits& limits = thesis_loop,
               const ph::turn_limited& normals = {.rate = 4.0},
               const ph::reduced_energy& ledger = {.damping = 0.03, .loan = 0.02}) {
  return any_model(ph::local_model{typename Constraint::space_type{}, ph::followed<Constraint>{},
                                   normals, law, ledger, bound, limits});
}

/// Gives each part of a model a parameter that it refuses.
template <class Space>
void all_parameters() {
  using plane = ph::half_space<Space>;
  const auto standing = [](const plane& constraint) {
    return any_model(ph::local_model{Space{}, ph::fixed{constraint}, ph::turn_at_once{},
                                     ph::spring{}, thesis_ledger(), ph::strict_bound{},
                                     thesis_loop});
  };
  const double nan = std::nan("");
  const ph::spring spring;
  const ph::strict_bound strict;
  auto flat = good_constraint<plane>();
  flat.stiffness = 0;
  auto shapeless = good_constraint<plane>();
  shapeless.normal = Space::zero();
  parameters(standing(shapeless), "constraint");
  parameters(standing(flat), "stiffness");
  parameters(over<plane>(spring, strict, thesis_loop, {.rate = 4.0}, {.damping = nan}), "damping");
  parameters(over<plane>(spring, strict, thesis_loop, {.rate = -1.0}), "rate");
  parameters(over<plane>(ph::damped_spring{.mass = 0.0}, strict), "mass");
  parameters(over<plane>(spring, ph::reachable_bound{.mass = -1.0}), "mass");
  parameters(over<plane>(spring, strict, ph::loop_limits{.longest_tick = 0.0}), "longest_tick");
  parameters(over<plane>(spring, strict, ph::loop_limits{.longest_tick = 0.001, .top_speed = nan}),
             "top_speed");
  CHECK_FALSE(standing(good_constraint<plane>()).check());  // the controls
  CHECK_FALSE(over<plane>(spring, strict).check());
}

/// Tries bad input in the first sample, and in the force that a device reports.
template <class Space>
void first_samples() {
  using scalar = typename Space::scalar;
  using sample = ph::device_sample<Space>;
  const scalar T = scalar(0.001);
  const auto here = inside<Space>(scalar(0.001));
  for (const scalar x :
       {std::numeric_limits<scalar>::quiet_NaN(), std::numeric_limits<scalar>::infinity()}) {
    const auto bad = all<Space>(x);
    ph::local_model model{Space{},
                          ph::fixed{good_constraint<ph::half_space<Space>>()},
                          ph::turn_at_once{},
                          ph::spring{},
                          thesis_ledger(),
                          ph::strict_bound{},
                          thesis_loop};
    CHECK(model.tick(bad, ph::seconds{T}).what == ph::event::rejected_sample);
    CHECK(model.tick(here, ph::seconds{T}).what == ph::event::nominal);
    const auto lies = model.tick(sample{.position = here, .held = bad, .dt = T, .valid = true});
    CHECK(lies.what == ph::event::rejected_sample);
    CHECK(lies.force == Space::zero());
    CHECK(model.tick(sample{}).what == ph::event::rejected_sample);
    CHECK(ph::kernels::is_finite(model.energy()));
    CHECK(model.tick(here, ph::seconds{T}).what == ph::event::nominal);
  }
}

}  // namespace bad_input
