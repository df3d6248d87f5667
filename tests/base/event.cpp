// SPDX-License-Identifier: BSD-3-Clause
// Events: their order, their texts, their page.
#include "support/catch.hpp"
#include <passive_haptics/base/event.hpp>

#include <set>
#include <string>

namespace ph = passive_haptics;
using ph::event;

TEST_CASE("the worse of two events is the more severe, and a wall that is back the least of all",
          "[event]") {
  constexpr int last = static_cast<int>(event::wall_back);
  for (int i = 0; i <= last; ++i) {
    const auto e = static_cast<event>(i);
    CHECK(worse(e, event::nominal) == e);
    CHECK(worse(event::nominal, e) == e);
    CHECK(worse(e, event::forces_off) == event::forces_off);
    if (e == event::nominal) continue;
    CHECK(worse(event::wall_back, e) == e);
    CHECK(worse(e, event::wall_back) == e);
    if (e == event::wall_back) continue;
    CHECK(worse(event::started_inside, e) == e);
    CHECK(worse(e, event::started_inside) == e);
  }
  for (int i = 0; i < static_cast<int>(event::wrong_sign); ++i) {
    CHECK(worse(static_cast<event>(i), static_cast<event>(i + 1)) == static_cast<event>(i + 1));
  }
  CHECK(worse(event::debt, event::wall_lost) == event::wall_lost);
  CHECK(worse(event::wall_lost, event::debt) == event::wall_lost);
  CHECK(worse(event::late_tick, event::wall_lost) == event::late_tick);
  CHECK(worse(event::wall_lost, event::late_tick) == event::late_tick);
}

TEST_CASE("every event has a text of its own", "[event]") {
  std::set<std::string> texts;
  for (int i = 0; i <= static_cast<int>(event::wall_back); ++i) {
    texts.insert(to_string(static_cast<event>(i)));
  }
  CHECK(texts.size() == static_cast<std::size_t>(event::wall_back) + 1);
  CHECK(texts.count("unknown event") == 0);
  CHECK(std::string(to_string(static_cast<event>(99))) == "unknown event");
}

TEST_CASE("without the events that the observer adds, the short order is the same", "[event]") {
  for (int i = 0; i <= static_cast<int>(event::forces_off); ++i) {
    const auto a = static_cast<event>(i);
    for (int j = 0; j <= static_cast<int>(event::forces_off); ++j) {
      const auto b = static_cast<event>(j);
      CHECK(ph::detail::worse_yet(a, b) == worse(a, b));
    }
    CHECK(ph::detail::unusable(a) == worse(a, event::rejected_target));
  }
}

TEST_CASE("every guarantee has a text", "[event]") {
  using ph::guarantee;
  CHECK(std::string(to_string(guarantee::none)) == "none");
  CHECK(std::string(to_string(guarantee::conditional)) == "conditional");
  CHECK(std::string(to_string(guarantee::strict)) == "strict");
  CHECK(std::string(to_string(static_cast<guarantee>(3))) == "unknown guarantee");
}
