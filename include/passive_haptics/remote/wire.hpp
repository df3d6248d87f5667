// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The datagrams between a device and its environment on another machine. They have 152 bytes for every kind and in
// both directions, so that no reply is larger than its request (no amplification). A seal may add bytes at the end
// (seal.hpp), also the same number for every kind.
//
//   offset  bytes
//        0      4   'P' 'H' 'R' 'C'
//        4      1   version, 2
//        5      1   kind
//        6      1   form of the content
//        7      1   0
//        8      8   key       drawn by the client, in every datagram
//       16      8   session   the server's cookie for this client, in every datagram but hello and busy
//       24      4   sequence  counted by the sender from 1; 0 in what is neither question nor answer
//       28      4   CRC-32 of the other 148 bytes (IEEE 802.3)
//       32      8   stamp     the client's clock when it asked [ns]; every reply echoes it
//       40    112   content   14 numbers of binary64; those that a form does not use are 0
//
//   content       0-2        3-5          6             7-9      10   11   12         13
//   nothing
//   plane         point p    normal n     stiffness K
//   quadric       point p    normal n     stiffness K   tangent  κ₁   κ₂   thickness  reach
//   probe         position   force        energy
//
// Integers and the bits of a binary64 are little-endian. The bytes are made by shifts, so they are the same on
// every machine. Nothing here allocates, throws or reads beyond what it is given.

#include <passive_haptics/base/kernels.hpp>

#include <array>
#include <bit>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace passive_haptics {
inline namespace v0 {
namespace remote {

using nanoseconds = std::chrono::nanoseconds;

inline constexpr std::size_t datagram_size = 152;
inline constexpr std::size_t longest_seal = 64;  ///< most bytes that a seal may add
using datagram = std::array<std::byte, datagram_size>;
using received_bytes = std::span<const std::byte>;

/// The sender of a datagram, as its carrier reports it: an IPv6 address, most significant byte first, or an IPv4 address
/// mapped into it (RFC 4291, 2.5.5.2), and a port. All zero on a carrier without addresses.
struct sender {
  std::array<std::uint8_t, 16> address{};
  std::uint16_t port = 0;

  bool operator==(const sender&) const = default;
};

enum class kind : std::uint8_t {
  hello = 1,  ///< client: asks for a session under its key
  welcome,    ///< server: offers a session, which begins when a question returns its number
  question,   ///< client: says where the device is
  answer,     ///< server: says what the device touches
  lost,       ///< server: knows no such session; the client has to say hello again
  busy,       ///< server: has another client
};

/// The kind of content of an answer or a question.
enum class form : std::uint8_t {
  nothing,  ///< there is nothing to be touched
  plane,    ///< half_space
  quadric,  ///< quadric
  probe,    ///< a position [m], a force [N], and the energy promised to the receiver [J]
};

/// The content of a datagram: up to 14 numbers, which content.hpp takes apart.
struct content {
  remote::form form = form::nothing;
  std::array<double, 14> numbers{};

  bool operator==(const content&) const = default;
};

/// A datagram, read.
struct message {
  remote::kind kind = kind::hello;
  std::uint64_t key = 0, session = 0;
  std::uint32_t sequence = 0;
  nanoseconds stamp{0};
  remote::content content{};

  bool operator==(const message&) const = default;
};

/// The verdict on received bytes, in the order of the checks. decode() makes those up to not_finite, a client or a
/// server the rest.
enum class verdict : std::uint8_t {
  accepted,
  wrong_length,   ///< not 152 bytes, and those of the seal
  forged,         ///< the seal does not open
  foreign,        ///< it does not begin with PHRC
  other_version,  ///< another version of this format
  damaged,        ///< the checksum differs
  malformed,      ///< no such kind or form, or not zero where it has to be
  not_finite,     ///< a number is NaN or infinite
  misdirected,    ///< of a kind that this end sends itself
  stranger,       ///< without the key, or not of this session
  repeated,       ///< its sequence number was received before
  overtaken,      ///< older than one that was received
  untrue_stamp,   ///< echoes a stamp never sent, or one older than the last that was answered
  too_old,        ///< answers a question of too long ago
  unusable,       ///< a surface that no local model accepts
  turned_away,    ///< from another client, while the present one still asks
};
inline constexpr std::size_t verdicts = 16;

[[nodiscard]] constexpr const char* to_string(verdict v) noexcept {
  switch (v) {
    case verdict::accepted:
      return "accepted";
    case verdict::wrong_length:
      return "not 152 bytes long, or has not the bytes of this end's seal";
    case verdict::forged:
      return "not sealed by the other end: have both the same key?";
    case verdict::foreign:
      return "no datagram of this format";
    case verdict::other_version:
      return "another version of this format: build both ends with the same library";
    case verdict::damaged:
      return "the checksum is another";
    case verdict::malformed:
      return "no such kind or form, or not zero where it has to be";
    case verdict::not_finite:
      return "a number is NaN or infinite";
    case verdict::misdirected:
      return "of a kind that this end sends itself: are two clients or two servers connected?";
    case verdict::stranger:
      return "not of this session";
    case verdict::repeated:
      return "there twice";
    case verdict::overtaken:
      return "overtaken by a newer one";
    case verdict::untrue_stamp:
      return "echoes a stamp that was never sent, or one older than what is answered";
    case verdict::too_old:
      return "answers what was asked too long ago: is a queue on the way?";
    case verdict::unusable:
      return "a surface that cannot be used: stiffness, normal, thickness or reach";
    case verdict::turned_away:
      return "another client is here: end it, or wait until it is silent";
  }
  return "unknown verdict";
}

namespace detail {

/// The CRC of each single byte, with the reflected polynomial EDB88320h.
inline constexpr std::array<std::uint32_t, 256> crc_of_byte = [] {
  std::array<std::uint32_t, 256> all{};
  for (std::uint32_t n = 0; n < 256; ++n) {
    std::uint32_t c = n;
    for (int bit = 0; bit < 8; ++bit) c = (c & 1) != 0 ? c >> 1 ^ 0xEDB88320U : c >> 1;
    all[n] = c;
  }
  return all;
}();

[[nodiscard]] constexpr std::uint32_t crc_on(std::uint32_t crc, received_bytes bytes) noexcept {
  for (const std::byte b : bytes) {
    crc = crc >> 8 ^ crc_of_byte[(crc ^ std::to_integer<std::uint32_t>(b)) & 255];
  }
  return crc;
}

template <class Word>
constexpr void put(std::span<std::byte> bytes, std::size_t at, Word word) noexcept {
  for (std::size_t i = 0; i < sizeof(Word); ++i) {
    bytes[at + i] = static_cast<std::byte>(word >> 8 * i & 255);
  }
}
template <class Word>
[[nodiscard]] constexpr Word word_at(received_bytes bytes, std::size_t at) noexcept {
  Word word = 0;
  for (std::size_t i = sizeof(Word); i-- > 0;) {
    word = static_cast<Word>(word << (sizeof(Word) > 1 ? 8 : 0) |
                             std::to_integer<Word>(bytes[at + i]));
  }
  return word;
}

inline constexpr std::uint32_t magic = 0x43524850;  // 'P' 'H' 'R' 'C'
inline constexpr std::uint8_t version = 2;
inline constexpr std::size_t magic_at = 0, version_at = 4, kind_at = 5, form_at = 6, zero_at = 7,
                             key_at = 8, session_at = 16, sequence_at = 24, crc_at = 28,
                             stamp_at = 32, content_at = 40;

/// The CRC-32 of all bytes but its own four.
[[nodiscard]] constexpr std::uint32_t checksum(received_bytes bytes) noexcept {
  const std::uint32_t before = crc_on(~0U, bytes.first(crc_at));
  return ~crc_on(before, bytes.subspan(crc_at + 4));
}

/// The number of the 14 numbers that a form uses.
[[nodiscard]] constexpr std::size_t numbers_of(form f) noexcept {
  constexpr std::array<std::size_t, 4> count{0, 7, 14, 7};
  return count[static_cast<std::size_t>(f)];
}

// A double has the bits of the binary64 that is sent.
static_assert(std::numeric_limits<double>::is_iec559 && sizeof(double) == 8);
static_assert(content_at + 8 * std::tuple_size_v<decltype(content::numbers)> == datagram_size);

}  // namespace detail

/// The bytes of a message. Numbers that its form does not use are sent as 0.
[[nodiscard]] constexpr datagram encode(const message& m) noexcept {
  datagram bytes{};
  detail::put(bytes, detail::magic_at, detail::magic);
  detail::put(bytes, detail::version_at, detail::version);
  detail::put(bytes, detail::kind_at, static_cast<std::uint8_t>(m.kind));
  detail::put(bytes, detail::form_at, static_cast<std::uint8_t>(m.content.form));
  detail::put(bytes, detail::key_at, m.key);
  detail::put(bytes, detail::session_at, m.session);
  detail::put(bytes, detail::sequence_at, m.sequence);
  detail::put(bytes, detail::stamp_at, static_cast<std::uint64_t>(m.stamp.count()));
  for (std::size_t i = 0; i < detail::numbers_of(m.content.form); ++i) {
    detail::put(bytes, detail::content_at + 8 * i,
                std::bit_cast<std::uint64_t>(m.content.numbers[i]));
  }
  detail::put(bytes, detail::crc_at, detail::checksum(bytes));
  return bytes;
}

/// The result of decode(). It converts to true if `value` is a valid message.
struct [[nodiscard]] decoded {
  verdict what = verdict::accepted;
  message value{};

  constexpr explicit operator bool() const noexcept { return what == verdict::accepted; }
};

/// Reads any bytes. The result is a message from which encode() makes the same bytes, or the reason why there
/// is none.
[[nodiscard]] constexpr decoded decode(received_bytes bytes) noexcept {
  using namespace detail;
  if (bytes.size() != datagram_size) return {verdict::wrong_length};
  if (word_at<std::uint32_t>(bytes, magic_at) != magic) return {verdict::foreign};
  if (word_at<std::uint8_t>(bytes, version_at) != version) return {verdict::other_version};
  if (word_at<std::uint32_t>(bytes, crc_at) != checksum(bytes)) return {verdict::damaged};
  const auto what = word_at<std::uint8_t>(bytes, kind_at);
  const auto about = word_at<std::uint8_t>(bytes, form_at);
  if (what < static_cast<std::uint8_t>(kind::hello) ||
      what > static_cast<std::uint8_t>(kind::busy) ||
      about > static_cast<std::uint8_t>(form::probe) || bytes[zero_at] != std::byte{0}) {
    return {verdict::malformed};
  }
  message m{
      .kind = static_cast<kind>(what),
      .key = word_at<std::uint64_t>(bytes, key_at),
      .session = word_at<std::uint64_t>(bytes, session_at),
      .sequence = word_at<std::uint32_t>(bytes, sequence_at),
      .stamp = nanoseconds(static_cast<std::int64_t>(word_at<std::uint64_t>(bytes, stamp_at))),
      .content = {.form = static_cast<form>(about)}};
  for (std::size_t i = 0; i < m.content.numbers.size(); ++i) {
    const auto bits = word_at<std::uint64_t>(bytes, content_at + 8 * i);
    if (i >= numbers_of(m.content.form)) {
      if (bits != 0) return {verdict::malformed};
      continue;
    }
    m.content.numbers[i] = std::bit_cast<double>(bits);
    if (!kernels::is_finite(m.content.numbers[i])) return {verdict::not_finite};
  }
  return {verdict::accepted, m};
}

/// True if a is later than b, both counted modulo 2³²: it is up to 2³¹ − 1 ahead (serial numbers of RFC 1982).
/// So a counter may wrap round, which takes 50 days at 1 kHz.
[[nodiscard]] constexpr bool later(std::uint32_t a, std::uint32_t b) noexcept {
  return a != b && a - b < 0x80000000U;
}

}  // namespace remote
}  // namespace v0
}  // namespace passive_haptics
