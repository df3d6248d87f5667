// SPDX-License-Identifier: BSD-3-Clause
// Dry friction that is credited: devices that have it, devices that have less, and hands that no force
// can stop.
#include "force_bound/attacks.hpp"
#include "support/catch.hpp"

namespace {

/// Exact positions, a rigid friction.
constexpr ph::dual_ledger rubbing(double coulomb) {
  return {.damping = {0.03, coulomb, 0.0}};
}

/// The least energy at the port, dry friction counted, of a real device that is tapped for 3 s.
template <class Space, class Bound>
double tapped_with_friction(const Bound& bound, double claimed, double there, std::uint64_t seed) {
  using coordinates = typename sim::physical<Space>::coordinates;
  using physical = typename sim::physical<Space>::vector;
  auto model = following_half_space<Space>(ph::spring{}, rubbing(claimed), bound);
  sim::random_source random(seed);
  const physical normal = random.direction<Space>();
  const coordinates start = physical(normal * random.uniform(1e-5, 1e-3));
  const double push = random.uniform(1.0, 10.0);
  sim::device<Space, sim::tapping_hand<Space>> device(
      {.mass = 0.1, .friction = there, .start = start},
      {.surface = {}, .normal = coordinates(normal), .limit = push});
  auto sample = device.exchange(Space::zero());
  double least = 0.0;
  for (int n = 0; n < 3000; ++n) {
    if (n % 40 == 0) {
      const physical moved = normal * random.uniform(-1e-4, 1e-4);
      (void)model.update({moved, normal, 1e4});
    }
    sample = device.exchange(model.tick(sample).force);
    least = std::min(least, device.meter().value() + device.meter().total().friction);
  }
  return least;
}

template <class Bound>
double tapped_with_friction(const Bound& bound, double claimed, double there) {
  double least = 0.0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    least = std::min({least, tapped_with_friction<d1>(bound, claimed, there, seed),
                      tapped_with_friction<d2>(bound, claimed, there, seed),
                      tapped_with_friction<d3>(bound, claimed, there, seed)});
  }
  return least;
}

}  // namespace

TEST_CASE("a device with at least the dry friction stated loses nothing, one with less does",
          "[passivity][friction]") {
  const ph::strict_bound strict;
  const ph::reachable_bound reachable{.mass = 0.1, .hand_force = 12.0};
  CHECK(tapped_with_friction(strict, 0.2, 0.2) >= -1e-12);
  CHECK(tapped_with_friction(strict, 0.2, 0.5) >= -1e-12);
  CHECK(tapped_with_friction(reachable, 0.2, 0.2) >= -1e-12);
  CHECK(tapped_with_friction(strict, 0.2, 0.05) < -1e-6);  // the controls
  CHECK(tapped_with_friction(reachable, 0.2, 0.05) < -1e-6);
}

TEST_CASE("strict_bound loses nothing to a hand that no force can stop, with dry friction",
          "[passivity][friction]") {
  const ph::loop_limits limits{.longest_tick = 1.5e-3, .top_speed = 100.0, .watchdog = 1.5e-3};
  const auto least = [&](auto space, const auto& bound, double there) {
    using S = decltype(space);
    const attacks::conditions when{.jitter = true, .longest_tick = 1.5e-3, .friction = there};
    const auto model = attacks::model_of<S>(bound, limits, ph::spring{}, rubbing(0.05));
    return attacks::worst_of<S>(model, when).least;
  };
  CHECK(least(d1{}, ph::strict_bound{}, 0.05) >= -1e-12);
  CHECK(least(d2{}, ph::strict_bound{}, 0.05) >= -1e-12);
  CHECK(least(d3{}, ph::strict_bound{}, 0.05) >= -1e-12);
  CHECK(least(d1{}, ph::strict_bound{}, 0.03) < -1e-6);  // the controls: less is there
  CHECK(least(d2{}, ph::strict_bound{}, 0.03) < -1e-6);
  CHECK(least(d3{}, ph::strict_bound{}, 0.03) < -1e-6);
}
