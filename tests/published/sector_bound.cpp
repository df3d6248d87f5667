// SPDX-License-Identifier: BSD-3-Clause
// sector_bound: its slopes, what winds no force up, and a quick attack.
#include "force_bound/attacks.hpp"
#include "force_bound/upkeep.hpp"
#include "published/stores.hpp"

using Catch::Matchers::WithinRel;

namespace {

static_assert([] {
  auto bound = at<d1>(ph::sector_bound{});
  return allowed(bound, -9.0, situation<d1>{.held = -2.0}) == -2.0;
}());
static_assert(stores_what_came<d1>(afresh<ph::sector_bound>{}, spring_energy<d1, 2>, 480));
static_assert(stores_what_came<d1>(afresh<ph::sector_bound>{{.slope = 30}}, spring_energy<d1>,
                                   480));
static_assert(!stores_what_came<d1>(afresh<ph::sector_bound>{}, spring_energy<d1>, 480));

}  // namespace

TEST_CASE("sector_bound rises by at most β and falls by β to 2b/T, and only with the hand",
          "[bound]") {
  static_assert(!ph::detail::reduces<ph::sector_bound, d1, situation<d1>::state_type>());
  const auto next = [](double desired, double held, double dx) {
    auto bound = at<d1>(ph::sector_bound{.slope = 20});
    return allowed(bound, desired, situation<d1>{.held = held, .travel = dx});
  };
  CHECK_THAT(next(-9.0, -1.0, 0.01), WithinRel(-1.2, 1e-14));   // pressing: β
  CHECK(next(0.0, -1.0, 0.01) == -1.0);                         //   and never less
  CHECK_THAT(next(-9.0, -1.0, -0.01), WithinRel(-0.8, 1e-14));  // releasing: at least β
  CHECK_THAT(next(0.0, -1.0, -0.01), WithinRel(-0.4, 1e-14));   //   at most 2b/T
  CHECK(next(0.0, -1.0, -0.03) == 0.0);
  CHECK(next(-9.0, -1.0, -0.06) == 0.0);
  CHECK(next(-9.0, -1.0, 0.0) == -1.0);  // at rest nothing moves
  CHECK(next(0.0, -1.0, 0.0) == -1.0);
  CHECK(next(9.0, -1.0, 0.0) == -1.0);  // not even for a wall behind
  CHECK(next(-9.0, 1.0, 0.0) == 1.0);
  CHECK_THAT(next(9.0, 0.0, -0.01), WithinRel(0.2, 1e-14));  // which has its turn from zero
  CHECK_THAT(next(-9.0, 0.0, 0.01), WithinRel(-0.2, 1e-14));
  CHECK_THAT(next(0.5, 0.0, -0.01), WithinRel(0.2, 1e-14));  // however little is asked for
  CHECK_THAT(next(-0.5, 0.0, 0.01), WithinRel(-0.2, 1e-14));
  CHECK(next(-9.0, 0.0, -0.01) == 0.0);
  CHECK(next(0.0, 0.0, 0.01) == 0.0);
}

TEST_CASE("sector_bound holds nothing after a lost or a late tick, until it is reset", "[bound]") {
  const auto next = [](auto& bound, const situation<d1>& now) { return allowed(bound, -9.0, now); };
  const situation<d1> good{.held = -1.0};
  for (const situation<d1>& bad : {situation<d1>{.held = -1.0, .motion_known = false},
                                   situation<d1>{.dt = 2e-3, .held = -1.0}}) {
    auto bound = at<d1>(ph::sector_bound{.slope = 20});
    CHECK(next(bound, good) == -1.0);
    CHECK(next(bound, bad) == 0.0);
    CHECK(next(bound, good) == 0.0);  // what the motors hold beyond the command is not credited
    bound.reset();
    CHECK(next(bound, good) == -1.0);
  }
}

TEST_CASE("sector_bound takes the b of its one axis", "[bound]") {
  const auto falls = [](auto damping) {
    auto bound = at<d1>(ph::sector_bound{.slope = 20});
    return allowed(bound, 0.0,
                   situation<d1, decltype(damping)>{
                       .damping = at<d1>(damping), .held = -1.0, .travel = -0.01});
  };
  CHECK(falls(ph::isotropic_damping{0.03}) == falls(ph::diagonal_damping<1>{{0.03}}));
  CHECK(falls(ph::isotropic_damping{0.03}) != falls(ph::diagonal_damping<1>{{0.02}}));
}

TEST_CASE("motors a little too strong do not wind the force up", "[bound]") {
  const auto wound = [](const auto& parameters, double dx) {
    auto bound = at<d1>(parameters);
    double force = allowed(bound, -1.0, situation<d1>{.held = -1.0});
    REQUIRE(force == -1.0);
    for (int n = 0; n < 1000; ++n) {
      force = allowed(bound, 0.0, situation<d1>{.held = 1.01 * force, .travel = dx});
    }
    return -force;
  };
  CHECK(wound(ph::sector_bound{}, 0.0) == 1.0);  // a contact that is lost, at rest
  CHECK(wound(ph::sector_bound{}, -1e-9) <= 1.0);
  CHECK(wound(ph::energy_bounding{}, -1e-9) <= 1.0);
}

TEST_CASE("sector_bound takes new parameters, refuses bad ones and starts anew", "[bound]") {
  const ph::sector_bound first, soft{.slope = 15}, none{.slope = -1};
  check_upkeep(following_half_space<d1>(ph::spring{}, thesis_ledger(), first), first, soft, none);
}

TEST_CASE("sector_bound loses nothing to motions in a quick run, one that gives more does",
          "[passivity]") {
  using attacks::least_of;
  const attacks::conditions troubles{
      .jitter = true, .lost = 0.02, .late = 0.02, .longest_tick = 1.5e-3, .force_limit = 0.3};
  for (const auto& when : {attacks::conditions{}, troubles}) {
    CHECK(least_of<d1>(ph::sector_bound{}, when, 4) >= -1e-12);
    CHECK(least_of<d1>(ph::sector_bound{.slope = 15}, when, 4) >= -1e-12);
    CHECK(least_of<d1>(attacks::generous<ph::sector_bound>{}, when, 4) < -1e-8);
  }
}
