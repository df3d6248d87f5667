// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include <passive_haptics/environment/marks.hpp>

TEST_CASE("marks are there until they are cleared, all of them before the first time",
          "[environment]") {
  passive_haptics::environment::marks marks(3);
  for (int i = 0; i < 3; ++i) CHECK(marks.has(i));
  CHECK_FALSE(marks.add(1));
  for (int round = 0; round < 3; ++round) {
    marks.clear();
    for (int i = 0; i < 3; ++i) CHECK_FALSE(marks.has(i));
    CHECK(marks.add(1));
    CHECK_FALSE(marks.add(1));
    CHECK(marks.has(1));
    CHECK_FALSE(marks.has(0));
    CHECK_FALSE(marks.has(2));
  }
}
