// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"

TEST_CASE("spring is K d inside and nothing outside (2.18)", "[contact]") {
  ph::spring::on<d1> law({});
  law.adopt(1e4, 1e-3);
  CHECK(law.force(1e-3, 0.0) == 10.0);
  CHECK(law.force(1e-3, 5.0) == 10.0);
  CHECK(law.force(-1e-3, 0.0) == 0.0);
  CHECK(law.depth(10.0, 0.0) == 1e-3);
}
