// SPDX-License-Identifier: BSD-3-Clause
#include "falcon/bench.hpp"

TEST_CASE("an encoder jump at the moment of homing reaches nobody", "[falcon][device]") {
  for (const int delay : {0, 1, 5, 30}) {  // replies between the bits and the new origin
    falcon_bench b(0);
    b.box.encoder = {700, 650, 720};
    for (int n = 0; n < 20; ++n) (void)b.exchange();
    b.box.homed = 7;
    for (int n = 0; n < delay; ++n) CHECK_FALSE(b.exchange().valid);
    b.box.encoder = {-900, -950, -920};
    int first = -1;
    for (int n = 0; n < 200; ++n) {
      const auto sample = b.exchange();
      if (b.box.last.motor != nothing && first < 0) FAIL("a force before a position");
      if (!sample.valid) continue;
      first = n;
      CHECK(sample.position[2] < 0.1);  // the new origin's
      break;
    }
    CHECK(first >= 49);
  }
}
