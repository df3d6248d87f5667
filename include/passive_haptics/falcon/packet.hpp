// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The packets of the running Falcon, 16 printable bytes each way, one in flight.
//
//   byte     0     1-4        5-8        9-12       13           14    15
//   host ─▶  '<'   motor 0    motor 1    motor 2    'A' + flags  'A'   '>'
//   host ◀─  '<'   encoder 0  encoder 1  encoder 2  'A' + flags   ?    '>'
//
// A word is four nibbles, the least significant first, in two's complement; a nibble n is the byte 'A' + n.
// The legs are, seen from the front, 0 top, 1 right, 2 left. Neither '<' nor '>' can stand inside a packet,
// so a '<' always begins one, and after any disturbance the next whole packet is read. There is no checksum,
// so a flipped bit that gives another nibble is not noticed here (reply_guard refuses jumps).

#include <passive_haptics/base/language.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace passive_haptics {
inline namespace v0 {
namespace falcon {

using byte = std::uint8_t;
using leg_words = std::array<std::int16_t, 3>;

inline constexpr std::size_t packet_size = 16;
using packet_bytes = std::array<byte, packet_size>;

/// The lamps in the logo; they can be combined. The colour of each bit is not confirmed.
enum class lamps : byte { none = 0, green = 2, blue = 4, red = 8 };
[[nodiscard]] constexpr lamps operator|(lamps a, lamps b) noexcept {
  return static_cast<lamps>(static_cast<byte>(a) | static_cast<byte>(b));
}

/// The buttons of the grip; a reply carries any of them, or-ed.
enum class button : byte { plus = 1, forward = 2, centre = 4, minus = 8 };

/// A packet of the host.
struct to_device {
  leg_words motor{};   ///< DAC counts; positive pulls the arm in
  bool homing = true;  ///< homed bits are reported, and stay, only while this is set
  lamps light = lamps::none;

  bool operator==(const to_device&) const = default;
};

/// A packet of the Falcon.
struct from_device {
  leg_words encoder{};  ///< counts
  byte buttons = 0;     ///< see pressed()
  byte homed = 0;       ///< bit i: leg i is homed, its counts are absolute

  static constexpr byte all_legs = 7;
  [[nodiscard]] constexpr bool is_homed() const noexcept { return homed == all_legs; }
  [[nodiscard]] constexpr bool pressed(button b) const noexcept {
    return (buttons & static_cast<byte>(b)) != 0;
  }
  bool operator==(const from_device&) const = default;
};

namespace detail {

inline constexpr byte opening = '<', closing = '>', zero = 'A';
inline constexpr std::size_t flags_at = 13, filler_at = 14;

[[nodiscard]] constexpr byte flags_of(const to_device& p) noexcept {
  return static_cast<byte>((p.homing ? 1 : 0) | (static_cast<byte>(p.light) & 0x0E));
}
[[nodiscard]] constexpr byte flags_of(const from_device& p) noexcept {
  return static_cast<byte>((p.buttons & 0x0F) | (p.homed & 7) << 4);
}
constexpr void take_flags(to_device& p, byte flags) noexcept {
  p.homing = (flags & 1) != 0;
  p.light = static_cast<lamps>(flags & 0x0E);
}
constexpr void take_flags(from_device& p, byte flags) noexcept {
  p.buttons = static_cast<byte>(flags & 0x0F);
  p.homed = static_cast<byte>(flags >> 4 & 7);
}
[[nodiscard]] constexpr auto& words_of(auto& packet) noexcept {
  if constexpr (requires { packet.motor; }) {
    return packet.motor;
  } else {
    return packet.encoder;
  }
}

/// True if byte b can stand at that place of a packet. The flags need 7 bits: 0x41 … 0xC0.
[[nodiscard]] constexpr bool fits(std::size_t place, byte b) noexcept {
  if (place == 0) return b == opening;
  if (place == packet_size - 1) return b == closing;
  if (place == filler_at) return b != opening && b != closing;
  return b >= zero && b < zero + (place == flags_at ? 128 : 16);
}

}  // namespace detail

/// The bytes on the wire of a to_device or from_device.
template <class Packet>
[[nodiscard]] constexpr packet_bytes encode(const Packet& packet) noexcept {
  packet_bytes bytes{};
  bytes.front() = detail::opening;
  bytes.back() = detail::closing;
  std::size_t at = 1;
  for (const std::int16_t word : detail::words_of(packet)) {
    const auto bits = static_cast<std::uint16_t>(word);
    for (int shift = 0; shift < 16; shift += 4) {
      bytes[at++] = static_cast<byte>(detail::zero + (bits >> shift & 15));
    }
  }
  bytes[detail::flags_at] = static_cast<byte>(detail::zero + detail::flags_of(packet));
  bytes[detail::filler_at] = detail::zero;
  return bytes;
}

/// The packet, or nothing if a byte cannot stand at its place.
template <class Packet>
[[nodiscard]] constexpr std::optional<Packet> decode(const packet_bytes& bytes) noexcept {
  for (std::size_t i = 0; i < packet_size; ++i) {
    if (!detail::fits(i, bytes[i])) return std::nullopt;
  }
  Packet packet;
  std::size_t at = 1;
  for (std::int16_t& word : detail::words_of(packet)) {
    unsigned bits = 0;
    for (int shift = 0; shift < 16; shift += 4) {
      bits |= static_cast<unsigned>(bytes[at++] - detail::zero) << shift;
    }
    word = static_cast<std::int16_t>(static_cast<std::uint16_t>(bits));
  }
  detail::take_flags(packet, static_cast<byte>(bytes[detail::flags_at] - detail::zero));
  return packet;
}

/// Finds the packets in a stream of any bytes.
///     for (const byte b : received) if (const auto reply = parser.push(b)) use(*reply);
template <class Packet>
class packet_parser {
 public:
  /// Takes one byte; returns the packet that it completes, if any.
  constexpr std::optional<Packet> push(byte b) noexcept {
    if (b == detail::opening) {
      broken_ += filled_ != 0 ? 1U : 0U;
      filled_ = 0;
    } else if (filled_ == 0) {
      ++skipped_;
      return std::nullopt;
    }
    if (!detail::fits(filled_, b)) {
      ++broken_;
      filled_ = 0;
      return std::nullopt;
    }
    bytes_[filled_++] = b;
    if (filled_ < packet_size) return std::nullopt;
    filled_ = 0;
    return decode<Packet>(bytes_);
  }

  /// Forgets a packet that has begun.
  constexpr void reset() noexcept { filled_ = 0; }

  [[nodiscard]] constexpr std::uint32_t broken() const noexcept { return broken_; }    ///< packets
  [[nodiscard]] constexpr std::uint32_t skipped() const noexcept { return skipped_; }  ///< bytes

 private:
  packet_bytes bytes_{};
  std::size_t filled_ = 0;
  std::uint32_t broken_ = 0;   ///< packets begun and not finished
  std::uint32_t skipped_ = 0;  ///< bytes outside packets
};

static_assert(encode(to_device{.homing = false}) == packet_bytes{'<', 'A', 'A', 'A', 'A', 'A', 'A',
                                                                 'A', 'A', 'A', 'A', 'A', 'A', 'A',
                                                                 'A', '>'});

}  // namespace falcon
}  // namespace v0
}  // namespace passive_haptics
