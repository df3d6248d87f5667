// SPDX-License-Identifier: BSD-3-Clause
// The real libusb against an emulated Falcon. Needs umockdev; skips itself outside of its wrapper.
#include "support/catch.hpp"
#include "usb/emulated_falcon.hpp"
#include <passive_haptics/falcon/boot.hpp>
#include <passive_haptics/falcon/runner.hpp>
#include <passive_haptics/falcon_hid.hpp>

#include <cstdio>
#include <cstdlib>

using falcon::code;
using falcon::state;

namespace {

using grip = falcon::device<falcon::libusb_transport>;
using vector = grip::vector;

constexpr double k = falcon::cautious_gain<double>;
constexpr falcon::dac_words nothing{};
const vector push(1.0, -0.5, 2.0);  // N

/// Every system call is a round trip to the emulator, slow under sanitizers and on a busy machine, and
/// an answer that is given up is a miss: wait for as long as it takes.
constexpr falcon::settings<double> patient{
    .ramp = 0.02, .settle = 10, .most_misses = 3, .reply = std::chrono::seconds(20)};

falcon::boot_options patiently() {
  falcon::boot_options options;
  options.attempts = 3;
  options.probe = {.questions = 2, .reply = std::chrono::milliseconds(600)};
  options.hellos = 3;
  options.answer = std::chrono::seconds(5);
  return options;
}

bool emulated() {
  static const bool inside = [] {  // it looks at /sys, which is another only while a bed is there
    UMockdevTestbed* bed = umockdev_testbed_new();
    const bool in = umockdev_in_mock_environment() != FALSE;
    g_object_unref(bed);
    return in;
  }();
  if (inside) return true;
  WARN("skipped: not run under umockdev-wrapper");
  return false;
}

void run(emulated_falcon& bus, falcon::byte legs) {
  bus.with([legs](scripted_falcon& far) {
    far.now = scripted_falcon::mode::running;
    far.homed = legs;
  });
}

void warm_up(grip& device) {
  for (int n = 0; n < 200 && device.latest().strength < 1.0; ++n) (void)device.exchange(push);
  REQUIRE(device.where() == state::homed);
}

falcon::dac_words motors(emulated_falcon& bus) {
  return bus.with([](scripted_falcon& far) { return far.last.motor; });
}

void unplug(emulated_falcon& bus) {
  bus.with([](scripted_falcon& far) { far.plugged = false; });
}

}  // namespace

TEST_CASE("libusb finds the Falcon, by index and by serial number", "[usb]") {
  if (!emulated()) return;
  std::array<falcon::listed_device, 4> found;
  CHECK(falcon::list_devices(found) == 0);  // the control
  {
    emulated_falcon bus;
    REQUIRE(falcon::list_devices(found) == 1);
    CHECK(found[0].openable);
    CHECK(std::string(found[0].serial.data()) == "EMU001");
    CHECK(found[0].bus == 1);
    CHECK(found[0].address == 2);
    falcon::libusb_transport usb;
    CHECK(usb.open());
    CHECK(usb.is_open());
    CHECK(usb.open({.index = 1}).what == code::no_device);
    CHECK_FALSE(usb.is_open());
    CHECK(usb.open({.serial = "EMU001"}));
    CHECK(usb.open({.serial = "EMU002"}).what == code::no_device);
  }
  falcon::libusb_transport usb;
  CHECK(usb.open().what == code::no_device);
}

TEST_CASE("over libusb: boot, home, a thousand exchanges, close", "[usb]") {
  if (!emulated()) return;
  emulated_falcon bus;
  bus.with([](scripted_falcon& far) { far.leading_zero = true; });
  const auto image = synthetic_image();
  {
    grip device{k, patient};
    REQUIRE(device.open());
    const auto report = falcon::boot(device, image, patiently());
    INFO(falcon::to_string(report.how.what) << " at " << falcon::to_string(report.step));
    REQUIRE(report.how);
    CHECK(report.clear_to_send);
    CHECK(bus.with([](scripted_falcon& far) { return far.image; }) == image);
    CHECK(device.where() == state::unhomed);
    (void)device.exchange(push);
    CHECK(motors(bus) == nothing);
    bus.with([](scripted_falcon& far) { far.homed = 7; });
    CHECK(device.home(std::chrono::seconds(20)));
    warm_up(device);
    CHECK(motors(bus) != nothing);

    falcon::nanoseconds last = device.latest().stamp;
    const auto before = device.latest().counts;
    int valid = 0;
    for (int n = 0; n < 1000; ++n) {
      const auto count = static_cast<std::int16_t>(n % 200);
      bus.with([count](scripted_falcon& far) { far.encoder = {count, 0, 0}; });
      const auto sample = device.exchange(push);
      valid += sample.valid ? 1 : 0;
      if (!sample.valid) FAIL("exchange " << n << ": " << falcon::to_string(device.latest().what));
      if (device.latest().received.encoder[0] != count) FAIL("an answer to another question");
      if (!(sample.dt > 0.0) || device.latest().stamp <= last) FAIL("no time has passed");
      last = device.latest().stamp;
    }
    CHECK(valid == 1000);
    CHECK(device.latest().counts.replies == before.replies + 1000);
    CHECK(device.latest().counts.misses == before.misses);
    CHECK(device.close());
    CHECK(motors(bus) == nothing);

    // and again: its program is still there
    REQUIRE(device.open());
    CHECK(falcon::boot(device, {}, patiently()).how);
    warm_up(device);
    CHECK(motors(bus) != nothing);
  }
  CHECK(motors(bus) == nothing);  // destroyed
}

TEST_CASE("over libusb: a silent device is a timeout, then a fault, then back", "[usb]") {
  if (!emulated()) return;
  emulated_falcon bus;
  run(bus, 7);
  auto quick = patient;
  quick.reply = std::chrono::milliseconds(500);
  grip device{k, quick};
  REQUIRE(device.open());
  REQUIRE(falcon::boot(device, {}, patiently()).how);
  warm_up(device);
  bus.with([](scripted_falcon& far) {
    far.on_reply = [](scripted_falcon&, auto& bytes) { bytes.clear(); };
  });
  CHECK_FALSE(device.exchange(push).valid);
  CHECK(device.latest().what == code::timeout);
  (void)device.exchange(push);
  CHECK(motors(bus) == nothing);
  for (int n = 0; n < 3; ++n) (void)device.exchange(push);
  CHECK(device.where() == state::fault);
  bus.with([](scripted_falcon& far) { far.on_reply = nullptr; });
  CHECK(device.recover());
  warm_up(device);
  (void)device.exchange(push);
  CHECK(motors(bus) != nothing);
}

TEST_CASE("over libusb: several packets in a transfer, status bytes in each", "[usb]") {
  if (!emulated()) return;
  emulated_falcon bus;
  run(bus, 7);
  falcon::libusb_transport usb;
  REQUIRE(usb.open());
  REQUIRE(usb.control(falcon::request::latency_timer, 1));
  std::string sent;
  for (int i = 0; i < 700; ++i) sent += static_cast<char>('a' + i % 26);
  bus.with([&sent](scripted_falcon& far) { far.emit(sent); });
  std::string got;
  std::array<falcon::byte, 100> part{};
  while (got.size() < sent.size()) {
    const auto transfer = usb.read(part, usb.now() + std::chrono::seconds(20));
    if (!transfer.how) FAIL(falcon::to_string(transfer.how.what));
    got.append(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(transfer.bytes));
  }
  CHECK(got == sent);
  CHECK(usb.lines().line == 0x60);
}

TEST_CASE("over libusb: a runner in its thread, while we look on, until the cable is out",
          "[usb]") {
  if (!emulated()) return;
  emulated_falcon bus;
  run(bus, 7);
  grip device{k, patient};
  REQUIRE(device.open());
  REQUIRE(falcon::boot(device, {}, patiently()).how);
  falcon::runner touch{device,
                       [](const auto& sample) { return vector(0, 0, sample.valid ? 1.0 : 0.0); }};
  REQUIRE(touch.start());
  std::uint64_t ticks = 0;
  bool pushed = false, pulled = false;
  while (touch.running()) {
    if (const auto* news = touch.take()) {
      ticks = news->counts.ticks;
      pushed = pushed || news->reading.sent.motor != nothing;
    }
    if (ticks >= 200 && !pulled) {
      unplug(bus);
      pulled = true;
    }
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  touch.stop();
  CHECK(ticks >= 200);
  CHECK(pushed);
  CHECK(device.latest().what == code::unplugged);
}

TEST_CASE("over libusb: unplugged in each state", "[usb]") {
  if (!emulated()) return;
  emulated_falcon bus;
  grip device{k, patient};
  SECTION("closed") {
    unplug(bus);
    CHECK_FALSE(device.open());
    CHECK(device.where() == state::closed);
  }
  SECTION("open") {
    REQUIRE(device.open());
    unplug(bus);
    CHECK(falcon::boot(device, synthetic_image(), patiently()).how.what == code::unplugged);
    CHECK(device.where() == state::open);
  }
  SECTION("booting, at the probe") {
    REQUIRE(device.open());
    bus.with([](scripted_falcon& far) { far.unplug_after = far.calls + 8; });
    CHECK(falcon::boot(device, synthetic_image(), patiently()).how.what == code::unplugged);
  }
  SECTION("booting, at the image") {
    REQUIRE(device.open());
    bus.with([](scripted_falcon& far) { far.unplug_after = far.calls + 28; });
    const auto report = falcon::boot(device, synthetic_image(), patiently());
    CHECK(report.how.what == code::unplugged);
    CHECK(report.step == falcon::boot_step::image);
  }
  SECTION("unhomed") {
    run(bus, 0);
    REQUIRE(device.open());
    REQUIRE(falcon::boot(device, {}, patiently()).how);
    unplug(bus);
    CHECK_FALSE(device.exchange(push).valid);
    CHECK(device.where() == state::fault);
    CHECK(device.latest().what == code::unplugged);
  }
  SECTION("homed") {
    run(bus, 7);
    REQUIRE(device.open());
    REQUIRE(falcon::boot(device, {}, patiently()).how);
    warm_up(device);
    unplug(bus);
    CHECK_FALSE(device.exchange(push).valid);
    CHECK(device.where() == state::fault);
    CHECK(device.latest().what == code::unplugged);
    CHECK(device.recover().what == code::unplugged);
  }
  SECTION("fault") {
    run(bus, 7);
    REQUIRE(device.open());
    REQUIRE(falcon::boot(device, {}, patiently()).how);
    (void)device.exchange({0, 0, std::nan("")});
    CHECK(device.where() == state::fault);
    unplug(bus);
    (void)device.exchange(push);
    CHECK(device.latest().what == code::unplugged);
  }
  const bool motors_unknown = device.where() == state::fault;
  CHECK(device.close().what == (motors_unknown ? code::unplugged : code::ok));
  CHECK(device.where() == state::closed);
}
