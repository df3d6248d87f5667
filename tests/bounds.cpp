// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

const ph::isotropic_damping<d1> b1{0.03};

/// A quiet situation: nothing moves, nothing is held, the wall pushes along −1.
ph::tick_state<d1> quiet(double energy) {
  return {.damping = b1,
          .energy = energy,
          .in_flight = 0,
          .dt = 1e-3,
          .longest_tick = 1e-3,
          .held = 0,
          .displacement = 0,
          .motion_known = true,
          .normal = -1,
          .stiffness = 1e4,
          .depth = 0,
          .target_depth = 1e-3,
          .local_force = 0,
          .target_changed = false};
}

}  // namespace

TEST_CASE("strict_bound is √(4 B E1) in one dimension (2.17)", "[bound]") {
  ph::strict_bound<d1> bound;
  CHECK_THAT(bound.limit(-50.0, quiet(0.01)), WithinRel(-std::sqrt(1.2), 1e-14));
  CHECK(bound.limit(-1.0, quiet(0.01)) == -1.0);
  CHECK(bound.limit(-1.0, quiet(0.0)) == 0.0);
  CHECK(bound.limit(-1.0, quiet(-1.0)) == 0.0);
}

TEST_CASE("strict_bound keeps the direction and uses the damping along it (2.15, A4, A7)",
          "[bound]") {
  const ph::diagonal_damping<d3> damping{{0.03, 0.03, 0.008}};
  ph::tick_state<d3, ph::diagonal_damping<d3>> state{.damping = damping,
                                                     .energy = 0.01,
                                                     .in_flight = 0,
                                                     .dt = 1e-3,
                                                     .longest_tick = 1e-3,
                                                     .held = d3::zero(),
                                                     .displacement = d3::zero(),
                                                     .motion_known = true,
                                                     .normal = {0, 0, 1},
                                                     .stiffness = 1,
                                                     .depth = 0,
                                                     .target_depth = 0,
                                                     .local_force = 0,
                                                     .target_changed = false};
  ph::strict_bound<d3> bound;
  const d3::vector desired(3, 0, 4);
  const d3::vector f = bound.limit(desired, state);
  CHECK((f.normalized() - desired.normalized()).norm() < 1e-15);
  const d3::vector u = desired.normalized();
  const double compliance = u(0) * u(0) / 30 + u(1) * u(1) / 30 + u(2) * u(2) / 8;
  CHECK_THAT(f.norm(), WithinRel(std::sqrt(4 * 0.01 / compliance), 1e-14));  // 2.17
}

TEST_CASE("thesis_bound binds when leaving and on updates, and keeps what there is going in",
          "[bound]") {
  ph::thesis_bound<d1> bound;
  auto state = quiet(0.01);
  const double f_max = std::sqrt(1.2);
  SECTION("leaving") {
    state.displacement = -1e-5;
    state.local_force = 5.0;
    CHECK_THAT(bound.limit(-8.0, state), WithinRel(-f_max, 1e-13));
  }
  SECTION("going in, an update asks for more than there is") {
    state.displacement = 1e-5;
    state.local_force = 5.0;
    CHECK(bound.limit(-8.0, state) == -5.0);
  }
  SECTION("going in, less there than the ledger allows") {
    state.displacement = 1e-5;
    state.local_force = 0.1;
    CHECK_THAT(bound.limit(-8.0, state), WithinRel(-f_max, 1e-13));
  }
  SECTION("going in, the surface retreats") {
    state.displacement = 1e-5;
    state.local_force = 5.0;
    CHECK(bound.limit(-2.0, state) == -2.0);
  }
  SECTION("in debt, leaving") {
    state.energy = -1.0;
    state.displacement = -1e-5;
    state.local_force = 5.0;
    CHECK(bound.limit(-8.0, state) == 0.0);
  }
}

TEST_CASE("reachable_bound lets a device press that cannot turn round, and no other", "[bound]") {
  ph::reachable_bound<d1> bound{.mass = 0.1, .hand_force = 5.0};
  auto state = quiet(1e-6);
  SECTION("fast inwards: no bound") {
    state.displacement = 0.5e-3;  // 0.5 m/s
    CHECK(bound.limit(-40.0, state) == -40.0);
  }
  SECTION("at rest: the work over the reach") {
    const double reach = ph::kernels::outward_reach(0.0, 0.0, 4.0, 5.0, 0.1, 1e-3, 1e-3);
    const double most = ph::kernels::reachable_force_bound(1e-6, 30.0, reach);
    REQUIRE(most < 4.0);
    CHECK_THAT(bound.limit(-4.0, state), WithinRel(-most, 1e-12));
  }
  SECTION("fast outwards: the strict bound") {
    state.displacement = -2e-3;
    CHECK_THAT(bound.limit(-4.0, state), WithinRel(-std::sqrt(4 * 30 * 1e-6), 1e-12));
  }
  SECTION("after a lost sample it may be moving out at any speed: the strict bound") {
    state.motion_known = false;
    CHECK_THAT(bound.limit(-4.0, state), WithinRel(-std::sqrt(4 * 30 * 1e-6), 1e-12));
  }
  SECTION("never below the strict bound") {
    ph::strict_bound<d1> strict;
    for (int i = -20; i <= 20; ++i) {
      state.displacement = 1e-4 * i;
      CHECK(bound.limit(-4.0, state) <= strict.limit(-4.0, state));
    }
  }
  SECTION("nothing desired in debt is nothing") {
    state.energy = -1.0;
    CHECK(bound.limit(0.0, state) == 0.0);
    CHECK(bound.limit(-4.0, state) == 0.0);
  }
}

TEST_CASE("actuator_limit keeps the direction", "[bound]") {
  ph::actuator_limit<d3> limit{.most = 5.0};
  const int state = 0;
  CHECK((limit.limit(d3::vector(6, 0, 8), state) - d3::vector(3, 0, 4)).norm() < 1e-15);
  CHECK(limit.limit(d3::vector(3, 0, 4), state) == d3::vector(3, 0, 4));
}

TEST_CASE("force_rate_limit passes the hand's motion and slows the surface's", "[bound]") {
  ph::force_rate_limit<d1> limit{.rate = 100.0};  // 0.1 N a tick
  auto state = quiet(1.0);
  state.local_force = 2.0;  // the hand took it there: at once
  CHECK_THAT(limit.limit(-3.0, state), WithinAbs(-2.1, 1e-15));
  CHECK_THAT(limit.limit(-2.05, state), WithinAbs(-2.05, 1e-15));
  CHECK_THAT(limit.limit(0.0, state), WithinAbs(-1.9, 1e-15));
  state.local_force = 0.05;
  CHECK(limit.limit(0.0, state) == 0.0);
}

TEST_CASE("strict_bound with latency counts what is in flight (§ 3)", "[bound]") {
  ph::strict_bound<d1, 2> bound;
  static_assert(ph::strict_bound<d1, 2>::traits.latency == 2);
  auto state = quiet(0.01);
  state.in_flight = 0.006;
  CHECK_THAT(bound.limit(-50.0, state), WithinRel(-std::sqrt(4 * 30 * 0.004), 1e-14));
  state.in_flight = 0.02;
  CHECK(bound.limit(-50.0, state) == 0.0);
}

TEST_CASE("bound_chain applies its bounds in order and promises what survives", "[bound]") {
  using rate = ph::force_rate_limit<d1>;
  using strict = ph::strict_bound<d1>;
  using motors = ph::actuator_limit<d1>;
  using thesis = ph::thesis_bound<d1>;
  static_assert(ph::bound_chain<strict, motors>::passivity == ph::guarantee::strict);
  static_assert(ph::bound_chain<motors, strict>::passivity == ph::guarantee::strict);
  static_assert(ph::bound_chain<rate, strict>::passivity == ph::guarantee::strict);
  static_assert(ph::bound_chain<strict, rate>::passivity == ph::guarantee::none);
  static_assert(ph::bound_chain<thesis, strict>::passivity == ph::guarantee::strict);
  static_assert(ph::bound_chain<thesis, motors>::passivity == ph::guarantee::none);
  static_assert(ph::bound_chain<motors, ph::strict_bound<d1, 3>>::traits.latency == 3);
  static_assert(ph::bound_chain<rate, motors>::traits.needs_local_model);
  static_assert(!ph::bound_chain<motors, motors>::traits.needs_ledger);
  static_assert(sizeof(ph::bound_chain<strict, strict>) <= 2);

  ph::bound_chain chain{rate{.rate = 100.0}, strict{}, motors{.most = 0.5}};
  auto state = quiet(0.01);
  state.local_force = 2.0;
  CHECK(chain.limit(-3.0, state) == -0.5);
  state.energy = 1e-6;
  CHECK_THAT(chain.limit(-3.0, state), WithinRel(-std::sqrt(4 * 30 * 1e-6), 1e-14));
  CHECK(std::string(ph::bound_chain{rate{.rate = 1}, motors{.most = -1}}.check().parameter) ==
        "most");
}

TEST_CASE("parameters of bounds are refused with their name", "[bound]") {
  const double nan = std::nan("");
  CHECK_FALSE(ph::reachable_bound<d1>{.mass = 0.1, .hand_force = 0}.check());
  CHECK(std::string(ph::reachable_bound<d1>{.hand_force = 5}.check().parameter) == "mass");
  CHECK(std::string(ph::reachable_bound<d1>{.mass = 1, .hand_force = -1}.check().parameter) ==
        "hand_force");
  CHECK(std::string(ph::reachable_bound<d1>{.mass = 1, .hand_force = nan}.check().parameter) ==
        "hand_force");
  CHECK(std::string(ph::actuator_limit<d1>{.most = nan}.check().parameter) == "most");
  CHECK(std::string(ph::force_rate_limit<d1>{.rate = 0}.check().parameter) == "rate");
}
