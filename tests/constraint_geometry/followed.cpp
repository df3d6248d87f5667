// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// Pressed 1 mm into 1 kN/m, with energy enough for anything.
auto pressed(const ph::freshness& rule) {
  ph::local_model model{d1{},
                        ph::followed{wall<d1>(1000), rule},
                        ph::turn_at_once{},
                        ph::spring{},
                        ph::reduced_energy{.damping = 0.03, .loan = 1.0},
                        ph::strict_bound{},
                        thesis_loop};
  (void)model.tick(0.001, 1ms);
  (void)model.tick(0.001, 1ms);
  return model;
}

}  // namespace

TEST_CASE("a silent environment fades out and says so", "[local_model]") {
  ph::local_model model{d1{},
                        ph::followed<ph::half_space<d1>>{{.stale_after = 0.1, .fade = 0.05}},
                        ph::turn_at_once{},
                        ph::spring{},
                        ph::reduced_energy{.damping = 0.03, .loan = 1.0},
                        ph::strict_bound{},
                        thesis_loop};
  CHECK(model.tick(0.001, 1ms).what == ph::event::no_target);
  model.update(wall<d1>(1000));
  double last = 0;
  for (int n = 0; n <= 160; ++n) {
    const auto out = model.tick(0.001, 1ms);
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
  model.update(wall<d1>(1000));
  CHECK(model.tick(0.001, 1ms).what == ph::event::nominal);
  CHECK_THAT(model.tick(0.001, 1ms).force, WithinRel(-1.0, 1e-12));
}

TEST_CASE("a silent environment ages while samples are bad, too", "[local_model]") {
  ph::local_model model{d1{},
                        ph::followed{wall<d1>(1000), ph::freshness{.stale_after = 0.01}},
                        ph::turn_at_once{},
                        ph::spring{},
                        ph::reduced_energy{.damping = 0.03, .loan = 1.0},
                        ph::strict_bound{},
                        thesis_loop};
  CHECK_THAT(model.tick(0.001, 1ms).force, WithinRel(-1.0, 1e-12));  // a target from the start
  for (int n = 0; n < 100; ++n) (void)model.tick(std::nan(""), 1ms);
  const auto out = model.tick(0.001, 1ms);
  CHECK(out.what == ph::event::stale_target);
  CHECK(out.force == 0.0);
}

TEST_CASE("a stale-data rule that cannot be is refused with its name", "[local_model]") {
  const auto refused = [](ph::freshness rule) {
    const auto fault = ph::followed<ph::half_space<d1>>{rule}.check();
    return std::string(fault ? fault.parameter : "");
  };
  CHECK(refused({}).empty());
  CHECK(refused({.stale_after = 0.1, .fade = 0.01}).empty());
  CHECK(refused({.stale_after = -0.1}) == "stale_after");
  CHECK(refused({.stale_after = std::nan("")}) == "stale_after");
  CHECK(refused({.stale_after = 0.1, .fade = 0.0}) == "fade");
}

TEST_CASE("what is released fades as stale data does, and no event is made of it",
          "[local_model][release]") {
  auto model = pressed({.stale_after = 0.1, .fade = 0.05});
  model.release();
  double last = -1.0;
  for (int n = 1; n <= 60; ++n) {
    const auto out = model.tick(0.001, 1ms);
    CHECK(out.what == ph::event::nominal);
    CHECK(out.energy == 1.0);  // the ledger is kept
    CHECK_THAT(out.force, WithinAbs(-std::max(0.0, 1.0 - 1e-3 * n / 0.05), 1e-12));
    CHECK(std::abs(out.force - last) <= 0.02 + 1e-12);  // a fiftieth: no step
    last = out.force;
  }
  CHECK(last == 0.0);
  CHECK(model.tick(0.005, 1ms).force == 0.0);  // it has ended, however deep
  CHECK(model.energy() > 0.9);
}

TEST_CASE("the next update brings back what was released", "[local_model][release]") {
  for (const int ticks : {0, 10, 200}) {  // at once, half way, long after
    auto model = pressed({.stale_after = 0.1, .fade = 0.05});
    model.release();
    for (int n = 0; n < ticks; ++n) (void)model.tick(0.001, 1ms);
    REQUIRE(model.update(wall<d1>(1000)));
    const auto out = model.tick(0.001, 1ms);
    CHECK(out.what == ph::event::nominal);
    CHECK_THAT(out.force, WithinRel(-1.0, 1e-12));
    CHECK(out.energy == 1.0);
  }
}

TEST_CASE("a release while the contact is fading goes on from where it is",
          "[local_model][release]") {
  auto model = pressed({.stale_after = 0.1, .fade = 0.05});
  auto out = model.tick(0.001, 1ms);
  for (int n = 0; n < 1000 && out.force < -0.6; ++n) out = model.tick(0.001, 1ms);
  REQUIRE(out.what == ph::event::stale_target);
  REQUIRE(out.force < -0.5);
  model.release();
  double last = out.force;
  for (int n = 0; n < 10; ++n) {
    out = model.tick(0.001, 1ms);
    CHECK(out.what == ph::event::nominal);  // its end is known
    CHECK_THAT(out.force - last, WithinAbs(0.02, 1e-12));
    last = out.force;
    model.release();  // again: nothing new
  }
}

TEST_CASE("a release before the first target, or with it, is nothing to worry about",
          "[local_model][release]") {
  ph::local_model model{d1{},
                        ph::followed<ph::half_space<d1>>{},
                        ph::turn_at_once{},
                        ph::spring{},
                        ph::reduced_energy{.damping = 0.03, .loan = 1.0},
                        ph::strict_bound{},
                        thesis_loop};
  model.release();
  CHECK(model.tick(0.001, 1ms).what == ph::event::no_target);
  REQUIRE(model.update(wall<d1>(1000)));
  model.release();
  (void)model.tick(0.001, 1ms);
  for (int n = 0; n < 60; ++n) (void)model.tick(0.001, 1ms);
  CHECK(model.tick(0.001, 1ms).force == 0.0);
  CHECK(model.tick(0.001, 1ms).what == ph::event::nominal);
}

TEST_CASE("a released surface ends behind a bound that has nothing left, too",
          "[local_model][release]") {
  auto model = following_half_space<d1>(ph::spring{}, thesis_ledger(), ph::strict_bound{});
  model.update(wall<d1>(1e4));
  for (int n = 0; n < 50; ++n) (void)model.tick(2e-5 * n, 1ms);
  model.release();
  double last = model.tick(1e-3, 1ms).force;
  REQUIRE(last < 0.0);
  for (int n = 0; n < 60; ++n) {
    const double force = model.tick(1e-3, 1ms).force;
    CHECK(force >= last - 1e-12);
    last = force;
  }
  CHECK(last == 0.0);
  CHECK(model.energy() >= 0.0);
}

TEST_CASE("followed keeps two copies: the newest target, and its own", "[supply]") {
  ph::followed<ph::half_space<d1>> supply;
  CHECK_FALSE(supply.published());
  CHECK(supply.weight() == 0.0);
  REQUIRE(supply.update({0.0, -2.0, 100.0}));
  CHECK(supply.published());
  CHECK(supply.changed());
  CHECK(supply.together());
  CHECK(supply.local().normal == -1.0);  // prepared
  supply.seen(supply.weight());
  CHECK_FALSE(supply.changed());
  REQUIRE(supply.update({0.01, -1.0, 200.0}));
  CHECK_FALSE(supply.together());
  CHECK(supply.local().point == 0.0);
  CHECK(supply.target().point == 0.01);
  supply.approach(true, 0.004, -1.0, 0.001);
  CHECK_THAT(supply.local().at(0.004).depth, WithinAbs(0.001, 1e-15));
  supply.sync();
  CHECK(supply.together());
  CHECK(supply.local().point == 0.01);
  CHECK_FALSE(supply.update({0.02, -1.0, -5.0}));
  CHECK(supply.refused());
  CHECK(supply.target().point == 0.01);
  supply.reset();
  CHECK_FALSE(supply.published());
}

TEST_CASE("followed says what came, how much it counts and where it has got", "[supply]") {
  ph::followed<ph::segment<d2>> supply;
  supply.vanish();
  CHECK_FALSE(supply.changed());  // there is nothing to be new
  CHECK_FALSE(supply.current());
  ph::segment<d2> own{.a = {0.02, 0}, .b = {0, 0}, .stiffness = 100};
  ph::segment<d2> next{.a = {0.021, 0.004}, .b = {0.001, 0.004}, .stiffness = 200};
  REQUIRE(supply.update(own));
  CHECK(supply.current());
  REQUIRE(own.prepare());
  REQUIRE(next.prepare());
  const d2::vector x(0.01, -0.001), n(0, 1);
  for (const bool from_own : {true, false}) {
    supply.reset();
    REQUIRE(supply.update(own));
    REQUIRE(supply.update(next));
    supply.approach(from_own, x, n, 0.003);
    const auto expected = (from_own ? own : next).toward(next, x, n, 0.003);
    CHECK(d2::vector(supply.local().a) == d2::vector(expected.a));
    CHECK(d2::vector(supply.local().b) == d2::vector(expected.b));
  }
  supply.sync();
  supply.approach(true, x, n, 0.003);
  CHECK_FALSE(supply.together());
  supply.seen(0.5);
  CHECK(supply.last_weight() == 0.5);
  CHECK_FALSE(supply.changed());
  supply.vanish();
  CHECK(supply.changed());
  CHECK(supply.last_weight() == 0.0);
  CHECK_FALSE(supply.refused());
  supply.refuse();
  CHECK(supply.refused());
  supply.set({.stale_after = 0.1, .fade = 0.05});
  supply.grow_older(0.11);
  CHECK(supply.stale());
}
