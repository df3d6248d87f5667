// SPDX-License-Identifier: BSD-3-Clause
// The adversaries that are smaller than encoders show or friction resists: what they draw from a ledger
// that takes positions as exact or friction as rigid, and that they draw nothing where it is told.
// More of it is in full/simulation_encoders.cpp.
#include "attacks/challenged.hpp"
#include <passive_haptics/simulation/search.hpp>

#include <algorithm>
#include <cmath>

using namespace simulated;
using Catch::Matchers::WithinAbs;

namespace {

/// A ledger that is told of a rigid friction and of exact positions, and one that does not trust these.
template <class Space = d1>
auto counting_on(double friction) {
  return following_half_space<Space>(
      ph::spring{}, ph::dual_ledger{.damping = {0.03, friction, 0.0}}, ph::strict_bound{});
}
template <class Space = d1>
auto stepped(double quantum) {
  return following_half_space<Space>(
      ph::spring{}, ph::quantised_energy{.damping = 0.03, .quantum = quantum}, ph::strict_bound{});
}

double worst(const auto& verdicts) {
  double least = 0.0;
  for (const sim::verdict& v : verdicts) least = std::min(least, v.least_energy);
  return least;
}

}  // namespace

TEMPLATE_TEST_CASE(
    "small adversaries draw energy from an unbounded wall and none from strict_bound",
    "[adversaries][law]", d1, d3) {
  survives(sim::challenge_encoders(strict<TestType>, {}, 20));
  for (const sim::verdict& v : sim::challenge_encoders(unbounded<TestType>, {}, 20)) {
    CAPTURE(to_string(v.by), v.least_energy);
    CHECK(v.least_energy < -1e-3);
  }
}

TEST_CASE(
    "steps and noise draw energy from a ledger of exact positions, and none from one of steps",
    "[adversaries][law]") {
  for (const sim::circumstances& world :
       {sim::circumstances{.quantum = 60e-6}, sim::circumstances{.noise = 60e-6},
        sim::circumstances{.quantum = 20e-6, .noise = 40e-6}}) {
    CAPTURE(world.quantum, world.noise);
    survives(sim::challenge_encoders(stepped(60e-6), world, 30));
    CHECK(worst(sim::challenge_encoders(strict<d1>, world, 30)) < -1e-5);
    for (const sim::verdict& v : sim::challenge_encoders(strict<d1>, world, 30)) {
      CAPTURE(to_string(v.by), v.least_energy);
      CHECK(v.least_energy < -1e-8);
    }
  }
  survives(sim::challenge_encoders(stepped<d3>(60e-6), {.noise = 60e-6}, 6));
  CHECK(worst(sim::challenge_encoders(stepped(20e-6), {.noise = 60e-6}, 30)) < -1e-6);
}

TEST_CASE("the twelve meet noise, too", "[adversaries][law]") {
  survives_all(stepped(60e-6), {.noise = 60e-6}, 6);
  CHECK(worst(sim::challenge_all(strict<d1>, {.noise = 60e-6}, 6)) < -1e-4);
}

TEST_CASE(
    "a ledger that credits friction as rigid loses where it is elastic, more the more it gives",
    "[adversaries][law]") {
  survives(sim::challenge_encoders(counting_on(0.2), {.friction = 0.2}, 20));  // it is rigid
  double last = -1e-7;
  for (const double p : {1e-6, 10e-6, 30e-6}) {
    CAPTURE(p);
    const sim::circumstances world{.friction = 0.2, .presliding = p};
    const double lost = worst(sim::challenge_encoders(counting_on(0.2), world, 30));
    CHECK(lost < 2.0 * last);
    last = lost;
  }
  CHECK(last < -1e-3);
  const sim::circumstances soft{.friction = 0.2, .presliding = 30e-6};
  CHECK(worst(sim::challenge_encoders(counting_on<d3>(0.2), soft, 6)) < -1e-3);
}

TEST_CASE("the search meets elastic friction and noise", "[adversaries][search]") {
  const sim::circumstances elastic{.friction = 0.2, .presliding = 30e-6};
  CHECK(sim::worst_motion(counting_on(0.2), elastic, 200).energy < -1e-6);
  CHECK(sim::worst_motion(counting_on(0.2), {.friction = 0.2}, 200).energy >= -1e-12);
  CHECK(sim::worst_push(strict<d1>, elastic, 20).energy >= -1e-12);
  const sim::circumstances noisy{.noise = 60e-6};
  CHECK(sim::worst_motion(strict<d1>, noisy, 200).energy < -1e-6);
  CHECK(sim::worst_motion(stepped(60e-6), noisy, 200).energy >= -1e-12);
}

TEST_CASE("the price of a move is what the move then books", "[adversaries]") {
  sim::prescribed_motion<d3, sim::friction_like> motion{
      {.latency = 1, .watchdog = 1e-3}, {sim::friction_kind::three_springs, 0.2, 10e-6}};
  sim::random_source random{3};
  d3::vector force = d3::zero();
  for (int n = 0; n < 200; ++n) {
    const d3::vector next = motion.position() + random.direction<d3>() * random.uniform(0.0, 5e-5);
    force = random.direction<d3>() * 2.0;
    const double price = motion.price(next, force), before = motion.meter().with_friction();
    motion.move_to(next);
    motion.exchange(force);
    REQUIRE_THAT(motion.meter().with_friction() - before, WithinAbs(price, 1e-15));
  }
  const sim::adversary_view<d1> without_device{0.0, 1.0, 0.0, 2.0};
  CHECK_THAT(without_device.price(1e-3), WithinAbs(0.03 * 1e-6 / 1e-3 - 2.0 * 1e-3, 1e-18));
}

TEST_CASE("a noisy sensor stays within its width, and hides what it can", "[adversaries]") {
  for (int habit = 0; habit < 5; ++habit) {
    sim::noisy_sensor<d1> noise(20e-6, static_cast<sim::noise_habit>(habit), 7);
    sim::random_source random{3};
    double x = 0.0, least = 0.0, most = 0.0;
    for (int n = 0; n < 2000; ++n) {
      x += random.uniform(-5e-6, 5e-6);
      const double e = noise.error(x, random.uniform(0.0, 1.0));
      least = std::min(least, e);
      most = std::max(most, e);
    }
    CHECK(least >= -10e-6);
    CHECK(most <= 10e-6);
    CHECK(least < -9.9e-6);
    CHECK(most > 9.9e-6);
  }
  sim::noisy_sensor<d1> hides(20e-6, sim::noise_habit::hiding, 7);
  CHECK(1e-3 + hides.error(1e-3, 0.0) == 1e-3);
  for (const double x : {1.009e-3, 0.991e-3, 1.004e-3}) {
    const double below = hides.room_below(0), above = hides.room_above(0);
    CHECK(below + above <= 20e-6 * (1 + 1e-12));
    CHECK_THAT(x + hides.error(x, 0.0), WithinAbs(1e-3, 1e-15));
  }
  CHECK_THAT(1.02e-3 + hides.error(1.02e-3, 0.0), WithinAbs(1.01e-3, 1e-15));
  CHECK(sim::noisy_sensor<d1>(0.0, sim::noise_habit::uniform, 7).error(1.0, 1.0) == 0.0);
}

namespace {

/// What a dual ledger is told of a world: on every axis a spring that gives way by p, so p √n in all.
template <class Space>
ph::dual_ledger told(const sim::circumstances& world) {
  return {.damping = {world.damping, world.friction, world.presliding * std::sqrt(Space::dof)},
          .quantum = world.quantum + world.noise};
}

}  // namespace

TEST_CASE("dual_ledger that is told too little loses", "[adversaries][law]") {
  const sim::circumstances world{.friction = 0.2, .presliding = 30e-6, .quantum = 60e-6};
  const auto least = [](const ph::dual_ledger& ledger, const sim::circumstances& there) {
    const auto model = following_half_space<d1>(ph::spring{}, ledger, ph::strict_bound{});
    return worst(sim::challenge_encoders(model, there, 10));
  };
  ph::dual_ledger short_springs = told<d1>(world), rough = told<d1>(world);
  short_springs.damping.presliding = 0.0;
  rough.damping.coulomb = 0.4;
  CHECK(least(told<d1>(world), world) >= -1e-12);
  CHECK(least(short_springs, world) < -1e-6);
  const sim::circumstances slippery{.friction = 0.05, .presliding = 2e-6, .quantum = 60e-6};
  ph::dual_ledger fine = told<d1>(slippery);
  fine.quantum = 10e-6;
  CHECK(least(told<d1>(slippery), slippery) >= -1e-12);
  CHECK(least(fine, slippery) < -1e-6);
  CHECK(least(rough, world) < -1e-5);
}
