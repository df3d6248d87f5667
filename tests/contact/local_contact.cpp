// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// The local model of the thesis in 3 dimensions, over a half-space that the environment moves.
auto tilting(double loan) {
  return ph::local_model{d3{},
                         ph::followed<ph::half_space<d3>>{},
                         ph::turn_limited{.rate = 4.0},
                         ph::shaped{ph::spring{}, ph::thesis_rule{}},
                         ph::reduced_energy{.damping = 0.03, .loan = loan},
                         ph::no_bound{},
                         thesis_loop};
}

const d3::vector up(0, 0, 1);

}  // namespace

TEST_CASE("the four contact combinations of Fig. 2.7 (A23)", "[local_model]") {
  auto model = tilting(0.01);
  const double f_max = std::sqrt(4 * 30 * 0.01);
  SECTION("neither: the environment's constraint as it is, force zero") {
    model.update({{0, 0, -0.01}, up, 1000});
    const auto out = model.tick({0, 0, 0}, 1ms);
    CHECK(out.force == d3::zero());
    CHECK(out.depth == 0);
    CHECK(model.local().at({0, 0, 0}).depth == model.target().at({0, 0, 0}).depth);
  }
  SECTION("environment only: shifted to what the ledger allows, its normal at once (2.33)") {
    model.update({{0, 0, -0.01}, up, 1000});
    (void)model.tick({0, 0, 0}, 1ms);
    const d3::vector tilted = d3::vector(0.6, 0, 0.8);
    model.update({{0, 0, 0.01}, tilted, 1000});  // 8 mm deep: asks 8 N
    const auto out = model.tick({0, 0, 0}, 1ms);
    CHECK((out.force - tilted * f_max).norm() < 1e-12);
    CHECK_THAT(out.depth, WithinRel(f_max / 1000, 1e-12));  // (2.27)
    CHECK_THAT(model.local().at({0, 0, 0}).depth, WithinRel(f_max / 1000, 1e-12));
    CHECK(out.limited);
  }
  SECTION("both: the normal turns at its rate, the depth is bounded") {
    model.update({{0, 0, 0.0005}, up, 1000});
    const auto before = model.tick({0, 0, 0}, 1ms);
    CHECK_THAT(before.force(2), WithinRel(0.5, 1e-12));
    const d3::vector tilted = d3::vector(0.6, 0, 0.8);
    model.update({{0, 0, 0.01}, tilted, 1000});
    const auto out = model.tick({0, 0, 0}, 1ms);
    const d3::vector n = d3::vector(model.local().normal);
    CHECK_THAT(std::acos(n.dot(up)), WithinAbs(4e-3, 1e-7));
    CHECK((out.force - n * f_max).norm() < 1e-12);
    CHECK_THAT(model.local().at({0, 0, 0}).depth, WithinRel(f_max / 1000, 1e-12));
  }
  SECTION("local model only: the environment's constraint as it is, force zero") {
    model.update({{0, 0, 0.0005}, up, 1000});
    (void)model.tick({0, 0, 0}, 1ms);
    model.update({{0, 0, -0.01}, d3::vector(0.6, 0, 0.8), 1000});
    const auto out = model.tick({0, 0, 0}, 1ms);
    CHECK(out.force == d3::zero());
    CHECK(d3::vector(model.local().normal) == d3::vector(model.target().normal));
  }
}

TEST_CASE("only the normal being late does not deepen the contact (A21)", "[local_model]") {
  auto model = tilting(1.0);  // the ledger allows 11 N, 11 mm
  model.update({{0, 0, 0.001}, up, 1000});
  (void)model.tick({0, 0, 0}, 1ms);
  const d3::vector tilted = d3::vector(0.6, 0, 0.8);
  model.update({tilted * 0.001, tilted, 1000});
  for (int n = 0; n < 50; ++n) {
    const auto out = model.tick({0, 0, 0}, 1ms);
    CHECK_THAT(out.depth, WithinRel(0.001, 1e-9));  // min(dVE, dmax) = dVE
    CHECK_THAT(model.local().at({0, 0, 0}).depth, WithinRel(0.001, 1e-9));
  }
}

TEST_CASE("an undisturbed local model is the environment's constraint, bit for bit",
          "[local_model]") {
  auto model = tilting(1.0);
  model.update({{0.1, 0.2, 0.001}, d3::vector(0.1, 0.2, 3), 1000});
  (void)model.tick({0, 0, 0.1}, 1ms);
  const auto &own = model.local(), &theirs = model.target();
  CHECK(own.point.values == theirs.point.values);
  CHECK(own.normal.values == theirs.normal.values);
}

TEST_CASE("the local model arrives at the environment's constraint and stays", "[local_model]") {
  auto model = tilting(1.0);
  model.update({{0, 0, 0.001}, up, 500});
  (void)model.tick({0, 0, 0}, 1ms);
  const d3::vector tilted = d3::vector(0.6, 0, 0.8);
  model.update({tilted * 0.002, tilted, 500});
  int ticks = 0;
  while (model.local().normal.values != model.target().normal.values && ticks < 1000) {
    (void)model.tick({0, 0, 0}, 1ms);
    ++ticks;
  }
  CHECK(ticks >= 160);  // 0.6435 rad at 4 mrad a tick
  CHECK(ticks <= 163);
  CHECK(model.local().point.values == model.target().point.values);
}

TEST_CASE("a stiffness that switches takes effect at once and is bounded (A10)", "[local_model]") {
  const ph::reduced_energy ledger{.damping = 0.03, .loan = 0.01};
  auto model = following_half_space<d1>(ph::spring{}, ledger, ph::strict_bound{});
  model.update(wall<d1>(100));
  CHECK_THAT(model.tick(0.001, 1ms).force, WithinRel(-0.1, 1e-12));
  model.update(wall<d1>(200));
  CHECK_THAT(model.tick(0.001, 1ms).force, WithinRel(-0.2, 1e-12));
  model.update(wall<d1>(1e9));
  CHECK_THAT(model.tick(0.001, 1ms).force, WithinRel(-std::sqrt(4 * 30 * 0.01), 1e-9));
}

TEST_CASE("a force beyond all numbers is not asked for, and the next tick works as before",
          "[local_model][fault]") {
  const auto check = [](const auto& bound) {
    auto model = following_half_space<d1>(ph::spring{}, ph::reduced_energy{0.03, 1.0}, bound);
    model.update(wall<d1>(ph::kernels::largest<double>()));
    const auto beyond = model.tick(3.0, 1ms);
    CHECK(beyond.force == 0.0);
    CHECK(beyond.depth == 0.0);
    CHECK(beyond.what == ph::event::rejected_target);
    model.update(wall<d1>(0.1));
    CHECK_THAT(model.tick(3.0, 1ms).force, WithinRel(-0.3, 1e-12));
  };
  check(ph::strict_bound{});
  check(ph::no_bound{});
}

TEST_CASE("sliding sideways into a deep triangle costs what an update costs (A18)",
          "[local_model]") {
  ph::local_model model{d3{},
                        ph::followed<ph::triangle<d3>>{},
                        ph::turn_at_once{},
                        ph::shaped{ph::spring{}, ph::thesis_rule{}},
                        ph::reduced_energy{.damping = 0.03, .loan = 0.01},
                        ph::no_bound{},
                        thesis_loop};
  model.update({.a = {0, 0, 0}, .b = {0.02, 0, 0}, .c = {0, 0.02, 0}, .stiffness = 1e4});
  (void)model.tick({-0.0001, 0.005, -0.005}, 1ms);
  const auto out = model.tick({0.0001, 0.005, -0.005}, 1ms);  // 5 mm deep at once: 50 N
  CHECK_THAT(out.force(2), WithinRel(std::sqrt(4 * 30 * (0.01 + 30 * 4e-8)), 1e-9));
}

TEST_CASE("a sample that nobody can believe shows no depth", "[local_model]") {
  auto model = following_half_space<d1>(ph::spring{}, thesis_ledger(), ph::no_bound{});
  model.update(wall<d1>(500));
  CHECK(model.tick(1e-3, 1ms).depth == 1e-3);  // the control
  const auto out = model.tick(std::nan(""), 1ms);
  CHECK(out.what == ph::event::rejected_sample);
  CHECK(out.depth == 0.0);
  CHECK(out.force == 0.0);
  CHECK_FALSE(out.limited);
}

TEST_CASE("an environment that falls silent is noticed outside of contact, too", "[local_model]") {
  ph::local_model model{d1{},
                        ph::followed<ph::half_space<d1>>{{.stale_after = 0.01, .fade = 0.01}},
                        ph::turn_at_once{},
                        ph::spring{},
                        thesis_ledger(),
                        ph::strict_bound{},
                        thesis_loop};
  model.update(wall<d1>(500));
  for (int n = 0; n < 8; ++n) CHECK(model.tick(-0.01, 1ms).what == ph::event::nominal);
  for (int n = 0; n < 8; ++n) (void)model.tick(-0.01, 1ms);
  CHECK(model.tick(-0.01, 1ms).what == ph::event::stale_target);
}

TEST_CASE("a surface that appears over the device costs what an update costs", "[local_model]") {
  const double f_max = std::sqrt(4 * 30 * 0.01);
  ph::local_model model{d1{},
                        ph::followed<ph::half_space<d1>>{{.stale_after = 0.01, .fade = 0.01}},
                        ph::turn_at_once{},
                        ph::shaped{ph::spring{}, ph::thesis_rule{}},
                        ph::reduced_energy{.damping = 0.03, .loan = 0.01},
                        ph::no_bound{},
                        thesis_loop};
  SECTION("the first one") {
    CHECK(model.tick(0.002, 1ms).force == 0.0);
    model.update(wall<d1>(1e4));
    CHECK_THAT(model.tick(0.002, 1ms).force, WithinRel(-f_max, 1e-12));
  }
  SECTION("the first one, with the first sample") {
    model.update(wall<d1>(1e4));
    CHECK_THAT(model.tick(0.002, 1ms).force, WithinRel(-f_max, 1e-12));
  }
  SECTION("one that had faded") {
    model.update(wall<d1>(500));
    CHECK_THAT(model.tick(0.002, 1ms).force, WithinRel(-1.0, 1e-12));
    for (int n = 0; n < 30; ++n) (void)model.tick(0.002, 1ms);
    CHECK(model.tick(0.002, 1ms).force == 0.0);
    model.update(wall<d1>(1e4));
    CHECK_THAT(model.tick(0.002, 1ms).force, WithinRel(-f_max, 1e-12));
  }
  SECTION("the control: entered from outside it is there at once") {
    model.update(wall<d1>(1e4));
    (void)model.tick(-0.001, 1ms);
    CHECK_THAT(model.tick(0.002, 1ms).force, WithinRel(-20.0, 1e-12));
  }
}

TEST_CASE("what has faded away has no depth", "[local_model]") {
  ph::local_model wall{d1{},
                       ph::followed<ph::half_space<d1>>{{.stale_after = 0.01, .fade = 0.01}},
                       ph::turn_at_once{},
                       ph::spring{},
                       ph::no_observer{},
                       ph::no_bound{},
                       thesis_loop};
  REQUIRE(wall.update({0.0, 1.0, 1000.0}));
  for (int n = 0; n < 50; ++n) {
    const auto out = wall.tick(-1e-3, 1ms);
    CHECK((out.depth > 0.0) == (out.force > 0.0));
  }
  CHECK(wall.tick(-1e-3, 1ms).depth == 0.0);
}
