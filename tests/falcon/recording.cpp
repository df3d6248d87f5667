// SPDX-License-Identifier: BSD-3-Clause
#include "falcon/session.hpp"

#include <cstring>

namespace {

using replayed = falcon::device<falcon::replay_transport>;

falcon::boot_options no_boot() {
  falcon::boot_options options;
  options.policy = falcon::firmware_policy::assume_running;
  return options;
}

}  // namespace

TEST_CASE("a replay gives every sample, force and state again, to the bit", "[falcon][recording]") {
  const taken original = record();
  CHECK(original.rows.size() > 2500);
  replayed device{k, {}, std::span(original.rows)};
  REQUIRE(device.open());
  REQUIRE(falcon::boot(device, {}, no_boot()).how);
  const auto again = session(device, [](int) {});
  REQUIRE(again.size() == original.result.size());
  CHECK(std::memcmp(again.data(), original.result.data(), again.size() * sizeof(double)) == 0);
  CHECK(device.line().divergences() == 0);
  CHECK(device.line().finished());
  CHECK_FALSE(device.exchange(d3::zero()).valid);  // the end of the log
  CHECK(device.latest().what == code::unplugged);
}

TEST_CASE("a driver that decides otherwise diverges from the log, and is told where",
          "[falcon][recording]") {
  const taken original = record();
  replayed device{2 * k, {}, std::span(original.rows)};
  REQUIRE(device.open());
  REQUIRE(falcon::boot(device, {}, no_boot()).how);
  (void)session(device, [](int) {});
  CHECK(device.line().divergences() > 100);
  REQUIRE(device.line().first_divergence() > 400);  // no force before homing: the same till then
  CHECK(device.line().first_divergence() < 700);
}

TEST_CASE("a full recorder says so, and no firmware gets into a log", "[falcon][recording]") {
  const auto image = synthetic_image();
  recorded device{k, {}, std::size_t(300)};
  REQUIRE(device.open());
  device.line().record(true);
  REQUIRE(falcon::boot(device, image).how);
  std::size_t longest = 0;
  for (const auto& row : device.line().rows()) {
    if (row.what == falcon::wire_row::call::write && row.count > 0) {
      longest = std::max<std::size_t>(longest, row.count);
      CHECK(row.bytes[0] == '<');
    }
  }
  CHECK(longest == falcon::packet_size);
  CHECK(device.line().complete());
  for (int n = 0; n < 300; ++n) (void)device.exchange(d3::zero());
  CHECK(device.line().complete().what == code::log_full);
  CHECK(device.line().rows().size() == 300);
}
