// SPDX-License-Identifier: BSD-3-Clause
// The Falcon's device over a scripted far side: its states, its gate for forces, and every fault of
// the cable. The far side holds the last motor words it got, so `far.last.motor` is what the hand
// feels.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include "support/scripted_falcon.hpp"
#include <passive_haptics/falcon/device.hpp>

#include <memory>

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using falcon::code;
using falcon::state;

namespace {

using cable = falcon::in_memory_transport<scripted_falcon>;
using grip = falcon::device<cable>;
using single_grip = falcon::device<cable, f3>;

static_assert(ph::haptic_device_for<grip, d3>);
static_assert(ph::haptic_device_for<single_grip, f3>);
static_assert(std::is_trivially_copyable_v<grip::reading_type>);

constexpr double k = falcon::cautious_gain<double>;
const d3::vector push(1.0, -0.5, 2.0);  // N
constexpr falcon::dac_words nothing{};

/// A device on the far side that runs and is homed, or what `legs` says.
struct bench {
  explicit bench(falcon::byte legs = 7, const falcon::settings<double>& setup = {})
      : device(k, setup), far(device.line().far()) {
    far.now = scripted_falcon::mode::running;
    far.homed = legs;
    REQUIRE(device.open());
    REQUIRE(device.boot({}).how);
  }

  auto exchange(const d3::vector& force = push) { return device.exchange(force); }

  /// Homed, and the ramp over.
  void warm_up() {
    for (int n = 0; n < 700; ++n) (void)exchange();
    REQUIRE(device.where() == state::homed);
    REQUIRE_THAT(device.latest().strength, WithinAbs(1.0, 0.0));
    REQUIRE(far.last.motor != nothing);
  }

  /// After a disturbance: zero in the next packets, then forces again, without help.
  void recovers(int within = 700) {
    (void)exchange();
    CHECK(far.last.motor == nothing);
    int n = 0;
    while (n < within && device.latest().strength < 1.0) {
      (void)exchange();
      ++n;
    }
    CHECK(device.where() == state::homed);
    CHECK(device.latest().what == code::ok);
    CHECK(far.last.motor != nothing);
  }

  grip device;
  scripted_falcon& far;
};

/// Spoils the next reply only.
void spoil_once(scripted_falcon& far, std::function<void(std::vector<falcon::byte>&)> how) {
  far.on_reply = [how](scripted_falcon& self, std::vector<falcon::byte>& bytes) {
    how(bytes);
    self.on_reply = nullptr;
  };
}

}  // namespace

TEST_CASE("the Falcon goes through its states, and each call says what it lacks",
          "[falcon][device]") {
  grip device{k};
  scripted_falcon& far = device.line().far();
  CHECK(device.where() == state::closed);
  CHECK_FALSE(device.exchange(push).valid);
  CHECK(device.latest().what == code::not_open);
  CHECK(device.boot({}).how.what == code::not_open);
  CHECK(device.home(std::chrono::seconds(1)).what == code::not_open);
  CHECK(device.close());

  REQUIRE(device.open());
  CHECK(device.where() == state::open);
  CHECK_FALSE(device.exchange(push).valid);
  const auto image = synthetic_image();
  std::vector<falcon::boot_step> steps;
  bool booting = true;
  const auto report = device.boot(image, {}, [&](falcon::boot_step s, std::size_t, std::size_t) {
    booting = booting && device.where() == state::booting;
    if (steps.empty() || steps.back() != s) steps.push_back(s);
    return true;
  });
  REQUIRE(report.how);
  CHECK(booting);
  using falcon::boot_step;
  CHECK(steps == std::vector{boot_step::probe, boot_step::hello, boot_step::loader,
                             boot_step::image, boot_step::program});
  CHECK(device.where() == state::unhomed);

  CHECK(device.home(std::chrono::milliseconds(100)).what == code::homing_timeout);
  CHECK(device.latest().what == code::not_homed);
  CHECK(far.last.light == falcon::lamps::red);
  far.homed = 7;
  CHECK(device.home(std::chrono::milliseconds(500)));
  CHECK(device.where() == state::homed);
  CHECK(device.exchange(push).valid);
  CHECK(far.last.light == falcon::lamps::green);
  CHECK(device.close());
  CHECK(device.where() == state::closed);
}

TEST_CASE("a boot that fails leaves the Falcon open, for another try", "[falcon][device]") {
  grip device{k};
  REQUIRE(device.open());
  CHECK(device.boot({}).how.what == code::image_missing);
  CHECK(device.where() == state::open);
  const auto image = synthetic_image();
  CHECK(device.boot(image).how);
  CHECK(device.where() == state::unhomed);
}

TEST_CASE("the Falcon tells where it is", "[falcon][device]") {
  bench b;
  b.far.encoder = {-300, 200, -100};
  for (int n = 0; n < 60; ++n) (void)b.exchange(d3::zero());
  const auto sample = b.exchange(d3::zero());
  REQUIRE(sample.valid);
  // falcon.md § 3.8, from an implementation that is independent of this one
  CHECK_THAT(sample.position[0], WithinAbs(-0.0150144419, 1e-8));
  CHECK_THAT(sample.position[1], WithinAbs(0.0104620264, 1e-8));
  CHECK_THAT(sample.position[2], WithinAbs(0.1298365120, 1e-8));
  CHECK_THAT(sample.dt, WithinAbs(1e-3, 2e-4));

  bench shifted(7, {.origin = falcon::workspace<double>.centre});
  for (int n = 0; n < 60; ++n) (void)shifted.exchange(d3::zero());
  CHECK_THAT(shifted.exchange(d3::zero()).position[2], WithinAbs(0.1346024284 - 0.125, 1e-8));
}

TEST_CASE("no force before homing, and then a ramp", "[falcon][device]") {
  bench b(0);
  for (int n = 0; n < 200; ++n) {
    CHECK_FALSE(b.exchange().valid);
    if (b.far.last.motor != nothing) FAIL(n);
  }
  b.far.homed = 5;  // two legs are not enough
  for (int n = 0; n < 200; ++n) (void)b.exchange();
  CHECK(b.device.where() == state::unhomed);
  CHECK(b.far.last.motor == nothing);

  b.far.homed = 7;
  int last = 0, first_force = -1, full = -1;
  for (int n = 0; n < 800; ++n) {
    const bool valid = b.exchange().valid;
    const int word = std::abs(b.far.last.motor[0]);
    if (word > 0 && first_force < 0) first_force = n;
    if (b.device.latest().strength >= 1.0 && full < 0) full = n;
    if (word > 0 && !valid) FAIL("a force without a position at " << n);
    if (word < last || word > last + 10) FAIL("from " << last << " to " << word << " at " << n);
    last = word;
  }
  CHECK(first_force > 50);
  CHECK(full > 540);
  CHECK(full < 560);
  // on the axis at count 0: words −k τ of falcon.md § 3.8, by superposition
  const std::array<double, 3> tau{.0193043 + 0.5 * .0639972 + 2 * .0249384,
                                  -.0650753 - 0.5 * .0152805 + 2 * .0249384,
                                  .0457710 - 0.5 * .0487166 + 2 * .0249384};
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK_THAT(static_cast<double>(b.far.last.motor[i]), WithinAbs(-k * tau[i], 0.51));
  }
}

TEST_CASE("the force held is that of the words of the packet before", "[falcon][device]") {
  bench b;
  b.warm_up();
  for (const double newton : {0.0, 1.0, 2.0, 3.0, 0.5}) {
    const auto before = b.device.latest().sent.motor;
    const auto sample = b.exchange({0, 0, newton});
    // z force on the axis: all torques are 0.0249384 N·m per newton
    const double expected = -(before[0] + before[1] + before[2]) / 3.0 / k / 0.0249384;
    CHECK_THAT(sample.held[2], WithinAbs(expected, 1e-3));
  }
}

TEST_CASE("forces are limited in norm, then in words, and never wrap", "[falcon][device]") {
  const d3::vector direction = d3::vector(1.0, 2.0, -1.5).normalized();
  const auto words_at = [&direction](double newton, double gain, double limit) {
    grip device(gain, {.force_limit = limit});
    device.line().far().now = scripted_falcon::mode::running;
    device.line().far().homed = 7;
    REQUIRE(device.open());
    REQUIRE(device.boot({}).how);
    for (int n = 0; n < 700; ++n) (void)device.exchange(newton * direction);
    return device.line().far().last.motor;
  };
  CHECK(words_at(1e9, k, 8.0) == words_at(8.0, k, 8.0));
  CHECK(words_at(1e300, k, 8.0) == words_at(8.0, k, 8.0));
  CHECK(words_at(7.0, k, 8.0) != words_at(8.0, k, 8.0));
  // a gain at which 1000 N would be 100 times the range: one factor for all three
  const auto huge = words_at(1e3, 1e4, 1e6), small = words_at(1.0, 1e4, 1e6);
  int largest = 0;
  for (const int word : huge) largest = std::max(largest, std::abs(word));
  CHECK(largest == falcon::largest_word);
  for (std::size_t i = 1; i < 3; ++i) {
    CHECK_THAT(double(huge[i]) / huge[0], WithinAbs(double(small[i]) / small[0], 5e-3));
  }
}

TEST_CASE("a command that is not finite is a fault, until recover()", "[falcon][device]") {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    for (int axis = 0; axis < 3; ++axis) {
      bench b;
      b.warm_up();
      d3::vector force = push;
      force(axis) = bad;
      const auto sample = b.exchange(force);
      CHECK(b.far.last.motor == nothing);
      CHECK(b.device.where() == state::fault);
      CHECK(b.device.latest().what == code::force_not_finite);
      CHECK(sample.valid);  // the position is as good as ever
      for (int n = 0; n < 100; ++n) (void)b.exchange();
      CHECK(b.far.last.motor == nothing);
      CHECK(b.device.where() == state::fault);
      CHECK(b.device.recover());
      b.recovers();
    }
  }
}

TEST_CASE("every fault of the cable ends with zero force, and recovers where it can",
          "[falcon][device]") {
  bench b;
  b.warm_up();
  auto& far = b.far;

  SECTION("the control: without a fault the force stays") {
    const auto words = far.last.motor;
    for (int n = 0; n < 100; ++n) CHECK(b.exchange().valid);
    CHECK(far.last.motor == words);
  }
  SECTION("a lost reply") {
    spoil_once(far, [](auto& bytes) { bytes.clear(); });
    CHECK_FALSE(b.exchange().valid);
    CHECK(b.device.latest().what == code::timeout);
    CHECK(b.device.where() == state::homed);
    CHECK(b.device.latest().counts.misses == 1);
    CHECK(far.last.motor == nothing);  // at once, in the same call
    b.recovers();
  }
  SECTION("an extra byte at any offset") {
    for (std::size_t at = 0; at <= falcon::packet_size; ++at) {
      for (const int extra : {0x00, 0x3C, 0x3E, 0x41, 0x50, 0xFF}) {
        spoil_once(far, [=](auto& bytes) {
          bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                       static_cast<falcon::byte>(extra));
        });
        const bool read = b.exchange().valid;
        INFO("byte " << extra << " at " << at);
        CHECK((read || far.last.motor == nothing));
        CHECK(b.exchange().valid);  // the next one is good again
        CHECK(b.device.where() == state::homed);
      }
    }
    for (int n = 0; n < 600; ++n) (void)b.exchange();
    CHECK(far.last.motor != nothing);
  }
  SECTION("a short packet") {
    for (std::size_t at = 0; at < falcon::packet_size; ++at) {
      spoil_once(far, [=](auto& bytes) { bytes.erase(bytes.begin() + std::ptrdiff_t(at)); });
      CHECK_FALSE(b.exchange().valid);
      CHECK(far.last.motor == nothing);
      CHECK(b.exchange().valid);
    }
    b.recovers();
  }
  SECTION("two replies in one transfer") {
    spoil_once(far, [](auto& bytes) {
      const auto copy = bytes;
      bytes.insert(bytes.end(), copy.begin(), copy.end());
    });
    CHECK(b.exchange().valid);
    CHECK(b.device.latest().counts.stale == 1);
    CHECK(far.last.motor != nothing);
    CHECK(b.exchange().valid);
  }
  SECTION("nothing but status packets") {
    far.on_reply = [](scripted_falcon& self, auto& bytes) {
      bytes.clear();
      self.out.control(falcon::request::latency_timer, 0);  // as fast as the bus goes
    };
    for (int n = 0; n < 5; ++n) CHECK_FALSE(b.exchange().valid);
    CHECK(b.device.latest().what == code::timeout);
    CHECK(far.last.motor == nothing);
    far.on_reply = nullptr;
    far.out.control(falcon::request::latency_timer, 1);
    b.recovers();
  }
  SECTION("a long silence is a fault") {
    far.on_reply = [](scripted_falcon&, auto& bytes) { bytes.clear(); };
    for (int n = 0; n < 19; ++n) (void)b.exchange();
    CHECK(b.device.where() == state::homed);
    (void)b.exchange();
    CHECK(b.device.where() == state::fault);
    CHECK(b.device.latest().what == code::too_many_misses);
    CHECK(far.last.motor == nothing);
    CHECK(b.device.recover());
    (void)b.exchange();  // the old misses are forgiven: one more is no fault
    CHECK(b.device.where() == state::unhomed);
    for (int n = 0; n < 20; ++n) (void)b.exchange();
    CHECK(b.device.where() == state::fault);
    far.on_reply = nullptr;
    for (int n = 0; n < 100; ++n) (void)b.exchange();
    CHECK(b.device.where() == state::fault);  // it does not come back by itself
    CHECK(far.last.motor == nothing);
    CHECK(b.device.recover());
    b.recovers();
  }
  SECTION("homed bits that drop") {
    for (const falcon::byte left : {falcon::byte(0), falcon::byte(3), falcon::byte(6)}) {
      far.homed = left;
      CHECK_FALSE(b.exchange().valid);
      CHECK(far.last.motor == nothing);
      CHECK(b.device.where() == state::unhomed);
      CHECK(b.device.latest().what == code::not_homed);
      far.homed = 7;
      CHECK_FALSE(b.exchange().valid);
      CHECK(b.device.latest().what == code::settling);
      b.recovers();
    }
  }
  SECTION("an encoder that jumps") {
    far.encoder[1] = 600;
    CHECK_FALSE(b.exchange().valid);
    CHECK(b.device.latest().what == code::encoder_jump);
    CHECK(b.device.where() == state::unhomed);
    CHECK(far.last.motor == nothing);
    for (int n = 0; n < 48; ++n) CHECK_FALSE(b.exchange().valid);
    b.recovers();
  }
  SECTION("a flipped bit in a nibble") {
    spoil_once(far, [](auto& bytes) { bytes[4] = 'I'; });  // + 0x8000 counts
    CHECK_FALSE(b.exchange().valid);
    CHECK(b.device.latest().what == code::encoder_jump);
    CHECK(far.last.motor == nothing);
    b.recovers();
  }
  SECTION("encoders that fit no position") {
    const auto all_legs = [&far](int count) {
      const auto word = static_cast<std::int16_t>(count);
      far.encoder = {word, word, word};
    };
    for (int count = 0; count <= 1800; count += 290) {  // slowly, so that it is no jump
      all_legs(count);
      (void)b.exchange();
    }
    CHECK(b.device.latest().what == code::pose_refused);
    CHECK(b.device.where() == state::homed);
    CHECK(far.last.motor == nothing);
    for (int count = 1740; count >= 0; count -= 290) {
      all_legs(count);
      (void)b.exchange();
    }
    for (int n = 0; n < 700; ++n) (void)b.exchange();
    CHECK(b.device.latest().what == code::ok);
    CHECK(far.last.motor != nothing);
  }
  SECTION("unplugged") {
    far.plugged = false;
    const auto sample = b.exchange();
    CHECK_FALSE(sample.valid);
    CHECK(b.device.where() == state::fault);
    CHECK(b.device.latest().what == code::unplugged);
    CHECK(b.device.recover().what == code::unplugged);
    CHECK_FALSE(b.exchange().valid);
    CHECK(b.device.open().what == code::no_device);
    CHECK(b.device.where() == state::closed);
    far.plugged = true;
    CHECK(b.device.open());
    CHECK(b.device.boot({}).how);
    (void)b.exchange();
    CHECK(far.last.motor == nothing);
    b.warm_up();
  }
}

TEST_CASE("an encoder jump at the moment of homing reaches nobody", "[falcon][device]") {
  for (const int delay : {0, 1, 5, 30}) {  // replies between the bits and the new origin
    bench b(0);
    b.far.encoder = {700, 650, 720};
    for (int n = 0; n < 20; ++n) (void)b.exchange();
    b.far.homed = 7;
    for (int n = 0; n < delay; ++n) CHECK_FALSE(b.exchange().valid);
    b.far.encoder = {-900, -950, -920};
    int first = -1;
    for (int n = 0; n < 200; ++n) {
      const auto sample = b.exchange();
      if (b.far.last.motor != nothing && first < 0) FAIL("a force before a position");
      if (!sample.valid) continue;
      first = n;
      CHECK(sample.position[2] < 0.1);  // the new origin's
      break;
    }
    CHECK(first >= 49);
  }
}

TEST_CASE("a late answer is never taken for the next one", "[falcon][device]") {
  std::vector<falcon::byte> late;
  long n = 0;
  bench b;  // its destructor closes the device, which asks once more
  b.warm_up();
  b.far.on_reply = [&](scripted_falcon& self, std::vector<falcon::byte>& bytes) {
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
  bench b;
  b.warm_up();
  b.far.on_reply = [&](scripted_falcon&, std::vector<falcon::byte>& bytes) {
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
  bench b;
  b.warm_up();
  const auto bytes = falcon::encode(falcon::from_device{.encoder = {77, 77, 77}, .homed = 7});
  std::string flood;  // as much as fits a transfer, so that the true answer is in the next
  for (int n = 0; n < 31; ++n) flood.append(bytes.begin(), bytes.end());
  SECTION("before a question") {
    b.far.emit(flood);
    CHECK(b.exchange().valid);
    CHECK(b.device.latest().received.encoder[0] == 0);
    CHECK(b.device.latest().counts.stale == 31);
  }
  SECTION("after a miss") {
    spoil_once(b.far, [](auto& reply) { reply.clear(); });
    CHECK_FALSE(b.exchange().valid);
    b.far.late = flood;
    b.far.late_at = b.far.clock + std::chrono::milliseconds(1);
    CHECK(b.exchange().valid);
    CHECK(b.device.latest().received.encoder[0] == 0);
  }
}

TEST_CASE("unplugging in each state ends in a documented one", "[falcon][device]") {
  SECTION("closed") {
    grip device{k};
    device.line().far().plugged = false;
    CHECK(device.open().what == code::no_device);
    CHECK(device.where() == state::closed);
  }
  SECTION("open") {
    grip device{k};
    REQUIRE(device.open());
    device.line().far().plugged = false;
    CHECK(device.boot(synthetic_image()).how.what == code::unplugged);
    CHECK(device.where() == state::open);
    CHECK(device.close());
  }
  SECTION("unhomed") {
    bench b(0);
    b.far.plugged = false;
    (void)b.exchange();
    CHECK(b.device.where() == state::fault);
    CHECK(b.device.home(std::chrono::seconds(1)).what == code::unplugged);
  }
  SECTION("fault") {
    bench b;
    b.warm_up();
    (void)b.exchange({0, 0, std::nan("")});
    b.far.plugged = false;
    (void)b.exchange();
    CHECK(b.device.where() == state::fault);
    CHECK(b.device.latest().what == code::unplugged);
  }
}

TEST_CASE("closing and destroying leave the motors at zero", "[falcon][device]") {
  SECTION("close") {
    bench b;
    b.warm_up();
    CHECK(b.device.close());
    CHECK(b.far.last.motor == nothing);
    CHECK_FALSE(b.exchange().valid);
  }
  SECTION("close says when the cable is out") {
    bench b;
    b.warm_up();
    b.far.plugged = false;
    (void)b.exchange();
    CHECK(b.device.close().what == code::unplugged);
    CHECK(b.device.where() == state::closed);
    CHECK(b.device.close());  // there is nothing left to close
  }
  SECTION("close says when nobody confirms it") {
    bench b;
    b.warm_up();
    b.far.on_reply = [](scripted_falcon&, auto& bytes) { bytes.clear(); };
    CHECK(b.device.close().what == code::timeout);
    CHECK(b.far.last.motor == nothing);
  }
  SECTION("destruction") {
    struct witness : scripted_falcon {
      falcon::dac_words* seen;
      explicit witness(falcon::dac_words* s) : seen(s) {}
      void receive(std::span<const falcon::byte> bytes) {
        scripted_falcon::receive(bytes);
        *seen = last.motor;
      }
    };
    falcon::dac_words seen{};
    {
      falcon::device<falcon::in_memory_transport<witness>> device{k, {}, &seen};
      device.line().far().now = scripted_falcon::mode::running;
      device.line().far().homed = 7;
      REQUIRE(device.open());
      REQUIRE(device.boot({}).how);
      for (int n = 0; n < 700; ++n) (void)device.exchange(push);
      CHECK(seen != nothing);
    }
    CHECK(seen == nothing);
  }
}

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

TEST_CASE("homing can be watched and cancelled, lamps can be your own", "[falcon][device]") {
  bench b(0);
  int seen = 0;
  CHECK(b.device
            .home(std::chrono::seconds(1),
                  [&seen](const auto& now) {
                    CHECK(now.what == code::not_homed);
                    return ++seen < 5;
                  })
            .what == code::cancelled);
  CHECK(seen == 5);
  b.device.light(falcon::lamps::blue | falcon::lamps::red);
  (void)b.exchange();
  CHECK(b.far.last.light == (falcon::lamps::blue | falcon::lamps::red));
  b.device.light(std::nullopt);
  (void)b.exchange();
  CHECK(b.far.last.light == falcon::lamps::red);
}

TEST_CASE("in single precision the Falcon commands the same, within a count", "[falcon][device]") {
  bench b;
  single_grip single{falcon::cautious_gain<float>};
  auto& far = single.line().far();
  far.now = scripted_falcon::mode::running;
  far.homed = 7;
  REQUIRE(single.open());
  REQUIRE(single.boot({}).how);
  double apart = 0.0;
  for (int n = 0; n < 1500; ++n) {
    far.encoder =
        b.far.encoder = {static_cast<std::int16_t>(n / 5), 30, static_cast<std::int16_t>(-n / 9)};
    const auto fine = b.exchange();
    const auto coarse = single.exchange(push.cast<float>());
    REQUIRE(fine.valid == coarse.valid);
    for (std::size_t i = 0; i < 3; ++i) {
      apart = std::max(apart, std::abs(fine.position[i] - double(coarse.position[i])));
      if (std::abs(far.last.motor[i] - b.far.last.motor[i]) > 1) FAIL(n);
    }
  }
  CHECK(far.last.motor != nothing);
  CHECK(apart < 1e-6);  // m
  CHECK(apart > 0.0);
}

TEST_CASE("a local model takes the Falcon as it is", "[falcon][device]") {
  bench b(0);
  ph::local_model wall{d3{},
                       ph::rigid{ph::half_space<d3>{{0, 0, 0.14}, {0, 0, 1}, 800.0}},
                       ph::snap<d3>{},
                       ph::spring<d3>{},
                       ph::reduced_energy<d3>{.damping = 1.0, .energy = 0.02},
                       ph::strict_bound<d3, 1>{}};
  d3::vector force = d3::zero();
  double pressed = 0.0;
  for (int n = 0; n < 1500; ++n) {
    if (n == 100) b.far.homed = 7;
    if (n > 100 && n < 700) b.far.encoder[0] = static_cast<std::int16_t>(n % 3);
    const auto out = wall.tick(b.exchange(force));
    if (n < 149) CHECK(out.what == ph::event::rejected_sample);
    CHECK(out.energy >= 0.0);
    force = out.force;
    pressed = std::max(pressed, force(2));
  }
  CHECK(pressed > 1.0);
  CHECK(b.device.where() == state::homed);
}
