// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"

TEST_CASE("turn_at_once takes the environment's normal at once", "[normal]") {
  const d3::vector a(0, 0, 1), b(1, 0, 0);
  CHECK(ph::part_at<ph::turn_at_once, d3>({}).step(a, b, 1e-3) == b);
  static_assert(ph::turn_at_once::on<d1>({}).step(1.0, -1.0, 1e-3) == -1.0);
}
