// SPDX-License-Identifier: BSD-3-Clause
// Events: their order, their texts, their page.
#include "support/catch.hpp"
#include <passive_haptics/base/event.hpp>

#include <set>
#include <string>

namespace ph = passive_haptics;
using ph::event;

TEST_CASE("the worse of two events is the more severe, and a start inside the least of all",
          "[event]") {
  constexpr int last = static_cast<int>(event::forces_off);
  for (int i = 0; i <= last; ++i) {
    const auto e = static_cast<event>(i);
    CHECK(worse(e, event::nominal) == e);
    CHECK(worse(event::nominal, e) == e);
    CHECK(worse(e, event::forces_off) == event::forces_off);
    if (e != event::nominal) CHECK(worse(event::started_inside, e) == e);
    if (e != event::nominal) CHECK(worse(e, event::started_inside) == e);
  }
  for (int i = 0; i < static_cast<int>(event::wrong_sign); ++i) {
    CHECK(worse(static_cast<event>(i), static_cast<event>(i + 1)) == static_cast<event>(i + 1));
  }
}

TEST_CASE("every event has a text of its own", "[event]") {
  std::set<std::string> texts;
  for (int i = 0; i <= static_cast<int>(event::forces_off); ++i) {
    texts.insert(to_string(static_cast<event>(i)));
  }
  CHECK(texts.size() == static_cast<std::size_t>(event::forces_off) + 1);
  CHECK(texts.count("unknown event") == 0);
  CHECK(std::string(to_string(static_cast<event>(99))) == "unknown event");
}
