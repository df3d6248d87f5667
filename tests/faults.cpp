// SPDX-License-Identifier: BSD-3-Clause
// Bad input, every bound, float and double: force zero or the last good constraint, an event, and a
// ledger that never gains credit.
#include "support/catch.hpp"
#include "support/scenes.hpp"

#include <vector>

namespace {

/// Calls test(model) for a model of every bound over a following constraint.
template <class Space, class Constraint, class Test>
void for_every_bound(Test test) {
  using scalar = typename Space::scalar;
  const auto with = [&test](const auto& contact, const auto& bound) {
    auto ledger = thesis_ledger<Space>();
    ledger.energy = scalar(0.02);
    test(ph::local_model{Space{}, ph::following<Constraint>{},
                         ph::rotate_limited<Space>{.rate = scalar(4)}, contact, ledger, bound});
  };
  const ph::spring<Space> spring;
  const ph::damped_spring<Space> damped{.mass = scalar(0.1)};
  const ph::strict_bound<Space> strict;
  const ph::reachable_bound<Space> reachable{.mass = scalar(0.1), .hand_force = scalar(5)};
  const ph::actuator_limit<Space> motors{.most = scalar(9)};
  const ph::force_rate_limit<Space> rate{.rate = scalar(100)};
  with(spring, ph::no_bound<Space>{});
  with(spring, strict);
  with(damped, strict);
  with(spring, ph::strict_bound<Space, 1>{});
  with(spring, ph::strict_bound<Space, 3>{});
  with(spring, ph::thesis_bound<Space>{});
  with(spring, reachable);
  with(damped, reachable);
  with(spring, motors);
  with(spring, rate);
  with(damped, ph::bound_chain{rate, reachable, motors});
}

template <class Constraint>
Constraint good_constraint() {
  using space = typename Constraint::space_type;
  using scalar = typename space::scalar;
  if constexpr (space::dof == 1) {
    return wall<space>(scalar(500));
  } else if constexpr (requires(Constraint c) { c.c; }) {
    return {.a = {-1, -1, 0}, .b = {1, -1, 0}, .c = {0, 1, 0}, .stiffness = 500};
  } else if constexpr (requires(Constraint c) { c.a; }) {
    return {.a = {1, 0}, .b = {-1, 0}, .stiffness = 500};
  } else {
    typename space::vector n = space::zero();
    n(space::dof - 1) = 1;
    return {space::zero(), n, 500};
  }
}

/// A position `depth` inside the good constraint.
template <class Space>
typename Space::vector inside(typename Space::scalar depth) {
  if constexpr (Space::dof == 1) {
    return depth;
  } else {
    typename Space::vector x = Space::zero();
    x(Space::dof - 1) = -depth;
    return x;
  }
}

template <class Space>
typename Space::vector all(typename Space::scalar value) {
  if constexpr (Space::dof == 1) {
    return value;
  } else {
    return Space::vector::Constant(value);
  }
}

template <class Model, class Space = typename Model::space_type>
void press(Model& model, int ticks) {
  using scalar = typename Space::scalar;
  for (int n = 0; n < ticks; ++n) {
    (void)model.tick(inside<Space>(scalar(0.001) + scalar(1e-5) * scalar(n)), scalar(0.001));
  }
}

}  // namespace

TEMPLATE_TEST_CASE("a bad sample gives force zero and an event, and costs credit", "[fault]",
                   ph::half_space<d1>, ph::half_space<f1>, ph::segment<d2>, ph::segment<f2>,
                   ph::triangle<d3>, ph::triangle<f3>) {
  using space = typename TestType::space_type;
  using scalar = typename space::scalar;
  using limits = std::numeric_limits<scalar>;
  struct bad {
    const char* name;
    typename space::vector x;
    scalar dt;
  };
  const auto here = inside<space>(scalar(0.0012));
  const scalar T = scalar(0.001);
  const std::vector<bad> samples{{"NaN position", all<space>(limits::quiet_NaN()), T},
                                 {"infinite position", all<space>(limits::infinity()), T},
                                 {"−infinite position", all<space>(-limits::infinity()), T},
                                 {"jump of 1 km", all<space>(1000), T},
                                 {"jump to the end of numbers", all<space>(limits::max()), T},
                                 {"dt = 0", here, 0},
                                 {"dt < 0", here, -T},
                                 {"dt NaN", here, limits::quiet_NaN()},
                                 {"dt infinite", here, limits::infinity()}};
  for_every_bound<space, TestType>([&](auto fresh) {
    REQUIRE(fresh.retarget(good_constraint<TestType>()));
    press(fresh, 20);
    const auto control = decltype(fresh)(fresh).tick(here, T);
    REQUIRE(control.what != ph::event::rejected_sample);
    for (const bad& sample : samples) {
      INFO(sample.name);
      auto model = fresh;
      const scalar before = model.energy();
      const auto out = model.tick(sample.x, sample.dt);
      CHECK(out.what == ph::event::rejected_sample);
      CHECK(out.force == space::zero());
      CHECK(out.energy <= before);
      scalar credit = model.energy();
      for (int n = 0; n < 5; ++n) {  // and again, with no way to earn
        CHECK(model.tick(sample.x, sample.dt).force == space::zero());
        CHECK(model.energy() <= credit);
        credit = model.energy();
      }
      const auto after = model.tick(here, T);  // contact comes back from the first good sample on
      CHECK(after.what != ph::event::rejected_sample);
      CHECK(space::is_finite(after.force));
      CHECK(model.energy() <= credit);
    }
  });
}

TEMPLATE_TEST_CASE("the very first sample and a reported force may be bad, too", "[fault]", d1, f1,
                   d3, f3) {
  using scalar = typename TestType::scalar;
  using sample = ph::device_sample<TestType>;
  const scalar T = scalar(0.001);
  const auto here = inside<TestType>(scalar(0.001));
  for (const scalar x :
       {std::numeric_limits<scalar>::quiet_NaN(), std::numeric_limits<scalar>::infinity()}) {
    const auto bad = all<TestType>(x);
    ph::local_model model{TestType{},
                          ph::rigid{good_constraint<ph::half_space<TestType>>()},
                          ph::snap<TestType>{},
                          ph::spring<TestType>{},
                          thesis_ledger<TestType>(),
                          ph::strict_bound<TestType>{}};
    CHECK(model.tick(bad, T).what == ph::event::rejected_sample);
    CHECK(model.tick(here, T).what == ph::event::nominal);
    const auto lies = model.tick(sample{.position = here, .held = bad, .dt = T, .valid = true});
    CHECK(lies.what == ph::event::rejected_sample);
    CHECK(lies.force == TestType::zero());
    CHECK(model.tick(sample{}).what == ph::event::rejected_sample);
    CHECK(ph::kernels::is_finite(model.energy()));
    CHECK(model.tick(here, T).what == ph::event::nominal);
  }
}

TEMPLATE_TEST_CASE("an unusable target is refused with an event and the last good one stays",
                   "[fault]", ph::half_space<d1>, ph::half_space<f3>, ph::segment<d2>,
                   ph::triangle<d3>, ph::triangle<f3>) {
  using space = typename TestType::space_type;
  using scalar = typename space::scalar;
  using limits = std::numeric_limits<scalar>;
  std::vector<TestType> targets;
  for (const scalar K : {scalar(0), scalar(-500), limits::quiet_NaN(), limits::infinity()}) {
    targets.push_back(good_constraint<TestType>());
    targets.back().stiffness = K;
  }
  for (const scalar x : {limits::quiet_NaN(), limits::infinity()}) {
    targets.push_back(good_constraint<TestType>());
    if constexpr (requires(TestType c) { c.a; }) {
      targets.back().a = all<space>(x);
    } else {
      targets.back().point = all<space>(x);
      targets.push_back(good_constraint<TestType>());
      targets.back().normal = all<space>(x);
    }
  }
  targets.push_back(good_constraint<TestType>());
  if constexpr (requires(TestType c) { c.a; }) {
    targets.back().a = targets.back().b;
  } else {
    targets.back().normal = space::zero();
  }
  for_every_bound<space, TestType>([&](auto model) {
    for (const TestType& target : targets) {  // before there was a good one
      CHECK_FALSE(model.retarget(target));
      const auto out = model.tick(inside<space>(scalar(0.001)), scalar(0.001));
      CHECK(out.force == space::zero());
      CHECK(out.what == ph::event::rejected_target);
    }
    REQUIRE(model.retarget(good_constraint<TestType>()));
    press(model, 20);
    for (const TestType& target : targets) {
      auto twin = model;
      CHECK_FALSE(model.retarget(target));
      const auto x = inside<space>(scalar(0.0012));
      const auto out = model.tick(x, scalar(0.001));
      const auto undisturbed = twin.tick(x, scalar(0.001));
      CHECK(out.what == ph::event::rejected_target);
      CHECK(undisturbed.what != ph::event::rejected_target);
      CHECK(out.force == undisturbed.force);
      CHECK(out.energy == undisturbed.energy);
    }
  });
}

TEMPLATE_TEST_CASE("bad parameters are named, and tick with force zero", "[fault]", d1, f1, d3,
                   f3) {
  using scalar = typename TestType::scalar;
  const auto silent = [](auto model, const char* parameter) {
    const auto fault = model.check();
    REQUIRE(fault);
    CHECK(std::string(fault.parameter) == parameter);
    CHECK_FALSE(std::string(fault.remedy).empty());
    for (int n = 0; n < 3; ++n) {
      const auto out = model.tick(inside<TestType>(scalar(0.001)), scalar(0.001));
      CHECK(out.what == ph::event::rejected_parameters);
      CHECK(out.force == TestType::zero());
    }
  };
  const auto good = good_constraint<ph::half_space<TestType>>();
  const ph::snap<TestType> snap;
  const ph::spring<TestType> spring;
  const auto ledger = thesis_ledger<TestType>();
  const ph::strict_bound<TestType> strict;
  const scalar nan = std::numeric_limits<scalar>::quiet_NaN();
  auto flat = good;
  flat.stiffness = 0;
  auto shapeless = good;
  shapeless.normal = TestType::zero();
  silent(ph::local_model{TestType{}, ph::rigid{shapeless}, snap, spring, ledger, strict},
         "constraint");
  silent(ph::local_model{TestType{}, ph::rigid{flat}, snap, spring, ledger, strict}, "stiffness");
  silent(ph::local_model{TestType{}, ph::rigid{good}, snap, spring,
                         ph::reduced_energy<TestType>{.damping = nan}, strict},
         "damping");
  silent(ph::local_model{TestType{}, ph::rigid{good}, ph::rotate_limited<TestType>{.rate = -1},
                         spring, ledger, strict},
         "rate");
  silent(ph::local_model{TestType{}, ph::rigid{good}, snap, ph::damped_spring<TestType>{.mass = 0},
                         ledger, strict},
         "mass");
  silent(ph::local_model{TestType{}, ph::rigid{good}, snap, spring, ledger,
                         ph::reachable_bound<TestType>{.mass = -1}},
         "mass");
  silent(ph::local_model{TestType{}, ph::rigid{good}, snap, spring, ledger, strict,
                         ph::loop_limits<TestType>{.longest_tick = 0}},
         "longest_tick");
  silent(ph::local_model{TestType{}, ph::rigid{good}, snap, spring, ledger, strict,
                         ph::loop_limits<TestType>{.top_speed = nan}},
         "top_speed");
  const ph::local_model sound{TestType{}, ph::rigid{good}, snap, spring, ledger, strict};
  CHECK_FALSE(sound.check());  // the control
}

TEMPLATE_TEST_CASE("a force beyond all numbers is no force", "[fault]", ph::half_space<d1>,
                   ph::half_space<f1>, ph::half_space<d3>, ph::half_space<f3>) {
  using space = typename TestType::space_type;
  using scalar = typename space::scalar;
  auto target = good_constraint<TestType>();
  target.stiffness = std::numeric_limits<scalar>::max();
  for_every_bound<space, TestType>([&](auto model) {
    REQUIRE(model.retarget(target));
    for (int n = 0; n < 50; ++n) {
      const scalar depth = n % 2 == 0 ? scalar(0.5) : scalar(0.45);
      const auto out = model.tick(inside<space>(depth), scalar(0.001));
      CHECK(space::is_finite(out.force));
      CHECK(ph::kernels::is_finite(out.energy));
      CHECK(ph::kernels::is_finite(out.depth));
    }
  });
}

TEST_CASE("a tick whose energy is no number is refused, and the ledger stays one", "[fault]") {
  ph::reduced_energy<d1> ledger = thesis_ledger<d1>();
  ledger.damping = 1e308;
  auto model = following_half_space<d1>(ph::spring<d1>{}, ledger, ph::strict_bound<d1>{});
  model.retarget(wall<d1>(500));
  CHECK(model.tick(0.0, 1e-3).what == ph::event::nominal);
  CHECK(model.tick(1e-4, 1e-3).what == ph::event::nominal);  // the control: 1e303 J
  const auto beyond = model.tick(0.09, 1e-3);
  CHECK(beyond.what == ph::event::rejected_sample);
  CHECK(beyond.force == 0.0);
  CHECK(ph::kernels::is_finite(model.energy()));
}

TEST_CASE("a late tick is reported, and costs what it may have cost with or without a watchdog",
          "[fault]") {
  auto model = following_half_space<d1>(ph::spring<d1>{}, thesis_ledger<d1>(),
                                        ph::strict_bound<d1>{}, {.longest_tick = 1.2e-3});
  model.retarget(wall<d1>(500));
  (void)model.tick(0.0, 1e-3);
  CHECK(model.tick(1e-3, 1.2e-3).what == ph::event::nominal);
  const double before = model.energy();
  const auto late = model.tick(1.5e-3, 3e-3);
  CHECK(late.what == ph::event::late_tick);
  CHECK(before > 0.0);
  CHECK_THAT(late.energy, Catch::Matchers::WithinAbs(0.0, 1e-15));  // the bound had spent it all

  auto bare = following_half_space<d1>(ph::spring<d1>{}, thesis_ledger<d1>(), ph::no_bound<d1>{},
                                       {.longest_tick = 1.2e-3});
  bare.retarget(wall<d1>(500));
  (void)bare.tick(0.0, 1e-3);
  CHECK(bare.tick(1e-3, 1e-3).energy > 0.0);
  CHECK(bare.tick(-0.019, 3e-3).energy < -5e-3);  // no watchdog: 0.5 N have worked for 20 mm
}

TEST_CASE("a debt is an event, and events say what they are", "[fault]") {
  auto model = following_half_space<d1>(ph::spring<d1>{}, thesis_ledger<d1>(), ph::no_bound<d1>{});
  model.retarget(wall<d1>(1e4));
  (void)model.tick(0.0, 1e-3);
  CHECK(model.tick(1e-3, 1e-3).what == ph::event::nominal);
  CHECK(model.tick(0.0, 1e-3).what == ph::event::debt);
  for (int e = 0; e <= static_cast<int>(ph::event::rejected_parameters); ++e) {
    CHECK(std::string(ph::to_string(static_cast<ph::event>(e))) != "unknown event");
  }
  CHECK(std::string(ph::to_string(static_cast<ph::event>(200))) == "unknown event");
}
