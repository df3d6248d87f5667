// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scratch_folder.hpp"
#include "support/scripted_falcon.hpp"
#include <passive_haptics/falcon/boot.hpp>

#include <cstdio>
#include <string>

namespace {
using cable = falcon::in_memory_transport<scripted_falcon>;
}  // namespace

TEST_CASE("a device without a program gets one, byte for byte", "[falcon][boot]") {
  const auto image = synthetic_image();
  cable line;
  REQUIRE(line.open());
  const auto report = falcon::bootloader{line, std::span(image)}.run();
  CHECK(report.how.what == falcon::code::ok);
  CHECK(report.attempts == 1);
  CHECK(report.echoed == image.size());
  CHECK(report.clear_to_send);
  CHECK(line.peer().now == scripted_falcon::mode::running);
  CHECK(line.peer().image == image);
}

TEST_CASE("the policy says whether to probe and whether to load", "[falcon][boot]") {
  using falcon::firmware_policy;
  const auto image = synthetic_image();
  const auto boot = [&image](firmware_policy policy, bool running) {
    cable line;
    REQUIRE(line.open());
    if (running) line.peer().now = scripted_falcon::mode::running;
    falcon::boot_options options;
    options.policy = policy;
    const auto report = falcon::bootloader{line, std::span(image), options}.run();
    return std::pair(report.how.what, line.peer().loads);
  };
  using falcon::code;
  CHECK(boot(firmware_policy::probe_then_load, true) == std::pair(code::ok, 0L));
  CHECK(boot(firmware_policy::probe_then_load, false) == std::pair(code::ok, 1L));
  CHECK(boot(firmware_policy::always_load, true) == std::pair(code::ok, 1L));
  CHECK(boot(firmware_policy::never_load, true) == std::pair(code::ok, 0L));
  CHECK(boot(firmware_policy::never_load, false) == std::pair(code::no_program, 0L));
  CHECK(boot(firmware_policy::assume_running, false) == std::pair(code::ok, 0L));
}

TEST_CASE("every fault of a boot ends in its code, or is overcome", "[falcon][boot]") {
  using falcon::code;
  const auto image = synthetic_image(200);
  falcon::boot_options options;
  options.attempts = 3;
  cable line;
  REQUIRE(line.open());
  scripted_falcon& box = line.peer();
  const auto boot = [&] { return falcon::bootloader{line, std::span(image), options}.run(); };

  SECTION("no hello") {
    box.deaf_hellos = 1000;
    CHECK(boot().how.what == code::no_hello);
    CHECK(boot().step == falcon::boot_step::hello);
  }
  SECTION("some hellos unanswered") {
    box.deaf_hellos = 7;
    CHECK(boot().how.what == code::ok);
  }
  SECTION("a leading zero") {
    box.leading_zero = true;
    CHECK(boot().how.what == code::ok);
    CHECK(box.image == image);
  }
  SECTION("a loader that does not lock on") {
    box.mute_loader = true;
    const auto report = boot();
    CHECK(report.how.what == code::no_loader);
    CHECK(report.attempts == 3);
  }
  SECTION("late CTS is waited for") {
    box.insists_on_cts = true;
    box.cts_after = std::chrono::milliseconds(150);
    const auto report = boot();
    CHECK(report.how.what == code::ok);
    CHECK(report.clear_to_send);
    CHECK(report.attempts == 1);
  }
  SECTION("without CTS the loader is called all the same") {
    box.cts_after = std::chrono::hours(1);
    const auto report = boot();
    CHECK(report.how.what == code::ok);
    CHECK_FALSE(report.clear_to_send);
  }
  SECTION("a wrong echo of any byte") {
    for (std::size_t at = 0; at < image.size(); ++at) {
      box.wrong_echo_at = static_cast<long>(at);
      const auto report = boot();
      if (report.how.what != code::echo_mismatch) FAIL("byte " << at);
      if (report.how.value != static_cast<std::int64_t>(at)) FAIL("byte " << at);
      box.now = scripted_falcon::mode::off;
    }
  }
  SECTION("a wrong echo once") {
    box.wrong_echo_at = 77;
    box.broken_loads = 1;
    const auto report = boot();
    CHECK(report.how.what == code::ok);
    CHECK(report.attempts == 2);
    CHECK(box.image == image);
  }
  SECTION("a loader that falls silent") {
    box.silent_from = 100;
    const auto report = boot();
    CHECK(report.how.what == code::echo_missing);
    CHECK(report.how.value == 100);
  }
  SECTION("a program that does not run") {
    box.dead_program = true;
    const auto report = boot();
    CHECK(report.how.what == code::no_program);
    CHECK(report.step == falcon::boot_step::program);
    CHECK(report.attempts == 3);
  }
  SECTION("no image") {
    CHECK(falcon::bootloader{line, std::span<const falcon::byte>{}, options}.run().how.what ==
          code::image_missing);
    CHECK(box.loads == 0);
  }
  SECTION("a bad image is never sent") {
    auto bad = image;
    bad.pop_back();
    CHECK(falcon::bootloader{line, std::span<const falcon::byte>(bad), options}.run().how.what ==
          code::image_truncated);
    CHECK(box.image.empty());
  }
  SECTION("cancelled at any step") {
    for (int n = 0; n < 12; ++n) {
      int left = n;
      const auto cancel = [&left](falcon::boot_step, std::size_t, std::size_t) {
        return left-- > 0;
      };
      box.now = scripted_falcon::mode::off;
      const auto report =
          falcon::bootloader{line, std::span<const falcon::byte>(image), options, cancel}.run();
      CHECK(report.how.what == code::cancelled);
      CHECK(report.attempts <= 1);
    }
  }
  SECTION("unplugged after any number of calls") {
    (void)boot();
    const long calls = box.calls;
    CHECK(calls > 20);
    for (long n = 0; n < calls; ++n) {
      cable other;
      REQUIRE(other.open());
      other.peer().unplug_after = n;
      const auto report = falcon::bootloader{other, std::span(image), options}.run();
      if (report.how.what != code::unplugged) FAIL("after " << n << " calls");
      if (report.attempts > 1) FAIL("tried again without a cable");
    }
  }
  SECTION("not open") {
    line.close();
    CHECK(boot().how.what == code::not_open);
  }
}

TEST_CASE("an image is checked to its last byte before it is sent", "[falcon][boot]") {
  const auto good = synthetic_image();
  const auto summary = falcon::check_image(good);
  REQUIRE(summary.how);
  CHECK(summary.entry == 0x3F8002);
  CHECK(summary.blocks == 2);
  CHECK(summary.words == 600);
  for (std::size_t length = 0; length < good.size(); ++length) {
    if (falcon::check_image(std::span(good).first(length)).how) FAIL(length);
  }
  CHECK(falcon::check_image({}).how.what == falcon::code::image_missing);
  auto longer = good;
  longer.push_back(0);
  CHECK(falcon::check_image(longer).how.what == falcon::code::image_trailing);
  auto other_key = good;
  other_key[0] = 0xAB;
  CHECK(falcon::check_image(other_key).how.what == falcon::code::image_wrong_key);
  CHECK(falcon::check_image(other_key).how.value == 0x08AB);
  auto too_long_block = good;
  too_long_block[23] = 0xFF;
  CHECK(falcon::check_image(too_long_block).how.what == falcon::code::image_truncated);
  CHECK(falcon::check_image(too_long_block).how.value == 22);
}

TEST_CASE("a firmware file is read whole or refused", "[falcon][boot]") {
  const scratch_folder folder;
  const std::string path = folder / "firmware.bin";
  const auto write = [&path](const std::vector<falcon::byte>& bytes) {
    std::FILE* file = std::fopen(path.c_str(), "wb");
    REQUIRE(file != nullptr);
    CHECK(std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size());
    std::fclose(file);
  };
  falcon::firmware image;
  CHECK(image.load("no/such/file").what == falcon::code::image_unreadable);
  CHECK(image.load(nullptr).what == falcon::code::image_unreadable);
  const auto good = synthetic_image();
  write(good);
  CHECK(image.load(path.c_str()));
  CHECK(std::vector<falcon::byte>(image.bytes().begin(), image.bytes().end()) == good);
  write({1, 2, 3});
  CHECK(image.load(path.c_str()).what == falcon::code::image_wrong_key);
  CHECK(image.bytes().empty());
  write(std::vector<falcon::byte>(falcon::firmware::capacity + 1, 0xAA));
  CHECK(image.load(path.c_str()).what == falcon::code::image_too_long);
}
