// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The FTDI FT232R between USB and the Falcon's processor: its requests, its status bytes. The Falcon
// is no USB-HID-class device (HID here means haptic interface device): it is this serial bridge,
// 0403:cb48, one bulk pipe each way.
//
//   IN transfer = 64-byte packets, each   modem status | line status | ≤ 62 bytes
//
// A packet goes out when it is full, or when the latency timer ends, with or without bytes in it.

#include <passive_haptics/falcon/packet.hpp>

#include <algorithm>
#include <chrono>

namespace passive_haptics {
inline namespace v0 {
namespace falcon {

/// Since the transport's own epoch, monotonic.
using nanoseconds = std::chrono::nanoseconds;

/// Vendor requests of the chip (type 0x40, index 0), and the values we send with them.
enum class request : byte {
  reset = 0,            ///< `purge_receive`, `purge_transmit`, or 0 for all
  modem = 1,            ///< `rts_low`, `dtr_low`, `dtr_high`
  flow_control = 2,     ///< 0: none
  baud = 3,             ///< a divisor of 3 MHz
  data = 4,             ///< `eight_bits`: 8N1
  event_character = 6,  ///< `event_character_on` | the character
  latency_timer = 9,    ///< [ms]
};

namespace ftdi {

inline constexpr std::uint16_t vendor = 0x0403, product = 0xcb48;
inline constexpr byte bulk_in = 0x81, bulk_out = 0x02;

inline constexpr std::uint16_t purge_receive = 1, purge_transmit = 2;
inline constexpr std::uint16_t rts_low = 0x0200, dtr_low = 0x0100, dtr_high = 0x0101;
inline constexpr std::uint16_t eight_bits = 0x0008;
inline constexpr std::uint16_t event_character_on = 0x0100;
inline constexpr std::uint16_t monitor_baud = 0x4138;  ///< 9600 Bd
inline constexpr std::uint16_t loader_baud = 0x0015;   ///< 142 857 Bd
inline constexpr std::uint16_t program_baud = 0x0002;  ///< 1.5 MBd

inline constexpr std::size_t usb_packet = 64;  ///< with
inline constexpr std::size_t status_size = 2;  ///< of them status
inline constexpr std::size_t payload_size = usb_packet - status_size;

/// The chip's two status bytes.
struct line_status {
  byte modem = 0;
  byte line = 0;

  [[nodiscard]] constexpr bool clear_to_send() const noexcept { return (modem & 0x10) != 0; }
  [[nodiscard]] constexpr bool overrun() const noexcept { return (line & 0x02) != 0; }
  [[nodiscard]] constexpr bool parity_error() const noexcept { return (line & 0x04) != 0; }
  [[nodiscard]] constexpr bool framing_error() const noexcept { return (line & 0x08) != 0; }
  bool operator==(const line_status&) const = default;
};

/// Takes the status bytes out of an IN transfer, in place: the payload moves to the front. Returns
/// its length; `last` becomes the status of the last packet in it, if there is one.
constexpr std::size_t strip_status(std::span<byte> transfer, line_status& last) noexcept {
  std::size_t kept = 0;
  for (std::size_t at = 0; at + status_size <= transfer.size(); at += usb_packet) {
    last = {transfer[at], transfer[at + 1]};
    const std::size_t end = (std::min)(at + usb_packet, transfer.size());
    for (std::size_t i = at + status_size; i < end; ++i) transfer[kept++] = transfer[i];
  }
  return kept;
}

/// The chip's way towards the host, for those who simulate it: bytes in, IN transfers out.
class sender {
 public:
  static constexpr std::size_t capacity = 4096;

  line_status lines{.modem = 0x01, .line = 0x60};  ///< of the packets to come

  constexpr void push(byte b) noexcept {
    if (count_ == capacity) {
      lines.line |= 0x02;
      return;
    }
    bytes_[(first_ + count_++) % capacity] = b;
    due_ = due_ || (event_ >= 0 && b == event_);
  }
  constexpr void push(std::span<const byte> bytes) noexcept {
    for (const byte b : bytes) push(b);
  }

  /// The requests that concern this direction; the others are ignored.
  constexpr void control(request r, std::uint16_t value) noexcept {
    if (r == request::reset && value != purge_transmit) count_ = 0;
    if (r == request::latency_timer) latency_ = std::chrono::milliseconds(value);
    if (r == request::event_character) {
      event_ = (value & event_character_on) != 0 ? static_cast<int>(value & 0xFF) : -1;
    }
  }

  constexpr void elapse(nanoseconds passed) noexcept { since_ += passed; }

  /// The IN transfer that is due, into `transfer`; 0: none yet. At least usb_packet bytes of room.
  [[nodiscard]] constexpr std::size_t transmit(std::span<byte> transfer) noexcept {
    if (count_ < payload_size && since_ < latency_ && !due_) return 0;
    since_ = nanoseconds(0);
    due_ = false;
    std::size_t filled = 0;
    while (filled + usb_packet <= transfer.size()) {
      transfer[filled++] = lines.modem;
      transfer[filled++] = lines.line;
      const std::size_t n = (std::min)(count_, payload_size);
      for (std::size_t i = 0; i < n; ++i) {
        transfer[filled++] = bytes_[first_];
        first_ = (first_ + 1) % capacity;
      }
      count_ -= n;
      if (n < payload_size) break;
    }
    return filled;
  }

  [[nodiscard]] constexpr std::size_t waiting() const noexcept { return count_; }

 private:
  std::array<byte, capacity> bytes_{};
  std::size_t first_ = 0, count_ = 0;
  nanoseconds latency_ = std::chrono::milliseconds(16);
  nanoseconds since_{0};  ///< since the last packet went out
  int event_ = -1;        ///< the character that sends a packet at once, −1: none
  bool due_ = false;      ///< it was there
};

}  // namespace ftdi

}  // namespace falcon
}  // namespace v0
}  // namespace passive_haptics
