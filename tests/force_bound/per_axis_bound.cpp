// SPDX-License-Identifier: BSD-3-Clause
// per_axis_bound: its formula, its ledgers as they show in the force, and a quick attack.
#include "force_bound/attacks.hpp"
#include "force_bound/upkeep.hpp"

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

using part = ph::part_at<ph::per_axis_bound, d1>;

/// E [J] of a copy, from the force it allows: 4 B E = f². In debt it is lent enough to answer.
double ledger_of(const part& bound) {
  for (double lent : {0.0, 1e-6, 1e-4, 1e-2, 1.0}) {
    part copy = bound;
    const double travel = std::sqrt(lent / 30.0);
    const double f = allowed(copy, -1e6, situation<d1>{.travel = travel});
    const double brought = f * f / 120.0;
    if (brought > lent / 1e3) return brought - lent;
  }
  return -attacks::inf;
}

}  // namespace

TEST_CASE("per_axis_bound obeys the laws of strict bounds", "[bound][law]") {
  CHECK(broken_laws<d1, f3>(ph::per_axis_bound{}).empty());
}

TEST_CASE("per_axis_bound is √(4 Bᵢ Eᵢ) on every axis and turns the force (C2)", "[bound]") {
  const ph::diagonal_damping<3> damping{{0.03, 0.02, 0.008}};
  auto bound = at<d3>(ph::per_axis_bound{});
  situation<d3, ph::diagonal_damping<3>> now{.damping = at<d3>(damping),
                                             .travel = d3::vector(2e-3, 1e-3, 0)};
  const d3::vector desired(30, -40, 50);
  const d3::vector f = allowed(bound, desired, now);
  CHECK_THAT(f(0), WithinRel(2 * 30 * 2e-3, 1e-13));
  CHECK_THAT(f(1), WithinRel(-2 * 20 * 1e-3, 1e-13));
  CHECK(f(2) == 0.0);
  now.travel = d3::zero();
  CHECK(allowed(bound, d3::vector(0.01, 0, 0), now) == d3::vector(0.01, 0, 0));
  static_assert(!ph::detail::reduces<ph::per_axis_bound, d3, situation<d3>::state_type>());
}

TEST_CASE("per_axis_bound keeps its ledgers as the observer does", "[bound]") {
  auto bound = at<d1>(ph::per_axis_bound{});
  const auto limit = [&](double desired, double held, double travel, double dt = 1e-3) {
    return allowed(bound, desired, situation<d1>{.dt = dt, .held = held, .travel = travel});
  };
  const situation<d1> lost{.motion_known = false};
  (void)limit(-1.0, 0.0, 1e-3);
  CHECK_THAT(ledger_of(bound), WithinRel(30e-6, 1e-13));
  (void)limit(-1.0, -0.03, 1e-3, 0.5e-3);
  CHECK_THAT(ledger_of(bound), WithinRel(30e-6 + 60e-6 + 30e-6, 1e-13));
  SECTION("a late tick that gained counts as the worst a dropped force can have done") {
    (void)limit(-1.0, -0.05, 1e-3, 2e-3);
    CHECK_THAT(ledger_of(bound), WithinRel(120e-6 - 0.0025 / 120, 1e-12));
  }
  SECTION("a late tick that cost more than that counts as it was") {
    (void)limit(-1.0, -0.05, -1.5e-3, 2e-3);
    CHECK_THAT(ledger_of(bound), WithinRel(120e-6 + 15 * 2.25e-6 - 75e-6, 1e-12));
  }
  SECTION("a tick that nobody saw voids the credit") {
    CHECK(allowed(bound, -1.0, lost) == 0.0);
    auto fresh = at<d1>(ph::per_axis_bound{});  // and leaves no debt: it goes on as at the start
    const situation<d1> pressed{.travel = 1e-5};
    CHECK(allowed(bound, -1.0, pressed) == allowed(fresh, -1.0, pressed));
  }
  SECTION("and a debt stays a debt") {
    (void)limit(-1.0, -10.0, -1e-3);  // a motor that did not obey
    const double debt = ledger_of(bound);
    CHECK(debt < -1e-3);
    CHECK(allowed(bound, -1.0, lost) == 0.0);
    CHECK(limit(-1.0, 0.0, 1e-3) == 0.0);
    CHECK_THAT(ledger_of(bound), WithinRel(debt + 30e-6, 1e-12));
  }
  SECTION("no more than the cap is kept") {
    bound.set({.cap = 1e-6});
    CHECK_THAT(limit(-1.0, 0.0, 1e-3), WithinRel(-std::sqrt(4 * 30 * 1e-6), 1e-13));
  }
}

TEST_CASE("per_axis_bound takes new parameters, refuses bad ones and starts anew", "[bound]") {
  const ph::per_axis_bound unlimited, little{.cap = 1e-7}, none{.cap = -1};
  check_upkeep(following_half_space<d1>(ph::spring{}, thesis_ledger(), unlimited), unlimited,
               little, none);
}

TEST_CASE("per_axis_bound loses nothing to motions in a quick run, one that gives more does",
          "[passivity]") {
  using attacks::least_of;
  const attacks::conditions troubles{
      .jitter = true, .lost = 0.02, .late = 0.02, .longest_tick = 1.5e-3, .force_limit = 0.3};
  for (const auto& when : {attacks::conditions{}, troubles}) {
    CHECK(least_of<d1>(ph::per_axis_bound{}, when, 4) >= -1e-12);
    CHECK(least_of<d2>(ph::per_axis_bound{}, when, 4) >= -1e-12);
    CHECK(least_of<d1>(attacks::generous<ph::per_axis_bound>{}, when, 4) < -1e-8);
  }
}
