// SPDX-License-Identifier: BSD-3-Clause
// attacks/several_walls.cpp at length, and how much it costs to do it otherwise.
#include "attacks/several_walls.hpp"

using namespace simulated;

namespace {

constexpr int runs = 40;

/// How many adversaries win, and what the worst of them gets [J]: to a factor, because a hand that
/// taps on a simulated device does so in another way with other rounding.
void loses(const losses& found, int adversaries, double worst) {
  CHECK(found.adversaries >= adversaries);
  CHECK(found.worst < worst / 3.0);
  CHECK(found.worst > worst * 3.0);
}

}  // namespace

TEMPLATE_TEST_CASE("two walls in one port lose nothing to any adversary", "[adversaries][law]", d1,
                   d2, d3) {
  const auto strictly = one_port<TestType, 2>();
  const auto reachable = one_port<TestType, 2>(ph::reachable_bound{.mass = 0.1, .hand_force = 5});
  const auto loose = one_port<TestType, 2>(ph::no_bound{});
  for (const auto how : two_walls) {
    CAPTURE(static_cast<int>(how));
    survives(attacked<TestType, 2>(strictly, how, runs));
    for (const by adversary : {by::tapping, by::random_tapping}) {
      const lay_walls<TestType, 2> lay{how};
      survives(std::array{sim::challenge(reachable, adversary, {}, runs, 1, lay)});
      CHECK(sim::challenge(loose, adversary, {}, runs, 1, lay).least_energy < -1e-3);  // control
    }
  }
}

TEST_CASE("three walls that meet in a corner, in one port, lose nothing to any adversary",
          "[adversaries][law]") {
  const auto reachable = one_port<d3, 3>(ph::reachable_bound{.mass = 0.1, .hand_force = 5});
  for (const auto how : {arrangement::corner, arrangement::twice}) {
    survives(attacked<d3, 3>(one_port<d3, 3>(), how, runs));
    for (const by adversary : {by::tapping, by::random_tapping}) {
      const lay_walls<d3, 3> lay{how};
      survives(std::array{sim::challenge(reachable, adversary, {}, runs, 1, lay)});
    }
  }
}

TEST_CASE("a local model for each wall loses, because all of them spend the same damping",
          "[adversaries]") {
  using how = arrangement;
  loses(lost(model_each<d1, 2>{0.03}, how::facing, runs), 12, -0.060);
  loses(lost(model_each<d2, 2>{0.03}, how::facing, runs), 12, -0.049);
  loses(lost(model_each<d3, 2>{0.03}, how::facing, runs), 12, -0.054);
  loses(lost(model_each<d1, 2>{0.03}, how::twice, runs), 12, -0.023);
  loses(lost(model_each<d2, 2>{0.03}, how::twice, runs), 12, -0.022);
  loses(lost(model_each<d3, 2>{0.03}, how::twice, runs), 12, -0.024);
  loses(lost(model_each<d2, 2>{0.03}, how::corner, runs), 7, -0.004);
  loses(lost(model_each<d3, 2>{0.03}, how::corner, runs), 7, -0.010);
  loses(lost(model_each<d3, 3>{0.03}, how::corner, runs), 7, -0.007);
  loses(lost(model_each<d3, 3>{0.03}, how::twice, runs), 12, -0.042);
}

TEST_CASE("local models that share out the damping among them lose nothing", "[adversaries][law]") {
  for (const auto how : two_walls) {
    survives(attacked<d1, 2>(model_each<d1, 2>{0.015}, how, runs));
    survives(attacked<d3, 2>(model_each<d3, 2>{0.015}, how, runs));
  }
  survives(attacked<d3, 3>(model_each<d3, 3>{0.01}, arrangement::corner, runs));
}
