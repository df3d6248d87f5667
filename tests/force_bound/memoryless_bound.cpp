// SPDX-License-Identifier: BSD-3-Clause
// memoryless_bound: its formula, what it does not trust, and a quick attack. All of the family against
// all adversaries: tests/full/bounds_families.cpp.
#include "force_bound/attacks.hpp"
#include "force_bound/upkeep.hpp"
#include <passive_haptics/published/energy_bounding.hpp>
#include <passive_haptics/published/sector_bound.hpp>

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

static_assert([] {
  const auto bound = at<d1>(ph::memoryless_bound{});
  return allowed(bound, -9.0, situation<d1>{.held = -2.0, .travel = -0.05}) > -1.0 - 1e-12;
}());
static_assert(sizeof(ph::part_at<ph::memoryless_bound, d2>) == 1);

}  // namespace

TEST_CASE("memoryless_bound obeys the laws of strict bounds", "[bound][law]") {
  CHECK(broken_laws<d1, f3>(ph::memoryless_bound{}).empty());
}

TEST_CASE("memoryless_bound is |f| ≤ |f_held − 2BΔx| when all ticks are equal (C1)", "[bound]") {
  const ph::diagonal_damping<3> damping{{0.03, 0.02, 0.008}};
  const d3::vector B(30, 20, 8), held(1, -2, 0.5), dx(2e-3, 1e-3, -3e-3), desired(30, 40, -50);
  const d3::vector w = held - 2 * B.cwiseProduct(dx);
  const auto wide = at<d3>(ph::memoryless_bound{});
  const situation<d3, ph::diagonal_damping<3>> now{
      .damping = at<d3>(damping), .held = held, .travel = dx};
  const d3::vector f = allowed(wide, desired, now);
  CHECK_THAT(f.cwiseAbs2().cwiseQuotient(B).sum(),
             WithinRel(w.cwiseAbs2().cwiseQuotient(B).sum(), 1e-13));
  CHECK((f.normalized() - desired.normalized()).norm() < 1e-15);

  const auto bound = at<d1>(ph::memoryless_bound{});
  const situation<d1> pressed{.held = -1.0, .travel = 0.01};
  CHECK_THAT(allowed(bound, -50.0, pressed), WithinRel(-1.6, 1e-13));
  CHECK(allowed(bound, -1.5, pressed) == -1.5);
  // at the worst motion of all, Δx = f/(2B), nothing is left
  CHECK_THAT(allowed(bound, -50.0, situation<d1>{.held = -1.0, .travel = -1.0 / 60}),
             WithinAbs(0.0, 1e-6));
}

TEST_CASE("memoryless_bound credits the measured tick and promises the longest (§ 3)", "[bound]") {
  const auto bound = at<d1>(ph::memoryless_bound{});
  // S = f²T/(4b) = 0.0125 J, b Δx²/dt = 6e-6 J, −fΔx = 0.01·1 J
  const situation<d1> now{.dt = 0.5e-3, .longest_tick = 1.5e-3, .held = -1.0, .travel = 0.01};
  CHECK_THAT(allowed(bound, -50.0, now),
             WithinRel(-std::sqrt(80 * (0.0125 + 0.006 + 0.01)), 1e-13));
}

TEST_CASE("no bound of these families trusts a tick that was lost or late", "[bound]") {
  const auto check = [](const auto& parameters) {
    const auto limit = [&](const situation<d1>& now) {
      auto bound = at<d1>(parameters);  // it knows no command before this one
      return allowed(bound, -50.0, now);
    };
    situation<d1> now{.held = -1.0, .travel = 0.01};
    CHECK(limit(now) != 0.0);  // the control
    now.motion_known = false;
    CHECK(limit(now) == 0.0);
    now.motion_known = true;
    now.dt = 1.1e-3;
    CHECK(limit(now) == 0.0);
  };
  check(ph::memoryless_bound{});
  check(ph::energy_bounding{});
  check(ph::tight_energy_bounding{});
  check(ph::sector_bound{});
}

TEST_CASE("pressed slowly, the families show 2b/T, b/T or β, and not more (L4)", "[bound]") {
  const auto shown = [](const auto& bound, const auto& limits) {
    auto model = following_half_space<d1>(ph::spring{}, thesis_ledger(), bound, limits);
    (void)model.update(wall<d1>(1e4));
    double force = 0.0;
    for (int n = 0; n <= 10000; ++n) force = model.tick(n * 2e-6, 1ms).force;  // 20 mm in 10 s
    return -force / 0.02;
  };
  CHECK_THAT(shown(ph::strict_bound{}, thesis_loop), WithinRel(60.0, 0.01));
  CHECK_THAT(shown(ph::memoryless_bound{}, thesis_loop), WithinRel(60.0, 0.01));
  const ph::late_loop_limits<2> late{.longest_tick = 1e-3};
  CHECK_THAT(shown(ph::memoryless_bound{}, late), WithinRel(20.0, 0.01));
  CHECK_THAT(shown(ph::per_axis_bound{}, thesis_loop), WithinRel(60.0, 0.01));
  CHECK_THAT(shown(ph::tight_energy_bounding{}, thesis_loop), WithinRel(60.0, 0.01));
  CHECK_THAT(shown(ph::tight_energy_bounding{.storage = 25}, thesis_loop), WithinRel(25.0, 0.01));
  CHECK_THAT(shown(ph::energy_bounding{}, thesis_loop), WithinRel(30.0, 0.01));
  CHECK_THAT(shown(ph::sector_bound{}, thesis_loop), WithinRel(60.0, 0.01));
  CHECK_THAT(shown(ph::sector_bound{.slope = 40}, thesis_loop), WithinRel(40.0, 0.01));
}

TEST_CASE("parameters of energy_bounding, per_axis_bound and sector_bound are refused by name",
          "[bound]") {
  const double nan = std::nan("");
  CHECK_FALSE(ph::energy_bounding{}.check());
  CHECK_FALSE(ph::tight_energy_bounding{}.check());
  CHECK_FALSE(ph::sector_bound{}.check());
  CHECK_FALSE(ph::per_axis_bound{}.check());
  CHECK(refused(ph::energy_bounding{.slope = 0}) == "slope");
  CHECK(refused(ph::energy_bounding{.storage = nan}) == "storage");
  CHECK(refused(ph::tight_energy_bounding{.storage = -1}) == "storage");
  CHECK(refused(ph::sector_bound{.slope = nan}) == "slope");
  CHECK(refused(ph::per_axis_bound{.cap = -1}) == "cap");
}

TEST_CASE("memoryless_bound loses nothing to motions in a quick run, one that gives more does",
          "[passivity]") {
  using attacks::least_of;
  const attacks::conditions troubles{
      .jitter = true, .lost = 0.02, .late = 0.02, .longest_tick = 1.5e-3, .force_limit = 0.3};
  for (const auto& when : {attacks::conditions{}, troubles}) {
    CHECK(least_of<d1>(ph::memoryless_bound{}, when, 4) >= -1e-12);
    CHECK(least_of<d1>(attacks::generous<ph::memoryless_bound>{}, when, 4) < -1e-8);
  }
}
