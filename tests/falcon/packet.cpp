// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include <passive_haptics/falcon/packet.hpp>

#include <cstring>
#include <string>
#include <vector>

namespace falcon = passive_haptics::falcon;

namespace {

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
