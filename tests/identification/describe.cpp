// SPDX-License-Identifier: BSD-3-Clause
// What is printed to be pasted compiles, and says what was found: no bound is rounded beyond it.
#include "support/catch.hpp"
#include <passive_haptics/device/eigen_space.hpp>
#include <passive_haptics/identification/describe.hpp>
#include <passive_haptics/passive_haptics.hpp>

#include <fstream>
#include <sstream>

namespace ph = passive_haptics;
using namespace ph::identification;
using Catch::Matchers::WithinRel;

namespace {

device_found<2> grip() {
  device_found<2> found{.force_limit = 3.0, .drift = 0.0};
  found.axes[0] = {.mass = 0.12345,
                   .damping = 0.0987654,
                   .friction = 0.14,
                   .presliding = 15e-6,
                   .quantum = 10e-6,
                   .noise = 3e-6,
                   .latency = 2,
                   .longest_tick = 1e-3};
  found.axes[1] = found.axes[0];
  found.axes[1].mass = 0.2;
  found.axes[1].friction = 0.1329;
  found.axes[1].latency = 1;
  return found;
}

}  // namespace

TEST_CASE("the composition that is printed is the one that compiles here", "[identification]") {
#include "pasted.inc"
  CHECK_FALSE(wall.check());
  CHECK(decltype(wall)::passivity == ph::guarantee::conditional);  // reachable_bound
  std::ifstream file(PASSIVE_HAPTICS_TEST_DATA "/../identification/pasted.inc");
  std::ostringstream pasted;
  pasted << file.rdbuf();
  REQUIRE_FALSE(pasted.str().empty());
  const std::string printed = composition_of(grip());
  CHECK(printed.substr(0, pasted.str().size()) == pasted.str());
  CHECK(printed.find("walls of up to ") != std::string::npos);
}

TEST_CASE("a bound is rounded to its own side", "[identification]") {
  using ph::identification::detail::rounded;
  CHECK_THAT(rounded(0.12399, false), WithinRel(0.123, 1e-12));
  CHECK_THAT(rounded(0.12301, true), WithinRel(0.124, 1e-12));
  CHECK_THAT(rounded(1e-5, true), WithinRel(1e-5, 1e-12));
  CHECK(rounded(0.0, true) == 0.0);
}

TEST_CASE("a device without friction, steps or damping gets the ledger it can have, or none",
          "[identification]") {
  auto found = grip();
  found.axes[0].friction = 0.0;
  CHECK(composition_of(found).find("ph::quantised_energy{") != std::string::npos);
  for (auto& a : found.axes) a.quantum = a.noise = 0.0;
  CHECK(composition_of(found).find("ph::exact_device device{") != std::string::npos);
  found.axes[1].damping = 0.0;
  CHECK(composition_of(found).find("no viscous damping") != std::string::npos);
  CHECK(composition_of(found).find("ph::make_touch") == std::string::npos);
  found.axes[0].problem = "let go";
  CHECK(composition_of(found) == "let go\n");
  CHECK(table_of(found.axes[0]).find("let go") != std::string::npos);
}

TEST_CASE("what is stated of a device holds on every axis", "[identification]") {
  const auto stated = grip().stated();
  CHECK(stated.mass == 0.12345);
  CHECK(stated.friction == 0.1329);
  CHECK_THAT(stated.presliding, WithinRel(15e-6 * std::sqrt(2.0), 1e-12));
  CHECK_THAT(stated.quantum, WithinRel(13e-6, 1e-12));
  CHECK_THAT(stated.longest_tick, WithinRel(1.2e-3, 1e-12));
  CHECK(grip().latency() == 2);
  auto drifting = grip();
  drifting.drift = 0.3;
  CHECK_THAT(drifting.stated().friction, WithinRel(0.7 * stated.friction, 1e-12));
  CHECK_THAT(drifting.stated().damping, WithinRel(0.7 * stated.damping, 1e-12));
  CHECK(drifting.stated().mass == stated.mass);
  CHECK(composition_of(drifting).find("less 30 % of damping and friction") != std::string::npos);
}
