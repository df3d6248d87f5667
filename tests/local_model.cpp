// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// A model with every part replaceable, over a following half-space in 3 dimensions.
template <class Bound>
auto tilting(const Bound& bound, double loan) {
  auto ledger = thesis_ledger<d3>();
  ledger.energy = loan;
  return ph::local_model{d3{},
                         ph::following<ph::half_space<d3>>{},
                         ph::rotate_limited<d3>{.rate = 4.0},
                         ph::spring<d3>{},
                         ledger,
                         bound};
}

const d3::vector up(0, 0, 1);

}  // namespace

// All members compile in every dimension and both precisions.
template class ph::local_model<d1, ph::rigid<ph::half_space<d1>>, ph::snap<d1>, ph::spring<d1>,
                               ph::reduced_energy<d1>, ph::strict_bound<d1>>;
template class ph::local_model<f1, ph::following<ph::half_space<f1>>, ph::snap<f1>,
                               ph::damped_spring<f1>, ph::reduced_energy<f1>,
                               ph::reachable_bound<f1>>;
template class ph::local_model<d2, ph::following<ph::segment<d2>>, ph::rotate_limited<d2>,
                               ph::spring<d2>, ph::reduced_energy<d2>, ph::thesis_bound<d2>>;
template class ph::local_model<f3, ph::following<ph::triangle<f3>>, ph::rotate_limited<f3>,
                               ph::damped_spring<f3>,
                               ph::reduced_energy<f3, ph::diagonal_damping<f3>>,
                               ph::bound_chain<ph::force_rate_limit<f3>, ph::strict_bound<f3, 2>>>;

TEST_CASE("the ledger pairs a displacement with the force held while it happened (A27)",
          "[local_model]") {
  ph::reduced_energy<d1> ledger{.damping = 0.03, .energy = 0.1};
  ph::local_model model{d1{},   ph::rigid{wall<d1>(1000)}, ph::snap<d1>{},        ph::spring<d1>{},
                        ledger, ph::strict_bound<d1>{},    {.longest_tick = 2e-3}};
  const double x0 = 1e-3, x1 = 1.5e-3, x2 = 1.2e-3;
  const auto first = model.tick(x0, 1e-3);
  CHECK_THAT(first.force, WithinRel(-1.0, 1e-12));
  CHECK(first.energy == 0.1);  // no displacement is known yet
  const auto second = model.tick(x1, 1e-3);
  CHECK_THAT(second.energy, WithinRel(0.1 + 30 * 0.25e-6 + 1.0 * 0.5e-3, 1e-12));
  const auto third = model.tick(x2, 2e-3);
  CHECK_THAT(third.energy, WithinRel(second.energy + 15 * 0.09e-6 - 1.5 * 0.3e-3, 1e-12));
}

TEST_CASE("a device that reports what it held is believed, not the command (A28)",
          "[local_model]") {
  const auto make = [] {
    return following_half_space<d1>(ph::spring<d1>{}, thesis_ledger<d1>(), ph::thesis_bound<d1>{});
  };
  auto told = make(), untold = make();
  told.retarget(wall<d1>(1e4));
  untold.retarget(wall<d1>(1e4));
  double x = -1e-3;
  for (int n = 0; n < 20; ++n, x += 5e-4) {
    const double commanded = n == 0 ? 0.0 : told.contact().force(x - 5e-4, 0);
    const double held = -std::min(commanded, 9.0);
    (void)told.tick({.position = x, .held = held, .dt = 1e-3, .valid = true});
    (void)untold.tick(x, 1e-3);
  }
  CHECK(told.energy() < untold.energy());  // the motors never gave the force the other one booked
  CHECK_THAT(told.tick({.position = x, .held = 0, .dt = 1e-3, .valid = false}).force,
             WithinAbs(0, 0));
}

TEST_CASE("forces in flight are paired with the tick that will hold them (latency)",
          "[local_model]") {
  ph::reduced_energy<d1> ledger{.damping = 0.03, .energy = 1.0};
  ph::local_model model{d1{},   ph::rigid{wall<d1>(1000)}, ph::snap<d1>{}, ph::spring<d1>{},
                        ledger, ph::strict_bound<d1, 2>{}};
  double x = 0, expected = 1.0;
  std::array<double, 40> forces{};
  for (std::size_t n = 0; n < forces.size(); ++n) {
    const double dx = 1e-4 * std::sin(0.5 * static_cast<double>(n));
    x += dx;
    const auto out = model.tick(x, 1e-3);
    forces[n] = out.force;
    if (n >= 1) expected += 30 * dx * dx - (n >= 3 ? forces[n - 3] : 0.0) * dx;
    CHECK_THAT(out.energy, WithinRel(expected, 1e-12));
  }
}

TEST_CASE("the four contact combinations of Fig. 2.7 (A23)", "[local_model]") {
  auto model = tilting(ph::thesis_bound<d3>{}, 0.01);
  const double f_max = std::sqrt(4 * 30 * 0.01);
  SECTION("neither: the environment's constraint as it is, force zero") {
    model.retarget({{0, 0, -0.01}, up, 1000});
    const auto out = model.tick({0, 0, 0}, 1e-3);
    CHECK(out.force == d3::zero());
    CHECK(out.depth == 0);
    CHECK(model.local().depth({0, 0, 0}) == model.target().depth({0, 0, 0}));
  }
  SECTION("environment only: shifted to what the ledger allows, its normal at once (2.33)") {
    model.retarget({{0, 0, -0.01}, up, 1000});
    (void)model.tick({0, 0, 0}, 1e-3);
    const d3::vector tilted = d3::vector(0.6, 0, 0.8);
    model.retarget({{0, 0, 0.01}, tilted, 1000});  // 8 mm deep: asks 8 N
    const auto out = model.tick({0, 0, 0}, 1e-3);
    CHECK((out.force - tilted * f_max).norm() < 1e-12);
    CHECK_THAT(out.depth, WithinRel(f_max / 1000, 1e-12));  // (2.27)
    CHECK_THAT(model.local().depth({0, 0, 0}), WithinRel(f_max / 1000, 1e-12));
    CHECK(out.limited);
  }
  SECTION("both: the normal turns at its rate, the depth is bounded") {
    model.retarget({{0, 0, 0.0005}, up, 1000});
    const auto before = model.tick({0, 0, 0}, 1e-3);
    CHECK_THAT(before.force(2), WithinRel(0.5, 1e-12));
    const d3::vector tilted = d3::vector(0.6, 0, 0.8);
    model.retarget({{0, 0, 0.01}, tilted, 1000});
    const auto out = model.tick({0, 0, 0}, 1e-3);
    const d3::vector n = model.local().outward();
    CHECK_THAT(std::acos(n.dot(up)), WithinAbs(4e-3, 1e-7));
    CHECK((out.force - n * f_max).norm() < 1e-12);
    CHECK_THAT(model.local().depth({0, 0, 0}), WithinRel(f_max / 1000, 1e-12));
  }
  SECTION("local model only: the environment's constraint as it is, force zero") {
    model.retarget({{0, 0, 0.0005}, up, 1000});
    (void)model.tick({0, 0, 0}, 1e-3);
    model.retarget({{0, 0, -0.01}, d3::vector(0.6, 0, 0.8), 1000});
    const auto out = model.tick({0, 0, 0}, 1e-3);
    CHECK(out.force == d3::zero());
    CHECK(model.local().outward() == model.target().outward());
  }
}

TEST_CASE("only the normal being late does not deepen the contact (A21)", "[local_model]") {
  auto model = tilting(ph::thesis_bound<d3>{}, 1.0);  // the ledger allows 11 N, 11 mm
  model.retarget({{0, 0, 0.001}, up, 1000});
  (void)model.tick({0, 0, 0}, 1e-3);
  const d3::vector tilted = d3::vector(0.6, 0, 0.8);
  model.retarget({tilted * 0.001, tilted, 1000});
  for (int n = 0; n < 50; ++n) {
    const auto out = model.tick({0, 0, 0}, 1e-3);
    CHECK_THAT(out.depth, WithinRel(0.001, 1e-9));  // min(dVE, dmax) = dVE
    CHECK_THAT(model.local().depth({0, 0, 0}), WithinRel(0.001, 1e-9));
  }
}

TEST_CASE("an undisturbed local model is the environment's constraint, bit for bit",
          "[local_model]") {
  auto model = tilting(ph::thesis_bound<d3>{}, 1.0);
  model.retarget({{0.1, 0.2, 0.001}, d3::vector(0.1, 0.2, 3), 1000});
  (void)model.tick({0, 0, 0.1}, 1e-3);
  const auto &own = model.local(), &theirs = model.target();
  CHECK(own.point.values == theirs.point.values);
  CHECK(own.normal.values == theirs.normal.values);
}

TEST_CASE("the local model arrives at the environment's constraint and stays", "[local_model]") {
  auto model = tilting(ph::thesis_bound<d3>{}, 1.0);
  model.retarget({{0, 0, 0.001}, up, 500});
  (void)model.tick({0, 0, 0}, 1e-3);
  const d3::vector tilted = d3::vector(0.6, 0, 0.8);
  model.retarget({tilted * 0.002, tilted, 500});
  int ticks = 0;
  while (model.local().normal.values != model.target().normal.values && ticks < 1000) {
    (void)model.tick({0, 0, 0}, 1e-3);
    ++ticks;
  }
  CHECK(ticks >= 160);  // 0.6435 rad at 4 mrad a tick
  CHECK(ticks <= 163);
  CHECK(model.local().point.values == model.target().point.values);
}

TEST_CASE("a stiffness that switches takes effect at once and is bounded (A10)", "[local_model]") {
  auto ledger = thesis_ledger<d1>();
  ledger.energy = 0.01;
  auto model = following_half_space<d1>(ph::spring<d1>{}, ledger, ph::strict_bound<d1>{});
  model.retarget(wall<d1>(100));
  CHECK_THAT(model.tick(0.001, 1e-3).force, WithinRel(-0.1, 1e-12));
  model.retarget(wall<d1>(200));
  CHECK_THAT(model.tick(0.001, 1e-3).force, WithinRel(-0.2, 1e-12));
  model.retarget(wall<d1>(1e9));
  CHECK_THAT(model.tick(0.001, 1e-3).force, WithinRel(-std::sqrt(4 * 30 * 0.01), 1e-9));
}

TEST_CASE("sliding sideways into a deep triangle costs what an update costs (A18)",
          "[local_model]") {
  auto ledger = thesis_ledger<d3>();
  ledger.energy = 0.01;
  ph::local_model model{d3{},           ph::following<ph::triangle<d3>>{},
                        ph::snap<d3>{}, ph::spring<d3>{},
                        ledger,         ph::thesis_bound<d3>{}};
  model.retarget({.a = {0, 0, 0}, .b = {0.02, 0, 0}, .c = {0, 0.02, 0}, .stiffness = 1e4});
  (void)model.tick({-0.0001, 0.005, -0.005}, 1e-3);
  const auto out = model.tick({0.0001, 0.005, -0.005}, 1e-3);  // 5 mm deep at once: 50 N
  CHECK_THAT(out.force(2), WithinRel(std::sqrt(4 * 30 * (0.01 + 30 * 4e-8)), 1e-9));
}

TEST_CASE("a surface that appears over the device costs what an update costs", "[local_model]") {
  auto ledger = thesis_ledger<d1>();
  ledger.energy = 0.01;
  const double f_max = std::sqrt(4 * 30 * 0.01);
  ph::local_model model{
      d1{},           ph::following<ph::half_space<d1>>{{.stale_after = 0.01, .fade = 0.01}},
      ph::snap<d1>{}, ph::spring<d1>{},
      ledger,         ph::thesis_bound<d1>{}};
  SECTION("the first one") {
    CHECK(model.tick(0.002, 1e-3).force == 0.0);
    model.retarget(wall<d1>(1e4));
    CHECK_THAT(model.tick(0.002, 1e-3).force, WithinRel(-f_max, 1e-12));
  }
  SECTION("the first one, with the first sample") {
    model.retarget(wall<d1>(1e4));
    CHECK_THAT(model.tick(0.002, 1e-3).force, WithinRel(-f_max, 1e-12));
  }
  SECTION("one that had faded") {
    model.retarget(wall<d1>(500));
    CHECK_THAT(model.tick(0.002, 1e-3).force, WithinRel(-1.0, 1e-12));
    for (int n = 0; n < 30; ++n) (void)model.tick(0.002, 1e-3);
    CHECK(model.tick(0.002, 1e-3).force == 0.0);
    model.retarget(wall<d1>(1e4));
    CHECK_THAT(model.tick(0.002, 1e-3).force, WithinRel(-f_max, 1e-12));
  }
  SECTION("the control: entered from outside it is there at once") {
    model.retarget(wall<d1>(1e4));
    (void)model.tick(-0.001, 1e-3);
    CHECK_THAT(model.tick(0.002, 1e-3).force, WithinRel(-20.0, 1e-12));
  }
}

TEST_CASE("a silent environment fades out and says so", "[local_model]") {
  ph::local_model model{d1{},
                        ph::following<ph::half_space<d1>>{{.stale_after = 0.1, .fade = 0.05}},
                        ph::snap<d1>{},
                        ph::spring<d1>{},
                        ph::reduced_energy<d1>{.damping = 0.03, .energy = 1.0},
                        ph::strict_bound<d1>{}};
  CHECK(model.tick(0.001, 1e-3).what == ph::event::no_target);
  model.retarget(wall<d1>(1000));
  double last = 0;
  for (int n = 0; n <= 160; ++n) {
    const auto out = model.tick(0.001, 1e-3);
    const double age = 1e-3 * n;
    if (age < 0.0995) {
      CHECK(out.what == ph::event::nominal);
      CHECK_THAT(out.force, WithinRel(-1.0, 1e-12));
    } else if (age > 0.1005 && age < 0.1495) {
      CHECK(out.what == ph::event::stale_target);
      CHECK(out.force > last);  // weaker every tick
    } else if (age > 0.1505) {
      CHECK(out.force == 0.0);
    }
    last = out.force;
  }
  model.retarget(wall<d1>(1000));
  CHECK(model.tick(0.001, 1e-3).what == ph::event::nominal);
  CHECK_THAT(model.tick(0.001, 1e-3).force, WithinRel(-1.0, 1e-12));
}

TEST_CASE("a silent environment ages while samples are bad, too", "[local_model]") {
  ph::local_model model{d1{},
                        ph::following{wall<d1>(1000), ph::freshness<double>{.stale_after = 0.01}},
                        ph::snap<d1>{},
                        ph::spring<d1>{},
                        ph::reduced_energy<d1>{.damping = 0.03, .energy = 1.0},
                        ph::strict_bound<d1>{}};
  CHECK_THAT(model.tick(0.001, 1e-3).force, WithinRel(-1.0, 1e-12));  // a target from the start
  for (int n = 0; n < 100; ++n) (void)model.tick(std::nan(""), 1e-3);
  const auto out = model.tick(0.001, 1e-3);
  CHECK(out.what == ph::event::stale_target);
  CHECK(out.force == 0.0);
}

TEST_CASE("a stale-data rule that cannot be is refused with its name", "[local_model]") {
  const auto refused = [](ph::freshness<double> rule) {
    const auto fault = ph::following<ph::half_space<d1>>{rule}.check();
    return std::string(fault ? fault.parameter : "");
  };
  CHECK(refused({}).empty());
  CHECK(refused({.stale_after = 0.1, .fade = 0.01}).empty());
  CHECK(refused({.stale_after = -0.1}) == "stale_after");
  CHECK(refused({.stale_after = std::nan("")}) == "stale_after");
  CHECK(refused({.stale_after = 0.1, .fade = 0.0}) == "fade");
}

TEST_CASE("a composition promises no more than its weakest part", "[local_model]") {
  const auto promise = [](const auto& observer, const auto& bound) {
    using model = decltype(following_half_space<d1>(ph::spring<d1>{}, observer, bound));
    return model::passivity;
  };
  const auto ledger = thesis_ledger<d1>();
  CHECK(promise(ledger, ph::strict_bound<d1>{}) == ph::guarantee::strict);
  CHECK(promise(ledger, ph::reachable_bound<d1>{}) == ph::guarantee::conditional);
  CHECK(promise(ledger, ph::thesis_bound<d1>{}) == ph::guarantee::none);
  CHECK(promise(ledger, ph::no_bound<d1>{}) == ph::guarantee::none);
  CHECK(promise(ph::no_observer<d1>{}, ph::no_bound<d1>{}) == ph::guarantee::none);
}

TEST_CASE("a model is a value: a snapshot replays bit for bit", "[local_model]") {
  auto model =
      tilting(ph::bound_chain{ph::force_rate_limit<d3>{.rate = 50}, ph::strict_bound<d3>{}}, 0.02);
  static_assert(std::is_trivially_copyable_v<decltype(model)>);
  model.retarget({{0, 0, 0.001}, up, 1000});
  for (int n = 0; n < 10; ++n) (void)model.tick({0, 1e-4 * n, 0}, 1e-3);
  auto copy = model;
  for (int n = 10; n < 200; ++n) {
    if (n % 30 == 0) {
      const ph::half_space<d3> next{{0, 0, 1e-5 * n}, d3::vector(0.01 * n, 0, 1), 900};
      model.retarget(next);
      copy.retarget(next);
    }
    const d3::vector x(0, 1e-4 * n, 1e-6 * n);
    const auto a = model.tick(x, 1e-3), b = copy.tick(x, 1e-3);
    if (!(a.force == b.force) || a.energy != b.energy) FAIL("tick " << n);
  }
  CHECK(model.energy() == copy.energy());
}

TEST_CASE("parts without state cost no bytes", "[local_model][compile-time]") {
  using bare =
      decltype(ph::local_model{d1{}, ph::rigid{wall<d1>(1)}, ph::snap<d1>{}, ph::spring<d1>{},
                               ph::no_observer<d1>{}, ph::no_bound<d1>{}});
  using strict =
      decltype(ph::local_model{d1{}, ph::rigid{wall<d1>(1)}, ph::snap<d1>{}, ph::spring<d1>{},
                               ph::no_observer<d1>{}, ph::actuator_limit<d1>{}});
  static_assert(sizeof(strict) == sizeof(bare) + sizeof(double));
  // plane 3, spring 1, limits 2, force, position, blind time, and the flags
  static_assert(sizeof(bare) == sizeof(double) * (3 + 1 + 2 + 1 + 1 + 1) + sizeof(double));
  SUCCEED();
}
