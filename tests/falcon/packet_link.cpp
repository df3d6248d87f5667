// SPDX-License-Identifier: BSD-3-Clause
// Which answer belongs to which question.
#include "falcon/bench.hpp"

TEST_CASE("a late answer is never taken for the next one", "[falcon][device]") {
  std::vector<falcon::byte> late;
  long n = 0;
  falcon_bench b;  // its destructor closes the device, which asks once more
  b.warm_up();
  b.box.on_reply = [&](scripted_falcon& self, std::vector<falcon::byte>& bytes) {
    ++n;
    self.encoder[0] = static_cast<std::int16_t>(n);  // in the NEXT reply
    if (n == 50) {
      late = bytes;
      bytes.clear();
    } else if (n == 51 || n == 52) {  // the zero packet's answer, or the next question's
      bytes.insert(bytes.begin(), late.begin(), late.end());
      late.clear();
    }
  };
  for (int i = 0; i < 200; ++i) {
    const long asked = n;
    if (b.exchange().valid && b.device.latest().received.encoder[0] != asked) FAIL(i);
  }
  CHECK(b.device.latest().counts.misses == 1);
  CHECK(b.device.latest().counts.stale >= 1);
}

TEST_CASE("the second half of a late answer is noise, not an answer", "[falcon][device]") {
  std::vector<falcon::byte> rest;
  int n = 0;
  falcon_bench b;
  b.warm_up();
  b.box.on_reply = [&](scripted_falcon&, std::vector<falcon::byte>& bytes) {
    ++n;
    if (n == 50) {
      rest.assign(bytes.begin() + 8, bytes.end());
      bytes.resize(8);
    } else if (n == 51) {  // answers the zero packet
      bytes.clear();
    } else if (n == 52) {
      bytes.insert(bytes.begin(), rest.begin(), rest.end());
    }
  };
  int invalid = 0;
  for (int i = 0; i < 100; ++i) invalid += b.exchange().valid ? 0 : 1;
  CHECK(invalid == 1);
  CHECK(b.device.latest().counts.stale == 0);
}

TEST_CASE("what comes unasked is thrown away, before a question and after a miss",
          "[falcon][device]") {
  falcon_bench b;
  b.warm_up();
  const auto bytes = falcon::encode(falcon::from_device{.encoder = {77, 77, 77}, .homed = 7});
  std::string flood;  // as much as fits a transfer, so that the true answer is in the next
  for (int n = 0; n < 31; ++n) flood.append(bytes.begin(), bytes.end());
  SECTION("before a question") {
    b.box.emit(flood);
    CHECK(b.exchange().valid);
    CHECK(b.device.latest().received.encoder[0] == 0);
    CHECK(b.device.latest().counts.stale == 31);
  }
  SECTION("after a boot whose first probe was answered late") {
    int packets = 0;
    b.box.on_reply = [&](scripted_falcon& self, std::vector<falcon::byte>& reply) {
      ++packets;  // a zero packet, the first probe, the second
      if (packets == 2) reply.clear();
      if (packets == 3) {  // the first's answer; the second's is in what follows
        self.late = flood;
        self.late_at = self.clock + std::chrono::microseconds(500);
      }
    };
    CHECK(falcon::boot(b.device, {}).how);
    b.box.on_reply = nullptr;
    CHECK(packets == 3);
    CHECK(b.box.late.empty());
    (void)b.exchange();
    CHECK(b.device.latest().received.encoder[0] == 0);
    CHECK(b.device.latest().counts.stale == 0);
  }
  SECTION("after a miss") {
    spoil_once(b.box, [](auto& reply) { reply.clear(); });
    CHECK_FALSE(b.exchange().valid);
    b.box.late = flood;
    b.box.late_at = b.box.clock + std::chrono::milliseconds(1);
    CHECK(b.exchange().valid);
    CHECK(b.device.latest().received.encoder[0] == 0);
  }
}
