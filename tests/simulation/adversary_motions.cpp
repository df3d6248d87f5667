// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/reference.hpp"
#include "support/catch.hpp"
#include <passive_haptics/simulation/adversary.hpp>
#include <passive_haptics/simulation/prescribed_motion.hpp>

#include <algorithm>

namespace sim = ph::simulation;
using namespace simulated;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

TEST_CASE("nyquist_motion takes exactly (K − 2B) δ² per cycle from a spring (A5)",
          "[simulation][adversary][law]") {
  const double K = 10000.0;
  sim::prescribed_motion<line> motion;
  sim::nyquist_motion<line> nyquist{.amplitude = 1e-3};
  sim::random_source random;
  double force = 0.0;
  constexpr int cycles = 10000;
  for (int n = 0; n < 2 * cycles; ++n) {
    motion.move_to(nyquist.next({motion.position(), 1.0, -motion.position(), force}, random));
    force = K * std::max(0.0, -motion.exchange(force).position);
  }
  CHECK_THAT(motion.meter().value(), WithinRel(-cycles * (K - 60.0) * 1e-6, 1e-12));
}

namespace {

/// Least true energy of a sampled wall with a jumping surface under an adversary; with `bounded`,
/// the strict law |f| ≤ √(4 B E1).
template <class Adversary>
double least_energy(Adversary adversary, bool bounded, std::uint64_t seed) {
  sim::prescribed_motion<room> motion;
  sim::random_source random{seed};
  sim::jumping_surface surface{2e-3, seed};
  sim::switching_stiffness stiffness{2000.0, 22000.0, seed + 1};
  const room::vector normal = random.direction<room>();
  room::vector force = room::zero(), last = room::zero();
  ph::compensated_sum<double> ledger;
  for (int n = 0; n < 20000; ++n) {
    const double top = surface.offset(motion.time());
    const double seen = top - normal.dot(motion.position());
    motion.move_to(adversary.next({motion.position(), normal, seen, force}, random));
    const ph::device_sample<room> sample = motion.exchange(force);
    const room::vector x = sample.position, held = sample.held, step = x - last;
    ledger += 30.0 * step.squaredNorm() - held.dot(step);
    last = x;
    double push = stiffness.stiffness(motion.time()) * std::max(0.0, top - normal.dot(x));
    if (bounded) push = std::min(push, ph::kernels::strict_force_bound<double>(ledger, 30.0));
    force = normal * push;
  }
  CHECK_THAT(double(ledger), WithinAbs(motion.meter().value(), 1e-10));
  return motion.meter().minimum();
}

}  // namespace

TEST_CASE("adversaries empty an unbounded wall and not a strictly bounded one",
          "[simulation][adversary][law]") {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
    CAPTURE(seed);
    const sim::greedy_motion<room> greedy{};
    const sim::random_walk<room> walk{};
    const sim::nyquist_motion<room> nyquist{};
    CHECK(least_energy(greedy, false, seed) < -0.1);
    CHECK(least_energy(walk, false, seed) < -1e-3);
    CHECK(least_energy(nyquist, false, seed) < -0.1);
    CHECK(least_energy(greedy, true, seed) >= -1e-12);
    CHECK(least_energy(walk, true, seed) >= -1e-12);
    CHECK(least_energy(nyquist, true, seed) >= -1e-12);
  }
}

TEST_CASE("greedy_motion takes the Δx that L3 calls worst", "[simulation][adversary]") {
  sim::random_source random{5};
  const sim::greedy_motion<line> greedy{.speed = 1.0, .press = 0.0};
  const double slow = greedy.next({0.0, 1.0, 1e-3, 0.03}, random);
  CHECK_THAT(slow, WithinRel(0.03 / 60.0, 1e-14));  // f/(2B), within the speed limit
  const double gain = 0.03 * slow - 30.0 * slow * slow;
  CHECK_THAT(gain, WithinRel(ph::kernels::worst_outflow(0.03, 30.0), 1e-14));
  CHECK_THAT(greedy.next({0.0, 1.0, 1e-3, 5.0}, random), WithinRel(1e-3, 1e-14));
  CHECK(greedy.next({0.0, 1.0, -1.0, 0.0}, random) == -1e-3);
}
