// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "two_port/attacks.hpp"

using namespace two_ends;

TEMPLATE_TEST_CASE("the two-port creates no energy in a hundred runs, and without it they do",
                   "[two_port][passivity]", d1, d3) {
  for (const auto kind : {world::wild, world::wall}) {
    tally controlled, bare;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
      controlled.count(attack<TestType, true>(kind, seed));
      bare.count(attack<TestType, false>(kind, seed));
    }
    CAPTURE(static_cast<int>(kind));
    CHECK(controlled.least >= -1e-12);
    CHECK(controlled.least_ledger >= -1e-12);
    CHECK(controlled.hands >= 25);
    CHECK(controlled.environments >= 25);
    CHECK(bare.losing >= 25);
    CHECK(bare.least < -1.0);
  }
}
