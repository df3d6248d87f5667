// SPDX-License-Identifier: BSD-3-Clause
// energy_bounding and tight_energy_bounding: the published window, its form in two and three
// dimensions, how they relate, and a quick attack.
#include "force_bound/attacks.hpp"
#include "force_bound/upkeep.hpp"
#include "published/stores.hpp"

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

static_assert([] {
  auto bound = at<d1>(ph::energy_bounding{});
  return allowed(bound, 0.0, situation<d1>{.held = -2.0, .travel = -0.01}) < -1.0;
}());
// An eighth of them while compiling; clang counts the steps.
static_assert(the_families_obey<d1>(480) && the_families_obey<f1>(480));

/// What the bound allows that knows no command before this one.
template <class Bound, class Port, class Damping>
auto afresh_allowed(const Bound& parameters, const typename Port::effort& desired,
                    const situation<Port, Damping>& now) {
  auto bound = at<Port>(parameters);
  return allowed(bound, desired, now);
}
double limit(const auto& parameters, double desired, double held, double travel) {
  return afresh_allowed(parameters, desired, situation<d1>{.held = held, .travel = travel});
}

}  // namespace

TEST_CASE("energy_bounding in one dimension is the published window (§ 2(b))", "[bound]") {
  sim::random_source random(7);
  int inside = 0, below = 0, above = 0;
  for (int i = 0; i < 20000; ++i) {
    const double c1 = random.uniform(1.0, 30.0), c2 = random.uniform(0.5, c1);
    const double last = random.uniform(-2.0, 2.0), dx = random.uniform(-5e-2, 5e-2);
    const double wanted = random.uniform(-4.0, 4.0);  // reaction forces, x into the wall
    const double r = last / dx, root = std::sqrt(c2 * c2 + r * r);
    const double low = c2 - r - root, high = std::min(c1, c2 - r + root);
    const double asked = (wanted - last) / dx;
    (asked < low ? below : asked > high ? above : inside) += 1;
    const double published = last + std::clamp(asked, low, high) * dx;
    const ph::energy_bounding bound{.slope = c1, .storage = c2};
    REQUIRE_THAT(-limit(bound, -wanted, -last, dx), WithinAbs(published, 1e-11));
  }
  CHECK(std::min({inside, below, above}) > 1000);
  // a c2 above c1 would leave no window: it counts as c1
  for (int i = 0; i < 200; ++i) {
    const double held = random.uniform(-2.0, 2.0), dx = random.uniform(-5e-2, 5e-2);
    const double desired = random.uniform(-4.0, 4.0);
    REQUIRE(limit(ph::energy_bounding{.slope = 10}, desired, held, dx) ==
            limit(ph::energy_bounding{.slope = 10, .storage = 10}, desired, held, dx));
  }
}

TEST_CASE("no force that energy_bounding could give is nearer to the desired one", "[bound]") {
  sim::random_source random(19);
  int at_plane = 0, at_rim = 0;
  for (int i = 0; i < 300; ++i) {
    const double c1 = random.uniform(5.0, 30.0), c2 = random.uniform(2.0, c1);
    const d2::vector h = random.direction<d2>() * random.uniform(0.0, 2.0);
    const d2::vector dx = random.direction<d2>() * random.uniform(1e-3, 5e-2);
    const d2::vector desired = random.direction<d2>() * random.uniform(0.0, 4.0);
    const auto gap = [&](const d2::vector& f) {  // of the half-space and of the ball
      return std::pair{(h - f).dot(dx) - std::min(c1, 30.0) * dx.dot(dx),
                       (f + c2 * dx).norm() - std::sqrt(h.dot(h) + c2 * c2 * dx.dot(dx))};
    };
    const d2::vector found = afresh_allowed(ph::energy_bounding{.slope = c1, .storage = c2},
                                            desired, situation<d2>{.held = h, .travel = dx});
    REQUIRE(gap(found).first <= 1e-12);
    REQUIRE(gap(found).second <= 1e-12);
    const bool plane = gap(found).first > -1e-9, rim = gap(found).second > -1e-9;
    at_plane += plane && !rim ? 1 : 0;
    at_rim += plane && rim ? 1 : 0;
    const double miss = (found - desired).norm();
    for (int n = 0; n < 64; ++n) {  // the set is convex: a nearer force would be near this one, too
      const double angle = 2.0 * 3.141592653589793 * n / 64;
      const d2::vector other = found + 1e-4 * d2::vector(std::cos(angle), std::sin(angle));
      if (gap(other).first > 0.0 || gap(other).second > 0.0) continue;
      REQUIRE((other - desired).norm() >= miss);
    }
  }
  CHECK(std::min(at_plane, at_rim) > 10);
}

TEST_CASE("where the ball only touches the half-space, that force is energy_bounding's",
          "[bound]") {
  sim::random_source random(29);
  for (int i = 0; i < 2000; ++i) {  // h = 0 and c1 = 2 c2: −2 c2 Δx is in both
    const double c2 = random.uniform(1.0, 14.0), dx = random.uniform(-5e-2, 5e-2);
    REQUIRE_THAT(limit(ph::energy_bounding{.slope = 2 * c2, .storage = c2}, -1e3 * dx, 0.0, dx),
                 WithinRel(-2 * c2 * dx, 1e-6));
  }
}

TEST_CASE("energy_bounding credits no more than it commanded, until it is reset", "[bound]") {
  auto bound = at<d1>(ph::energy_bounding{});
  const auto next = [&](double desired) {
    return allowed(bound, desired, situation<d1>{.held = -2.0});
  };
  CHECK(next(-9.0) == -2.0);
  CHECK(next(0.0) == 0.0);
  CHECK(next(-9.0) == 0.0);  // the motors hold 2 N on their own
  bound.reset();
  CHECK(next(-9.0) == -2.0);
}

TEST_CASE("energy_bounding pushes on after the contact is lost, and starts nothing", "[bound]") {
  const ph::energy_bounding bound;
  static_assert(!ph::detail::reduces<ph::energy_bounding, d1, situation<d1>::state_type>());
  double force = -0.3;  // the wall is gone: nothing is desired from here on
  for (int n = 1; n <= 10; ++n) {
    const double next = limit(bound, 0.0, force, -0.5e-3);    // moving out
    CHECK_THAT(next, WithinAbs(force + 30 * 0.5e-3, 1e-12));  // b/T a metre, no faster
    CHECK(next < 0.0);                                        // outwards, never inwards
    force = next;
  }
  CHECK(limit(bound, 0.0, force, 0.0) == 0.0);     // at rest it may end at once,
  CHECK(limit(bound, 0.0, force, 0.5e-3) == 0.0);  // and pressed in
  CHECK(limit(bound, -9.0, force, 0.0) == force);
  for (const double dx : {-1e-2, -1e-5, 0.0, 1e-5, 1e-2}) CHECK(limit(bound, 0.0, 0.0, dx) == 0.0);
  SECTION("a force desired outwards is never turned inwards") {
    sim::random_source random(3);
    for (int i = 0; i < 10000; ++i) {
      const double held = -random.uniform(0.0, 3.0), dx = random.uniform(-0.1, 0.1);
      REQUIRE(limit(bound, -random.uniform(0.0, 3.0), held, dx) <= 0.0);
    }
  }
}

TEST_CASE("tight_energy_bounding with c2 = 2b/T is memoryless_bound", "[bound]") {
  sim::random_source random(5);
  for (int i = 0; i < 5000; ++i) {
    const double longest = 1.5e-3, dt = random.uniform(0.2e-3, longest);
    const d3::vector held = random.direction<d3>() * random.uniform(0.0, 3.0);
    const d3::vector dx = random.direction<d3>() * random.uniform(0.0, 2e-2);
    const d3::vector desired = random.direction<d3>() * random.uniform(0.0, 5.0);
    const situation<d3> now{.dt = dt, .longest_tick = longest, .held = held, .travel = dx};
    const d3::vector one = afresh_allowed(ph::memoryless_bound{}, desired, now);
    const d3::vector other = afresh_allowed(ph::tight_energy_bounding{.storage = 40}, desired, now);
    const d3::vector softer =
        afresh_allowed(ph::tight_energy_bounding{.storage = 20}, desired, now);
    REQUIRE((one - other).norm() < 1e-11);
    if (one.norm() < desired.norm() * 0.9 && held.norm() < 1e-3) {
      REQUIRE(softer.norm() < one.norm());
    }
  }
}

TEST_CASE("energy_bounding and sector_bound never exceed tight_energy_bounding", "[bound]") {
  sim::random_source random(9);
  for (int i = 0; i < 5000; ++i) {
    const double c = random.uniform(1.0, 30.0);
    const double desired = random.uniform(-3.0, 3.0);
    const double held = random.uniform(-2.0, 2.0), dx = random.uniform(-5e-2, 5e-2);
    const double most =
        std::abs(limit(ph::tight_energy_bounding{.storage = c}, 1e6, held, dx)) + 1e-12;
    REQUIRE(std::abs(limit(ph::energy_bounding{.storage = c}, desired, held, dx)) <= most);
    REQUIRE(std::abs(limit(ph::sector_bound{.slope = c}, desired, held, dx)) <= most);
  }
}

TEST_CASE("energy_bounding takes new parameters, refuses bad ones and starts anew", "[bound]") {
  CHECK(refused(ph::energy_bounding{.storage = -1}) == "storage");
  CHECK(refused(ph::tight_energy_bounding{.storage = -1}) == "storage");
  const ph::energy_bounding first, soft{.slope = 20, .storage = 5}, none{.slope = -1};
  check_upkeep(following_half_space<d1>(ph::spring{}, thesis_ledger(), first), first, soft, none);
}

TEST_CASE("energy_bounding loses nothing to motions in a quick run, one that gives more does",
          "[passivity]") {
  using attacks::generous, attacks::least_of;
  const attacks::conditions troubles{
      .jitter = true, .lost = 0.02, .late = 0.02, .longest_tick = 1.5e-3, .force_limit = 0.3};
  for (const auto& when : {attacks::conditions{}, troubles}) {
    CHECK(least_of<d1>(ph::energy_bounding{}, when, 4) >= -1e-12);
    CHECK(least_of<d1>(ph::tight_energy_bounding{}, when, 4) >= -1e-12);
    CHECK(least_of<d1>(generous<ph::energy_bounding>{{}, 3.0}, when, 4) < -1e-8);
    CHECK(least_of<d1>(generous<ph::tight_energy_bounding>{}, when, 4) < -1e-8);
  }
}
