// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/remote_targets.hpp"
#include "fuzz/try_hard.hpp"
#include "remote/messages.hpp"
#include "support/catch.hpp"
#include <passive_haptics/remote/wire.hpp>

#include <algorithm>
#include <cstring>

using namespace remote_test;

namespace {

/// With a number of 16, 32 or 64 bits changed and the checksum set right again: what a forger would send.
remote::datagram forged(remote::datagram bytes, std::size_t at, std::byte value) {
  bytes[at] = value;
  remote::detail::put(bytes, 28, remote::detail::checksum(bytes));
  return bytes;
}
remote::datagram forged(remote::datagram bytes, std::size_t number, double value) {
  remote::detail::put(bytes, 40 + 8 * number, std::bit_cast<std::uint64_t>(value));
  remote::detail::put(bytes, 28, remote::detail::checksum(bytes));
  return bytes;
}

constexpr std::array forms{remote::form::nothing, remote::form::plane, remote::form::quadric,
                           remote::form::probe};

}  // namespace

TEST_CASE("a datagram is these bytes on every machine", "[remote]") {
  // The same by hand, in an order that no machine has a say in.
  const std::array<unsigned, 40> head{
      'P',  'H',  'R',  'C',  2,    4,    1,    0,     // version, answer, plane, 0
      0x88, 0x77, 0x66, 0x55, 0x44, 0x33, 0x22, 0x11,  // key
      0xEF, 0xCD, 0xAB, 0x89, 0x67, 0x45, 0x23, 0x01,  // session
      0x0D, 0x0C, 0x0B, 0x0A, 0xF0, 0xF0, 0x68, 0x69,  // sequence, CRC-32 by zlib
      0x15, 0xCD, 0x5B, 0x07, 0,    0,    0,    0};    // 123 456 789 ns
  const remote::message m{
      .kind = remote::kind::answer,
      .key = 0x1122334455667788,
      .session = 0x0123456789ABCDEF,
      .sequence = 0x0A0B0C0D,
      .stamp = remote::nanoseconds(123456789),
      .content = {.form = remote::form::plane, .numbers = {1.0, -2.0, 0.5, 0, 0, 1.0, 2000.0}}};
  const auto bytes = remote::encode(m);
  for (std::size_t i = 0; i < head.size(); ++i) {
    INFO("byte " << i);
    CHECK(std::to_integer<unsigned>(bytes[i]) == head[i]);
  }
  const auto number = [&bytes](std::size_t i) {
    std::array<unsigned, 8> found{};
    for (std::size_t k = 0; k < 8; ++k) found[k] = std::to_integer<unsigned>(bytes[40 + 8 * i + k]);
    return found;
  };
  CHECK(number(0) == std::array<unsigned, 8>{0, 0, 0, 0, 0, 0, 0xF0, 0x3F});     // 1
  CHECK(number(1) == std::array<unsigned, 8>{0, 0, 0, 0, 0, 0, 0x00, 0xC0});     // −2
  CHECK(number(2) == std::array<unsigned, 8>{0, 0, 0, 0, 0, 0, 0xE0, 0x3F});     // ½
  CHECK(number(6) == std::array<unsigned, 8>{0, 0, 0, 0, 0, 0x40, 0x9F, 0x40});  // 2000
  CHECK(number(7) == std::array<unsigned, 8>{});
  constexpr std::string_view check = "123456789";  // the check value of this CRC
  CHECK(~remote::detail::crc_on(~0U, std::as_bytes(std::span(check))) == 0xCBF43926U);
}

TEST_CASE("what is encoded is decoded, whatever the form", "[remote]") {
  for (const auto form : forms) {
    const auto m = message_of(form);
    const auto found = remote::decode(remote::encode(m));
    REQUIRE(found);
    CHECK(found.value == m);
  }
  for (const std::int64_t ns : {std::numeric_limits<std::int64_t>::min(), std::int64_t(-1),
                                std::numeric_limits<std::int64_t>::max()}) {
    auto m = message_of(remote::form::probe);
    m.stamp = remote::nanoseconds(ns);
    CHECK(remote::decode(remote::encode(m)).value == m);
  }
}

TEST_CASE("a datagram that is cut off or too long is refused, at every length", "[remote]") {
  const auto bytes = remote::encode(message_of(remote::form::quadric));
  std::array<std::byte, 2 * remote::datagram_size> room{};
  std::copy(bytes.begin(), bytes.end(), room.begin());
  for (std::size_t n = 0; n <= room.size(); ++n) {
    // Copied, so that a look behind the end is one behind an allocation.
    const std::vector<std::byte> cut(room.begin(), room.begin() + static_cast<std::ptrdiff_t>(n));
    const auto found = remote::decode(cut);
    INFO(n << " bytes");
    CHECK((found.what == remote::verdict::accepted) == (n == remote::datagram_size));
    if (n != remote::datagram_size) CHECK(found.what == remote::verdict::wrong_length);
  }
}

TEST_CASE("a datagram with any bit flipped, or any two next to each other, is refused",
          "[remote]") {
  for (const auto form : forms) {
    const auto bytes = remote::encode(message_of(form));
    REQUIRE(remote::decode(bytes));
    int refused = 0;
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
      auto other = bytes;
      const auto flip = [&other](std::size_t i) {
        other[i / 8 % other.size()] ^= static_cast<std::byte>(1U << i % 8);
      };
      flip(bit);
      refused += remote::decode(other) ? 0 : 1;
      flip(bit + 1);
      refused += remote::decode(other) ? 0 : 1;
    }
    CHECK(refused == 2 * 8 * 152);
  }
}

TEST_CASE("a datagram that is whole and makes no sense is refused by name", "[remote]") {
  using remote::verdict;
  const auto good = remote::encode(message_of(remote::form::plane));
  const auto judged = [](const remote::datagram& bytes) { return remote::decode(bytes).what; };
  REQUIRE(judged(forged(good, 8, std::byte{7})) == verdict::accepted);  // another key: the control
  CHECK(judged(forged(good, 0, std::byte{'p'})) == verdict::foreign);
  CHECK(judged(forged(good, 4, std::byte{1})) == verdict::other_version);
  for (unsigned k = 0; k < 256; ++k) {
    INFO("kind " << k);
    CHECK(judged(forged(good, 5, std::byte(k))) ==
          (k >= 1 && k <= 6 ? verdict::accepted : verdict::malformed));
  }
  for (unsigned f = 0; f < 256; ++f) {
    INFO("form " << f);  // 2 uses more numbers, and 3 as many; 0 uses none, but there are some
    CHECK(judged(forged(good, 6, std::byte(f))) ==
          (f >= 1 && f <= 3 ? verdict::accepted : verdict::malformed));
  }
  CHECK(judged(forged(good, 7, std::byte{1})) == verdict::malformed);
  CHECK(judged(forged(good, 13, 1.0)) == verdict::malformed);
  CHECK(judged(forged(good, 13, -0.0)) == verdict::malformed);  // its bits are not 0
  const auto full = remote::encode(message_of(remote::form::quadric));
  for (std::size_t i = 0; i < 14; ++i) {
    for (const double x : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
      CHECK(judged(forged(full, i, x)) == verdict::not_finite);
    }
    CHECK(judged(forged(full, i, 1.0)) == verdict::accepted);
  }
}

TEST_CASE("numbers of order wrap round", "[remote]") {
  using remote::later;
  for (const std::uint32_t n : {0U, 1U, 0x7FFFFFFFU, 0x80000000U, 0xFFFFFFFFU}) {
    CHECK_FALSE(later(n, n));
    CHECK(later(n + 1, n));
    CHECK_FALSE(later(n, n + 1));
    CHECK(later(n + 0x7FFFFFFFU, n));
    CHECK_FALSE(later(n + 0x80000000U, n));  // as far one way as the other: neither
    CHECK_FALSE(later(n, n + 0x80000000U));
  }
}

TEST_CASE("no bytes upset decode, a client or a server", "[remote][fuzz]") {
  try_hard(fuzz::remote_ends, "PHRC\x01\x02\x03\x04");
}

TEST_CASE("every verdict has a sentence of its own", "[remote]") {
  std::vector<std::string> said;
  for (std::size_t v = 0; v < remote::verdicts; ++v) {
    said.emplace_back(to_string(static_cast<remote::verdict>(v)));
  }
  CHECK(std::find(said.begin(), said.end(), "unknown verdict") == said.end());
  std::sort(said.begin(), said.end());
  CHECK(std::adjacent_find(said.begin(), said.end()) == said.end());
  CHECK(std::string(to_string(static_cast<remote::verdict>(remote::verdicts))) ==
        "unknown verdict");
}
