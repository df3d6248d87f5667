// SPDX-License-Identifier: BSD-3-Clause
// two_port/two_port.cpp at length and in every space.
#include "support/catch.hpp"
#include "two_port/attacks.hpp"

using namespace two_ends;

TEMPLATE_TEST_CASE("the two-port never creates energy, whatever hand, environment and channel do",
                   "[two_port][passivity]", d1, d2, d3) {
  for (const auto kind : {world::wild, world::wall}) {
    tally controlled, bare;
    for (std::uint64_t seed = 1; seed <= 400; ++seed) {
      controlled.count(attack<TestType, true>(kind, seed));
      bare.count(attack<TestType, false>(kind, seed));
    }
    INFO("world " << static_cast<int>(kind));
    CHECK(controlled.least >= -1e-12);
    CHECK(controlled.least_ledger >= -1e-12);
    CHECK(controlled.hands >= 100);         // energy did flow, both ways:
    CHECK(controlled.environments >= 100);  // silence would be passive too
    CHECK(bare.losing >= 100);              // and without the controllers it is created
    CHECK(bare.least < -1.0);
  }
}

TEMPLATE_TEST_CASE("both sides work in every space, as values that can be stored as bytes",
                   "[two_port]", d1, d2, d3, f1, f2, f3) {
  using scalar = typename TestType::scalar;
  static_assert(std::is_trivially_copyable_v<packet_of<TestType>>);
  static_assert(std::is_trivially_copyable_v<ph::admittance_side<TestType>>);
  static_assert(std::is_trivially_copyable_v<ph::two_port_series_controller<TestType>>);
  tally wild;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    wild.count(attack<TestType, true>(world::wild, seed));
  }
  // In float the sums are rounded, and the positions measured are not the true ones.
  UNSCOPED_INFO(wild.least_ledger);
  CHECK(wild.least >= (std::is_same_v<scalar, float> ? -1e-5 : -1e-12));
  CHECK(wild.hands > 0);
}
