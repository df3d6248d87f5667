// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include <passive_haptics/falcon/geometry.hpp>

namespace falcon = passive_haptics::falcon;

TEST_CASE("counts and angles belong together", "[falcon]") {
  for (int n = -3000; n <= 3000; ++n) {
    REQUIRE(falcon::to_counts(falcon::to_angles<double>({n, -n, 0})) == falcon::counts{n, -n, 0});
    REQUIRE(falcon::to_counts(falcon::to_angles<float>({n, -n, 0})) == falcon::counts{n, -n, 0});
  }
}
