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
