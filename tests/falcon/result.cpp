// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include <passive_haptics/falcon/result.hpp>

#include <array>
#include <string>

namespace falcon = passive_haptics::falcon;

TEST_CASE("every code has a text, and every failure of the user's a remedy", "[falcon]") {
  for (int c = 0; c <= static_cast<int>(falcon::code::log_full); ++c) {
    CHECK(std::string(falcon::to_string(static_cast<falcon::code>(c))) != "unknown code");
  }
  CHECK(std::string(falcon::to_string(static_cast<falcon::code>(200))) == "unknown code");
  std::array<char, 160> text{};
  CHECK(std::string(falcon::describe({falcon::code::echo_mismatch, 77}, text)) ==
        "the loader echoed another byte (77): power the device off and on; try another port or a "
        "powered hub");
  CHECK(std::string(falcon::describe({}, text)) == "ok");
  std::array<char, 8> short_text{};
  CHECK(std::string(falcon::describe({falcon::code::no_hello}, short_text)) == "the mon");
}
