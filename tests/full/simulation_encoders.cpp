// SPDX-License-Identifier: BSD-3-Clause
// attacks/adversary_encoders.cpp at length.
#include "attacks/challenged.hpp"

#include <algorithm>
#include <cmath>

using namespace simulated;

namespace {

double worst(const auto& verdicts) {
  double least = 0.0;
  for (const sim::verdict& v : verdicts) least = std::min(least, v.least_energy);
  return least;
}
double worst(const auto& model, const sim::circumstances& world, int runs) {
  return worst(sim::challenge_encoders(model, world, runs));
}

/// A ledger that is told of a rigid friction and of exact positions.
auto counting_on(double damping, double friction) {
  return following_half_space<d1>(
      ph::spring{}, ph::dual_ledger{.damping = {damping, friction, 0.0}}, ph::strict_bound{});
}

/// What a dual ledger is told of a world: on every axis a spring that gives way by p, so p √n in all.
template <class Space>
ph::dual_ledger told(const sim::circumstances& world) {
  return {.damping = {world.damping, world.friction, world.presliding * std::sqrt(Space::dof)},
          .quantum = world.quantum + world.noise};
}
template <class Space, int Latency = 0>
auto dual(const sim::circumstances& world) {
  return following_half_space<Space>(ph::spring{}, told<Space>(world), ph::strict_bound{},
                                     late_loop<Latency>);
}

}  // namespace

TEST_CASE("friction credited as rigid loses 0.1 to 30 mJ within a presliding of 1 to 30 µm",
          "[adversaries][law]") {
  struct cell {
    double damping, friction, presliding, lost;
  };
  for (const auto& [b, c, p, lost] :
       {cell{0.5, 0.2, 1e-6, 1e-4}, cell{0.5, 0.2, 10e-6, 3e-3}, cell{0.5, 0.2, 30e-6, 15e-3},
        cell{0.03, 0.05, 1e-6, 2e-5}, cell{0.03, 0.05, 10e-6, 5e-4},
        cell{0.03, 0.05, 30e-6, 5e-3}}) {
    CAPTURE(b, c, p);
    const sim::circumstances world{.damping = b,
                                   .friction = c,
                                   .presliding = p,
                                   .softest = 300.0,
                                   .stiffest = 30e3,
                                   .ticks = 4000};
    const auto exact = counting_on(b, c);
    const double found = worst(exact, world, 30);
    CHECK(found < -lost);
    const auto without = following_half_space<d1>(ph::spring{}, ph::reduced_energy{.damping = b},
                                                  ph::strict_bound{});
    CHECK(worst(without, world, 10) >= -1e-12);  // the control: no credit for friction
    sim::circumstances rigid = world;
    rigid.presliding = 0.0;
    CHECK(worst(exact, rigid, 10) >= -1e-12);  // and rigid friction
  }
}

TEST_CASE("a ledger of steps that counts on rigid friction loses within a presliding, too",
          "[adversaries][law]") {
  const ph::dual_ledger ledger{.damping = {0.03, 0.2, 0.0}, .quantum = 10e-6};
  const auto model = following_half_space<d1>(ph::spring{}, ledger, ph::strict_bound{});
  const sim::circumstances world{.friction = 0.2,
                                 .presliding = 30e-6,
                                 .quantum = 10e-6,
                                 .softest = 300.0,
                                 .stiffest = 30e3,
                                 .ticks = 4000};
  CHECK(worst(model, world, 40) < -5e-4);
  sim::circumstances rigid = world;
  rigid.presliding = 0.0;
  CHECK(worst(model, rigid, 10) >= -1e-12);
}

TEST_CASE("elastic friction of any kind takes nothing from a ledger that does not count on it",
          "[adversaries][law]") {
  for (const auto kind : sim::all_friction_kinds) {
    CAPTURE(to_string(kind));
    const sim::circumstances world{.friction = 0.2, .presliding = 10e-6, .rubs_like = kind};
    survives(sim::challenge_encoders(strict<d1>, world, 5));
    survives_all(strict<d1>, world, 2);
    CHECK(worst(sim::challenge_encoders(counting_on(0.03, 0.2), world, 10)) < -1e-6);
  }
}

TEST_CASE("dual_ledger loses on a friction that forgets where it was reversed, which no p covers",
          "[adversaries][law]") {
  // docs/design/mathematics.md § 6
  sim::circumstances world{.friction = 0.2, .presliding = 30e-6, .softest = 300.0, .ticks = 20000};
  const auto model = following_half_space<d1>(
      ph::spring{}, ph::dual_ledger{.damping = {0.03, 0.2, 30e-6}}, ph::strict_bound{});
  CHECK(worst(model, world, 20) >= -1e-12);
  for (const auto forgets : {sim::friction_kind::dahl, sim::friction_kind::lugre}) {
    world.rubs_like = forgets;
    CHECK(worst(model, world, 20) < -1e-5);
  }
}

TEMPLATE_TEST_CASE("strict_bound on dual_ledger loses nothing to steps, noise and elastic friction",
                   "[adversaries][law]", d1, d3) {
  for (const double p : {5e-6, 20e-6}) {
    for (const sim::circumstances& world :
         {sim::circumstances{.friction = 0.2, .presliding = p, .quantum = 60e-6},
          sim::circumstances{.friction = 0.2, .presliding = p, .noise = 60e-6},
          sim::circumstances{.friction = 0.2, .presliding = p, .quantum = 10e-6}}) {
      CAPTURE(p, world.quantum, world.noise);
      const int runs = TestType::dof == 1 ? 12 : 4;
      survives(sim::challenge_encoders(dual<TestType>(world), world, runs));
      survives_all(dual<TestType>(world), world, 6);
      sim::circumstances late = world;
      late.latency = 2;
      survives(sim::challenge_encoders(dual<TestType, 2>(world), late, runs));
    }
  }
}

TEST_CASE("reachable_bound on dual_ledger loses nothing to a hand of limited force",
          "[adversaries][law]") {
  for (const double p : {5e-6, 30e-6}) {
    const sim::circumstances world{
        .friction = 0.2, .presliding = p, .hand_force = 3.0, .quantum = 60e-6};
    const auto with = [&world](double hand) {
      return following_half_space<d1>(ph::spring{}, told<d1>(world),
                                      ph::reachable_bound{.mass = 0.1, .hand_force = hand});
    };
    for (const auto by :
         {sim::adversary::tapping, sim::adversary::random_tapping, sim::adversary::trembling}) {
      CAPTURE(p, to_string(by));
      const auto one = sim::challenge(with(3.0 + 0.2), by, world, 30);
      CHECK(passes(one));
      CHECK(one.largest_force > 1.0);
    }
    // The control: a hand that it was not told of.
    sim::circumstances strong = world;
    strong.hand_force = 30.0;
    CHECK(sim::challenge(with(0.2), by::random_tapping, strong, 30).least_energy < -1e-6);
  }
}
