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

/// A bound that answers any wish with one force.
struct always {
  static constexpr ph::guarantee passivity = ph::guarantee::none;
  static constexpr ph::bound_traits traits{};
  double force{};
  [[nodiscard]] constexpr ph::parameter_fault check() const noexcept { return {}; }
  template <class Port>
  struct on {
    double force;
    constexpr explicit on(const always& p) noexcept : force(p.force) {}
    [[nodiscard]] double limit(double /*desired*/, const auto& /*state*/) const noexcept {
      return force;
    }
  };
};
/// A shaper that gives so much more, and half of it where the surface is news.
struct adds {
  static constexpr bool needs_local_model = false;
  static constexpr bool needs_ledger = false;
  double more{};
  template <class S>
  struct on {
    double more;
    constexpr explicit on(const adds& p) noexcept : more(p.more) {}
    [[nodiscard]] constexpr double shape(double desired, const auto& contact,
                                         const auto& /*port*/) const noexcept {
      return desired + (contact.target_changed ? 0.5 * more : more);
    }
  };
};

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

TEST_CASE("a contact asks for no number beyond the half of all, nor for one that is none",
          "[local_model][fault]") {
  const double most = ph::kernels::largest<double>();
  const auto asks = [](double point, double K, double x) {
    ph::local_model model{d1{},
                          ph::followed<ph::half_space<d1>>{},
                          ph::turn_at_once{},
                          ph::spring{},
                          ph::no_observer{},
                          ph::no_bound{},
                          thesis_loop};
    REQUIRE(model.update({point, 1.0, K}));
    return model.tick(x, 1ms);
  };
  CHECK(asks(0.0, 0.49 * most, -1.0).force == 0.49 * most);
  for (const auto& beyond : {asks(0.0, 0.51 * most, -1.0), asks(0.97 * most, 0.1, 0.0)}) {
    CHECK(beyond.force == 0.0);
    CHECK(beyond.depth == 0.0);
    CHECK(beyond.what == ph::event::rejected_target);
  }
  const auto shaped = [](double more, bool moves) {
    const auto tick = [&](auto supply) {
      ph::local_model model{d1{},
                            supply,
                            ph::turn_at_once{},
                            ph::shaped{ph::spring{}, adds{more}},
                            ph::no_observer{},
                            ph::no_bound{},
                            thesis_loop};
      return model.tick(-1e-3, 1ms);
    };
    const ph::half_space<d1> wall{0.0, 1.0, 1000.0};
    return moves ? tick(ph::followed{wall}) : tick(ph::fixed{wall});
  };
  CHECK_THAT(shaped(1.0, true).force, WithinRel(1.5, 1e-12));
  CHECK_THAT(shaped(1.0, false).force, WithinRel(2.0, 1e-12));  // what never moves is never news
  for (const bool moves : {true, false}) {
    const auto none = shaped(std::nan(""), moves);
    CHECK(none.force == 0.0);
    CHECK(none.what == ph::event::rejected_target);
  }
}

TEST_CASE("a local model is nowhere where a bound gives a force of no depth",
          "[local_model][fault]") {
  const auto felt = [](double K, double force) {
    auto model = following_half_space<d1>(ph::spring{}, thesis_ledger(), always{force});
    REQUIRE(model.update({0.0, 1.0, K}));
    (void)model.tick(1e-3, 1ms);
    const auto out = model.tick(-1e-3, 1ms);
    CHECK(out.force == force);
    return out.depth;
  };
  CHECK(felt(1000.0, 0.5) == 0.5 / 1000.0);
  CHECK(felt(1e-305, 1e10) == 0.0);  // a depth that is no number
}

TEST_CASE("a fixed surface neither lags nor fades, and news that just touch are none to explain",
          "[local_model]") {
  ph::local_model still{d1{},
                        ph::fixed{ph::half_space<d1>{0.0, 1.0, 1000.0}},
                        ph::turn_at_once{},
                        ph::damped_spring{.mass = 0.1, .force_limit = 1.0},
                        ph::no_observer{},
                        ph::no_bound{},
                        thesis_loop};
  (void)still.tick(-5e-3, 1ms);
  CHECK(still.explain().now == ph::softened_by::nothing);  // 1 N of 5

  ph::local_model moves{d1{},
                        ph::followed<ph::half_space<d1>>{},
                        ph::turn_at_once{},
                        ph::eased{ph::spring{}},
                        ph::no_observer{},
                        ph::no_bound{},
                        thesis_loop};
  const auto now = [&](double height) {
    moves.reset();
    REQUIRE(moves.update({0.0, 1.0, 1000.0}));
    for (int n = 2; n > -3; --n) (void)moves.tick(1e-3 * n, 1ms);
    REQUIRE(moves.update({height, 1.0, 1000.0}));
    CHECK(moves.tick(-2e-3, 1ms).force > 1.9);
    return moves.explain().now;
  };
  CHECK(now(1e-3) == ph::softened_by::news);
  CHECK(now(-2e-3) == ph::softened_by::nothing);
}

TEST_CASE("a port has its capped law follow the ledger", "[local_model]") {
  auto wall = following_half_space<d1>(ph::capped{ph::spring{}, 1000.0, 1e-3}, thesis_ledger(),
                                       ph::no_bound{});
  REQUIRE(wall.update({0.0, 1.0, 1000.0}));
  double force = 0.0;
  for (int n = 0; n < 1001; ++n) force = wall.tick(n == 0 ? 1e-3 : -2e-3, 1ms).force;
  CHECK_THAT(force, WithinRel(0.7 * 2.0, 0.01));  // s falls by 0.3 a second
}
