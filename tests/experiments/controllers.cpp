// SPDX-License-Identifier: BSD-3-Clause
// The bench that judges the controllers, judged: its verdicts can go wrong, and its numbers are known.
#include "controllers.hpp"

#include "../bench/controllers/tables.hpp"
#include "support/catch.hpp"

#include <set>

using namespace controllers;
using Catch::Matchers::WithinRel;

TEST_CASE("every controller has a name and a file name of its own, and parameters in range",
          "[controllers]") {
  std::set<std::string> names, files;
  for (const auto& c : catalogue()) {
    INFO(c.name);
    CHECK(names.insert(c.name).second);
    CHECK(files.insert(z_plot_name(c.name)).second);
    CHECK_FALSE(mentions(c.name, "\""));  // a cell of a CSV file, and a string of gnuplot
    CHECK_FALSE(mentions(c.name, "'"));
    CHECK_FALSE(c.composition.empty());
    std::vector<premises> told{premises{}, premises{.quantum = 60e-6, .wall_damping = 1.0}};
    for (const auto& scene : wall_scenes()) told.push_back(known_of(scene));
    for (const auto& p : told) {
      CHECK_FALSE(c.in<d1>()(p).check());
      if (c.in<d2>()) CHECK_FALSE(c.in<d2>()(p).check());
      if (c.in<d3>()) CHECK_FALSE(c.in<d3>()(p).check());
    }
  }
}

TEST_CASE("the tag of an entry is that of its type", "[controllers]") {
  CHECK(named("none").tag == ph::guarantee::none);
  CHECK(named("thesis").tag == ph::guarantee::none);
  CHECK(named("reachable").tag == ph::guarantee::conditional);
  CHECK(named("strict FBA").tag == ph::guarantee::strict);
  CHECK(named("PSPM + strict FBA").tag == ph::guarantee::strict);
  CHECK(lying<ph::guarantee::conditional>("x").tag == ph::guarantee::conditional);
}

TEST_CASE("S0 and S2 agree with section 5 in every row that is not explained, S1 in peak to peak",
          "[controllers]") {
  std::set<std::string> explained;
  for (const auto& scene : wall_scenes()) {
    if (scene.name == "S5") continue;
    for (const auto& p : section_5()) {
      if (p.scene != scene.name) continue;
      const wall_row row = judge_on_wall(named(p.controller), scene, {.runs = 3});
      INFO(scene.name << ": " << p.controller);
      if (scene.name == "S1") {
        CHECK_THAT(row.mean.peak_to_peak * 1e3, WithinRel(p.peak_to_peak_mm, 0.1));
      } else if (agreement(row, p) != "yes") {
        CHECK(agreement(row, p) == p.reason);
        explained.insert(p.controller);
      }
    }
  }
  CHECK(explained == std::set<std::string>{"PSPM as published", "tank + level controller"});
}

TEST_CASE("a row that is off is called off, unless the seeds reach it", "[controllers]") {
  wall_row row;
  row.mean.peak_to_peak = 50e-3;
  row.mean.force_error = 1.0;
  row.least = row.most = row.mean;
  CHECK(agreement(row, {"x", "S0", 54.0, 1.05}) == "yes");
  CHECK(agreement(row, {"x", "S0", 60.0, 1.05}) == "NO");
  CHECK(agreement(row, {"x", "S0", 54.0, 1.5}) == "NO");
  CHECK(agreement(row, {"x", "S0", 54.0, 1.5, "a reason"}) == "a reason");
  row.most.force_error = 1.6;
  CHECK(agreement(row, {"x", "S1", 54.0, 1.5}) == "within the seeds");
}

TEST_CASE("a slow hand feels 2b/T of a strict bound, b/T of EBA, and all of an unbounded wall",
          "[controllers]") {
  CHECK_THAT(displayed_stiffness(named("strict FBA")), WithinRel(60.0, 0.01));  // L4
  CHECK_THAT(displayed_stiffness(named("EBA")), WithinRel(30.0, 0.01));
  CHECK_THAT(displayed_stiffness(named("none")), WithinRel(1e4, 0.02));
}

TEST_CASE("a conditional tag must hold where it covers and lose where it does not",
          "[controllers]") {
  const auto judged = [](const controller& c) {
    std::vector<attack_row> rows;
    for (const auto& a : attacks()) rows.push_back(judge_under_attack(c, a, 1, {.runs = 4}));
    return contradictions(rows);
  };
  const auto inside = judged(lying<ph::guarantee::conditional>("liar"));
  REQUIRE_FALSE(inside.empty());
  CHECK(mentions(inside.front(), "against tapping in 1 DOF: lost "));
  CHECK(judged(named("reachable")).empty());  // the control
}

TEST_CASE("what never loses and never pushes is found as well", "[controllers]") {
  attack_row row{"x", ph::guarantee::none, "y", 1, 1, false, 0.0, 5.0, 1};
  CHECK(contradictions({row}).size() == 1);  // nothing lost: promise more
  row.tag = ph::guarantee::conditional;
  CHECK(contradictions({row}).size() == 1);
  row.least_energy = -1e-3;
  CHECK(contradictions({row}).empty());
  row.covered = true;
  CHECK(contradictions({row}).size() == 2);  // lost inside, and nothing outside
  row.tag = ph::guarantee::strict;
  row.least_energy = -1e-13;
  CHECK(contradictions({row}).empty());
  row.least_energy = std::nan("");
  CHECK(contradictions({row}).size() == 1);
  row.least_energy = 0.0;
  row.largest_force = 0.0;
  CHECK(contradictions({row}).size() == 1);
}

TEST_CASE("the stiffness sweep reproduces the published row without a bound, and strict gives none",
          "[controllers]") {
  const std::vector<std::pair<double, double>> row{
      {500, 3.1e-3}, {1000, 6.6e-3}, {2000, 19e-3}, {8000, 109e-3}, {16000, 320e-3}};
  for (const auto& [K, energy] : row) {
    const auto unbounded = judge_on_stiffness(named("none"), K);
    CHECK_THAT(unbounded.out_of_wall, WithinRel(energy, 0.1));
    CHECK_FALSE(unbounded.covered);
    const auto strict = judge_on_stiffness(named("strict FBA"), K);
    CHECK(strict.out_of_port <= 1e-12);
    CHECK(strict.covered);
  }
}

TEST_CASE("without a bound the Z-width is Colgate's region, and stability Gil and Hulin's line",
          "[controllers]") {
  const double b = 0.03, T = 1e-3;
  const z_grid grid = grid_of(true);
  int passive = 0, unstable = 0;
  for (int i = 0; i < grid.dampings; ++i) {
    for (int k = 0; k < grid.stiffnesses; ++k) {
      const double B = grid.damping(i), K = grid.stiffness(k);
      const z_row r = judge_z({&named("none"), B, K});
      INFO(B << ' ' << K);
      CHECK((passive_for(r) == 2) == (b > K * T / 2 + B));
      passive += passive_for(r) == 2 ? 1 : 0;
      if (B <= 1.0) CHECK(stable(r) == (K < 2 * (b + B) / T));  // at larger B the mass matters
      unstable += stable(r) ? 0 : 1;
      CHECK(passive_for(judge_z({&named("strict FBA"), B, K})) == 2);
    }
  }
  CHECK(passive > 0);
  CHECK(unstable > 0);
  for (const double B : {0.001, 0.01, 0.02}) {  // sharply
    const double line = 2 * (b - B) / T;
    CHECK(passive_for(judge_z({&named("none"), B, 0.99 * line})) == 2);
    CHECK(passive_for(judge_z({&named("none"), B, 1.01 * line})) < 2);
  }
}
