// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scripted_falcon.hpp"
#include <passive_haptics/falcon/boot.hpp>

#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>

namespace {

using cable = falcon::in_memory_transport<scripted_falcon>;

falcon::packet_bytes packet_of(const char (&text)[17]) {
  falcon::packet_bytes bytes{};
  std::memcpy(bytes.data(), text, bytes.size());
  return bytes;
}

std::string text_of(const falcon::packet_bytes& bytes) {
  return {bytes.begin(), bytes.end()};
}

template <class Packet>
std::vector<Packet> parse(const std::vector<falcon::byte>& bytes) {
  falcon::packet_parser<Packet> parser;
  std::vector<Packet> found;
  for (const falcon::byte b : bytes) {
    if (const auto packet = parser.push(b)) found.push_back(*packet);
  }
  return found;
}

std::vector<falcon::byte> bytes_of(const falcon::packet_bytes& bytes) {
  return {bytes.begin(), bytes.end()};
}

}  // namespace

TEST_CASE("packets are the published ones, byte for byte", "[falcon][packet]") {
  CHECK(text_of(falcon::encode(falcon::to_device{.homing = false})) == "<AAAAAAAAAAAAAA>");
  CHECK(text_of(falcon::encode(falcon::to_device{
            .motor = {-1, 4096, 1}, .light = falcon::lamps::green})) == "<PPPPAAABBAAADA>");
  CHECK(text_of(falcon::encode(falcon::to_device{.light = falcon::lamps::red})) ==
        "<AAAAAAAAAAAAJA>");
  CHECK(text_of(falcon::encode(falcon::from_device{.encoder = {-1447, 1447, 0}})) ==
        "<JFKPHKFAAAAAAA>");
  const auto captured = falcon::decode<falcon::to_device>(packet_of("<AAAAAAAAAAAAEA>"));
  REQUIRE(captured);
  CHECK_FALSE(captured->homing);
  CHECK(captured->light == falcon::lamps::blue);
  const auto full =
      falcon::decode<falcon::from_device>(packet_of("<AAAAAAAAAAAA\xC0"
                                                    "A>"));
  REQUIRE(full);
  CHECK(full->is_homed());
  CHECK(full->buttons == 15);
  CHECK(full->pressed(falcon::button::minus));
}

TEST_CASE("every word and flag goes through encode and decode unchanged", "[falcon][packet]") {
  for (int word = -32768; word <= 32767; ++word) {
    const auto w = static_cast<std::int16_t>(word);
    const falcon::to_device out{.motor = {w, static_cast<std::int16_t>(-1 - w), 7}};
    if (falcon::decode<falcon::to_device>(falcon::encode(out)) != out) FAIL(word);
  }
  for (int flags = 0; flags < 128; ++flags) {
    const falcon::from_device in{.buttons = static_cast<falcon::byte>(flags & 15),
                                 .homed = static_cast<falcon::byte>(flags >> 4)};
    if (falcon::decode<falcon::from_device>(falcon::encode(in)) != in) FAIL(flags);
  }
  SUCCEED();
}

TEST_CASE("a packet with a byte that cannot stand there is refused", "[falcon][packet]") {
  const auto good = falcon::encode(falcon::from_device{.encoder = {1, 2, 3}, .homed = 7});
  REQUIRE(falcon::decode<falcon::from_device>(good));
  for (std::size_t at = 0; at < falcon::packet_size; ++at) {
    int accepted = 0;
    for (int b = 0; b < 256; ++b) {
      auto spoiled = good;
      spoiled[at] = static_cast<falcon::byte>(b);
      accepted += falcon::decode<falcon::from_device>(spoiled) ? 1 : 0;
    }
    INFO("byte " << at);
    CHECK(accepted == (at == 0 || at == 15 ? 1 : at == 13 ? 128 : at == 14 ? 254 : 16));
  }
}

TEST_CASE("the parser finds the next whole packet after any extra or missing byte",
          "[falcon][packet]") {
  const falcon::from_device one{.encoder = {1, -2, 3}, .homed = 7};
  const falcon::from_device two{.encoder = {-400, 500, 600}, .buttons = 4, .homed = 7};
  const auto a = bytes_of(falcon::encode(one)), b = bytes_of(falcon::encode(two));
  for (std::size_t at = 0; at <= a.size(); ++at) {
    for (int extra = 0; extra < 256; ++extra) {
      auto bytes = a;
      bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                   static_cast<falcon::byte>(extra));
      bytes.insert(bytes.end(), b.begin(), b.end());
      const auto found = parse<falcon::from_device>(bytes);
      if (found.empty() || !(found.back() == two)) FAIL(extra << " at " << at);
    }
  }
  for (std::size_t at = 0; at < a.size(); ++at) {
    auto bytes = a;
    bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(at));
    bytes.insert(bytes.end(), b.begin(), b.end());
    INFO("byte " << at << " missing");
    CHECK(parse<falcon::from_device>(bytes) == std::vector{two});
  }
}

TEST_CASE("the parser counts what it could not use", "[falcon][packet]") {
  falcon::packet_parser<falcon::from_device> parser;
  for (const char c : std::string("xyz<AAAA<AAAAAAAAAAAAAA>?<AAAA!")) {
    (void)parser.push(static_cast<falcon::byte>(c));
  }
  CHECK(parser.skipped() == 4);
  CHECK(parser.broken() == 2);
}

TEST_CASE("status bytes are taken out of every 64-byte packet, not of every transfer",
          "[falcon][ftdi]") {
  for (std::size_t length = 0; length <= 400; ++length) {
    std::vector<falcon::byte> transfer(length), wanted;
    for (std::size_t i = 0; i < length; ++i) {
      transfer[i] = static_cast<falcon::byte>(i % 64 < 2 ? 0xF0 + i % 64 : i % 199);
      if (i % 64 >= 2) wanted.push_back(transfer[i]);
    }
    falcon::ftdi::line_status lines{};
    const std::size_t kept = falcon::ftdi::strip_status(transfer, lines);
    transfer.resize(kept);
    if (transfer != wanted) FAIL(length);
    if (length % 64 != 1) CHECK(lines.modem == (length >= 2 ? 0xF0 : 0));
  }
}

TEST_CASE("what the simulated chip packs, the transport unpacks", "[falcon][ftdi]") {
  falcon::ftdi::sender chip;
  std::vector<falcon::byte> sent, got;
  for (int i = 0; i < 1000; ++i) {
    sent.push_back(static_cast<falcon::byte>(i * 7));
    chip.push(sent.back());
  }
  std::array<falcon::byte, 192> transfer{};
  for (int i = 0; i < 100; ++i) {
    chip.elapse(std::chrono::milliseconds(16));
    falcon::ftdi::line_status lines{};
    const std::size_t n = chip.transmit(transfer);
    const std::size_t kept = falcon::ftdi::strip_status(std::span(transfer).first(n), lines);
    got.insert(got.end(), transfer.begin(), transfer.begin() + static_cast<std::ptrdiff_t>(kept));
  }
  CHECK(got == sent);
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
  const std::string path =
      (std::filesystem::temp_directory_path() / "passive_haptics_firmware.bin").string();
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
  std::remove(path.c_str());
}

TEST_CASE("a device without a program gets one, byte for byte", "[falcon][boot]") {
  const auto image = synthetic_image();
  cable line;
  REQUIRE(line.open());
  const auto report = falcon::bootloader{line, std::span(image)}.run();
  CHECK(report.how.what == falcon::code::ok);
  CHECK(report.attempts == 1);
  CHECK(report.echoed == image.size());
  CHECK(report.clear_to_send);
  CHECK(line.far().now == scripted_falcon::mode::running);
  CHECK(line.far().image == image);
}

TEST_CASE("the policy says whether to probe and whether to load", "[falcon][boot]") {
  using falcon::firmware_policy;
  const auto image = synthetic_image();
  const auto boot = [&image](firmware_policy policy, bool running) {
    cable line;
    REQUIRE(line.open());
    if (running) line.far().now = scripted_falcon::mode::running;
    falcon::boot_options options;
    options.policy = policy;
    const auto report = falcon::bootloader{line, std::span(image), options}.run();
    return std::pair(report.how.what, line.far().loads);
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
  scripted_falcon& far = line.far();
  const auto boot = [&] { return falcon::bootloader{line, std::span(image), options}.run(); };

  SECTION("no hello") {
    far.deaf_hellos = 1000;
    CHECK(boot().how.what == code::no_hello);
    CHECK(boot().step == falcon::boot_step::hello);
  }
  SECTION("some hellos unanswered") {
    far.deaf_hellos = 7;
    CHECK(boot().how.what == code::ok);
  }
  SECTION("a leading zero") {
    far.leading_zero = true;
    CHECK(boot().how.what == code::ok);
    CHECK(far.image == image);
  }
  SECTION("a loader that does not lock on") {
    far.mute_loader = true;
    const auto report = boot();
    CHECK(report.how.what == code::no_loader);
    CHECK(report.attempts == 3);
  }
  SECTION("late CTS is waited for") {
    far.insists_on_cts = true;
    far.cts_after = std::chrono::milliseconds(150);
    const auto report = boot();
    CHECK(report.how.what == code::ok);
    CHECK(report.clear_to_send);
    CHECK(report.attempts == 1);
  }
  SECTION("without CTS the loader is called all the same") {
    far.cts_after = std::chrono::hours(1);
    const auto report = boot();
    CHECK(report.how.what == code::ok);
    CHECK_FALSE(report.clear_to_send);
  }
  SECTION("a wrong echo of any byte") {
    for (std::size_t at = 0; at < image.size(); ++at) {
      far.wrong_echo_at = static_cast<long>(at);
      const auto report = boot();
      if (report.how.what != code::echo_mismatch) FAIL("byte " << at);
      if (report.how.value != static_cast<std::int64_t>(at)) FAIL("byte " << at);
      far.now = scripted_falcon::mode::off;
    }
  }
  SECTION("a wrong echo once") {
    far.wrong_echo_at = 77;
    far.broken_loads = 1;
    const auto report = boot();
    CHECK(report.how.what == code::ok);
    CHECK(report.attempts == 2);
    CHECK(far.image == image);
  }
  SECTION("a loader that falls silent") {
    far.silent_from = 100;
    const auto report = boot();
    CHECK(report.how.what == code::echo_missing);
    CHECK(report.how.value == 100);
  }
  SECTION("a program that does not run") {
    far.dead_program = true;
    const auto report = boot();
    CHECK(report.how.what == code::no_program);
    CHECK(report.step == falcon::boot_step::program);
    CHECK(report.attempts == 3);
  }
  SECTION("no image") {
    CHECK(falcon::bootloader{line, std::span<const falcon::byte>{}, options}.run().how.what ==
          code::image_missing);
    CHECK(far.loads == 0);
  }
  SECTION("a bad image is never sent") {
    auto bad = image;
    bad.pop_back();
    CHECK(falcon::bootloader{line, std::span<const falcon::byte>(bad), options}.run().how.what ==
          code::image_truncated);
    CHECK(far.image.empty());
  }
  SECTION("cancelled at any step") {
    for (int n = 0; n < 12; ++n) {
      int left = n;
      const auto cancel = [&left](falcon::boot_step, std::size_t, std::size_t) {
        return left-- > 0;
      };
      far.now = scripted_falcon::mode::off;
      const auto report =
          falcon::bootloader{line, std::span<const falcon::byte>(image), options, cancel}.run();
      CHECK(report.how.what == code::cancelled);
      CHECK(report.attempts <= 1);
    }
  }
  SECTION("unplugged after any number of calls") {
    (void)boot();
    const long calls = far.calls;
    CHECK(calls > 20);
    for (long n = 0; n < calls; ++n) {
      cable other;
      REQUIRE(other.open());
      other.far().unplug_after = n;
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
  std::array<char, 8> small{};
  CHECK(std::string(falcon::describe({falcon::code::no_hello}, small)) == "the mon");
}
