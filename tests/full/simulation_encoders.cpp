// SPDX-License-Identifier: BSD-3-Clause
// simulation/adversary_encoders.cpp at length.
#include "simulation/challenged.hpp"

#include <algorithm>

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
