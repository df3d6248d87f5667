// SPDX-License-Identifier: BSD-3-Clause
#include "falcon/bench.hpp"

#include <cmath>
#include <string>

TEST_CASE("bad settings name themselves and open nothing", "[falcon][device]") {
  const auto refused = [](double gain, const falcon::settings<double>& setup, const char* name) {
    grip device{gain, setup};
    const auto fault = device.check();
    REQUIRE(fault);
    CHECK(std::string(fault.parameter) == name);
    CHECK(device.open().what == code::bad_setting);
    CHECK(device.where() == state::closed);
  };
  refused(0.0, {}, "gain");
  refused(-3500.0, {}, "gain");
  refused(std::nan(""), {}, "gain");
  refused(k, {.force_limit = 0.0}, "force_limit");
  refused(k, {.ramp = -1.0}, "ramp");
  refused(k, {.tick = HUGE_VAL}, "tick");
  refused(k, {.largest_step = 0}, "largest_step");
  refused(k, {.settle = 0}, "settle");
  refused(k, {.most_misses = 0}, "most_misses");
  refused(k, {.reply = falcon::nanoseconds(0)}, "reply");
  refused(k, {.origin = {{0, std::nan(""), 0}}}, "origin");
  CHECK_FALSE(grip{k}.check());
}
