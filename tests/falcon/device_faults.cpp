// SPDX-License-Identifier: BSD-3-Clause
// The Falcon's device and every fault of its cable: zero force, then forces again where it can.
#include "falcon/bench.hpp"

TEST_CASE("a command that is not finite is a fault, until recover()", "[falcon][device]") {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    for (int axis = 0; axis < 3; ++axis) {
      falcon_bench b;
      b.warm_up();
      d3::vector force = push;
      force(axis) = bad;
      const auto sample = b.exchange(force);
      CHECK(b.box.last.motor == nothing);
      CHECK(b.device.where() == state::fault);
      CHECK(b.device.latest().what == code::force_not_finite);
      CHECK(sample.valid);  // the position is as good as ever
      for (int n = 0; n < 100; ++n) (void)b.exchange();
      CHECK(b.box.last.motor == nothing);
      CHECK(b.device.where() == state::fault);
      CHECK(b.device.recover());
      b.recovers();
    }
  }
}

TEST_CASE("every fault of the cable ends with zero force, and recovers where it can",
          "[falcon][device]") {
  falcon_bench b;
  b.warm_up();
  auto& box = b.box;

  SECTION("the control: without a fault the force stays") {
    const auto words = box.last.motor;
    for (int n = 0; n < 100; ++n) CHECK(b.exchange().valid);
    CHECK(box.last.motor == words);
  }
  SECTION("a lost reply") {
    spoil_once(box, [](auto& bytes) { bytes.clear(); });
    CHECK_FALSE(b.exchange().valid);
    CHECK(b.device.latest().what == code::timeout);
    CHECK(b.device.where() == state::homed);
    CHECK(b.device.latest().counts.misses == 1);
    CHECK(box.last.motor == nothing);  // at once, in the same call
    b.recovers();
  }
  SECTION("an extra byte at any offset") {
    for (std::size_t at = 0; at <= falcon::packet_size; ++at) {
      for (const int extra : {0x00, 0x3C, 0x3E, 0x41, 0x50, 0xFF}) {
        spoil_once(box, [=](auto& bytes) {
          bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                       static_cast<falcon::byte>(extra));
        });
        const bool read = b.exchange().valid;
        INFO("byte " << extra << " at " << at);
        CHECK((read || box.last.motor == nothing));
        CHECK(b.exchange().valid);  // the next one is good again
        CHECK(b.device.where() == state::homed);
      }
    }
    for (int n = 0; n < 600; ++n) (void)b.exchange();
    CHECK(box.last.motor != nothing);
  }
  SECTION("a short packet") {
    for (std::size_t at = 0; at < falcon::packet_size; ++at) {
      spoil_once(box, [=](auto& bytes) { bytes.erase(bytes.begin() + std::ptrdiff_t(at)); });
      CHECK_FALSE(b.exchange().valid);
      CHECK(box.last.motor == nothing);
      CHECK(b.exchange().valid);
    }
    b.recovers();
  }
  SECTION("two replies in one transfer") {
    spoil_once(box, [](auto& bytes) {
      const auto copy = bytes;
      bytes.insert(bytes.end(), copy.begin(), copy.end());
    });
    CHECK(b.exchange().valid);
    CHECK(b.device.latest().counts.stale == 1);
    CHECK(box.last.motor != nothing);
    CHECK(b.exchange().valid);
  }
  SECTION("nothing but status packets") {
    box.on_reply = [](scripted_falcon& self, auto& bytes) {
      bytes.clear();
      self.out.control(falcon::request::latency_timer, 0);  // as fast as the bus goes
    };
    for (int n = 0; n < 5; ++n) CHECK_FALSE(b.exchange().valid);
    CHECK(b.device.latest().what == code::timeout);
    CHECK(box.last.motor == nothing);
    box.on_reply = nullptr;
    box.out.control(falcon::request::latency_timer, 1);
    b.recovers();
  }
  SECTION("a long silence is a fault") {
    box.on_reply = [](scripted_falcon&, auto& bytes) { bytes.clear(); };
    for (int n = 0; n < 19; ++n) (void)b.exchange();
    CHECK(b.device.where() == state::homed);
    (void)b.exchange();
    CHECK(b.device.where() == state::fault);
    CHECK(b.device.latest().what == code::too_many_misses);
    CHECK(box.last.motor == nothing);
    CHECK(b.device.recover());
    (void)b.exchange();  // the old misses are forgiven: one more is no fault
    CHECK(b.device.where() == state::unhomed);
    for (int n = 0; n < 20; ++n) (void)b.exchange();
    CHECK(b.device.where() == state::fault);
    box.on_reply = nullptr;
    for (int n = 0; n < 100; ++n) (void)b.exchange();
    CHECK(b.device.where() == state::fault);  // it does not come back by itself
    CHECK(box.last.motor == nothing);
    CHECK(b.device.recover());
    b.recovers();
  }
  SECTION("homed bits that drop") {
    for (const falcon::byte left : {falcon::byte(0), falcon::byte(3), falcon::byte(6)}) {
      box.homed = left;
      CHECK_FALSE(b.exchange().valid);
      CHECK(box.last.motor == nothing);
      CHECK(b.device.where() == state::unhomed);
      CHECK(b.device.latest().what == code::not_homed);
      box.homed = 7;
      CHECK_FALSE(b.exchange().valid);
      CHECK(b.device.latest().what == code::settling);
      b.recovers();
    }
  }
  SECTION("an encoder that jumps") {
    box.encoder[1] = 600;
    CHECK_FALSE(b.exchange().valid);
    CHECK(b.device.latest().what == code::encoder_jump);
    CHECK(b.device.where() == state::unhomed);
    CHECK(box.last.motor == nothing);
    for (int n = 0; n < 48; ++n) CHECK_FALSE(b.exchange().valid);
    b.recovers();
  }
  SECTION("a flipped bit in a nibble") {
    spoil_once(box, [](auto& bytes) { bytes[4] = 'I'; });  // + 0x8000 counts
    CHECK_FALSE(b.exchange().valid);
    CHECK(b.device.latest().what == code::encoder_jump);
    CHECK(box.last.motor == nothing);
    b.recovers();
  }
  SECTION("encoders that fit no position") {
    const auto all_legs = [&box](int count) {
      const auto word = static_cast<std::int16_t>(count);
      box.encoder = {word, word, word};
    };
    for (int count = 0; count <= 1800; count += 290) {  // slowly, so that it is no jump
      all_legs(count);
      (void)b.exchange();
    }
    CHECK(b.device.latest().what == code::pose_refused);
    CHECK(b.device.where() == state::homed);
    CHECK(box.last.motor == nothing);
    for (int count = 1740; count >= 0; count -= 290) {
      all_legs(count);
      (void)b.exchange();
    }
    for (int n = 0; n < 700; ++n) (void)b.exchange();
    CHECK(b.device.latest().what == code::ok);
    CHECK(box.last.motor != nothing);
  }
  SECTION("unplugged") {
    box.plugged = false;
    const auto sample = b.exchange();
    CHECK_FALSE(sample.valid);
    CHECK(b.device.where() == state::fault);
    CHECK(b.device.latest().what == code::unplugged);
    CHECK(b.device.recover().what == code::unplugged);
    CHECK_FALSE(b.exchange().valid);
    CHECK(b.device.open().what == code::no_device);
    CHECK(b.device.where() == state::closed);
    box.plugged = true;
    CHECK(b.device.open());
    CHECK(falcon::boot(b.device, {}).how);
    (void)b.exchange();
    CHECK(box.last.motor == nothing);
    b.warm_up();
  }
}

TEST_CASE("unplugging in each state ends in a documented one", "[falcon][device]") {
  SECTION("closed") {
    grip device{k};
    device.line().peer().plugged = false;
    CHECK(device.open().what == code::no_device);
    CHECK(device.where() == state::closed);
  }
  SECTION("open") {
    grip device{k};
    REQUIRE(device.open());
    device.line().peer().plugged = false;
    CHECK(falcon::boot(device, synthetic_image()).how.what == code::unplugged);
    CHECK(device.where() == state::open);
    CHECK(device.close());
  }
  SECTION("unhomed") {
    falcon_bench b(0);
    b.box.plugged = false;
    (void)b.exchange();
    CHECK(b.device.where() == state::fault);
    CHECK(b.device.home(std::chrono::seconds(1)).what == code::unplugged);
  }
  SECTION("fault") {
    falcon_bench b;
    b.warm_up();
    (void)b.exchange({0, 0, std::nan("")});
    b.box.plugged = false;
    (void)b.exchange();
    CHECK(b.device.where() == state::fault);
    CHECK(b.device.latest().what == code::unplugged);
  }
}
