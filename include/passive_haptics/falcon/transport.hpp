// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Bytes to and from the Falcon, over an FTDI FT232R, 0403:cb48, with one bulk pipe each way.
// It is a serial bridge and no USB-HID-class device (HID means haptic interface device here):
//
//   IN transfer = 64-byte packets, each   modem status | line status | ≤ 62 bytes
//
// A packet goes out when it is full, or when the latency timer ends, with or without bytes in it. Several
// transports carry this protocol:
//
//   libusb_transport       the real device                        libusb_transport.hpp
//   in_memory_transport    a simulated far side, virtual time     in_memory_transport.hpp
//   replay_transport       a recorded log, its own time           recording.hpp
//   recording_transport    any of them, with a record             recording.hpp
//
// Each transport has its own clock, so that a simulated hour takes a second and a test repeats itself.

#include <passive_haptics/falcon/packet.hpp>
#include <passive_haptics/falcon/result.hpp>

#include <algorithm>
#include <chrono>
#include <concepts>

namespace passive_haptics {
inline namespace v0 {
namespace falcon {

/// A time since the transport's own epoch, monotonic; or a duration.
using nanoseconds = std::chrono::nanoseconds;

/// Vendor requests of the chip (type 0x40, index 0), and the values that the driver sends with them.
enum class request : byte {
  reset = 0,            ///< `purge_receive`, `purge_transmit`, or 0 for all
  modem = 1,            ///< `rts_low`, `dtr_low`, `dtr_high`
  flow_control = 2,     ///< 0: none
  baud = 3,             ///< the divisor of 3 MHz that gives the baud rate
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

inline constexpr std::size_t usb_packet = 64;  ///< largest size of a packet [bytes]
inline constexpr std::size_t status_size = 2;  ///< status at the head of a packet [bytes]
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

/// Removes the status bytes from an IN transfer, in place, and returns the length of the payload, which moves to
/// the front. `last` becomes the status of the last packet of the transfer, if there is one.
constexpr std::size_t strip_status(std::span<byte> transfer, line_status& last) noexcept {
  std::size_t kept = 0;
  for (std::size_t at = 0; at + status_size <= transfer.size(); at += usb_packet) {
    last = {transfer[at], transfer[at + 1]};
    const std::size_t end = (std::min)(at + usb_packet, transfer.size());
    for (std::size_t i = at + status_size; i < end; ++i) transfer[kept++] = transfer[i];
  }
  return kept;
}

}  // namespace ftdi

/// The result of a read().
struct [[nodiscard]] transfer {
  result how{};           ///< ok, timeout, unplugged, not_open, transfer_failed
  std::size_t bytes = 0;  ///< > 0 when ok
  nanoseconds stamp{};    ///< when the bytes arrived
};

/// control() sends a request to the chip. write() sends all bytes or fails. read() returns the bytes that
/// came, at least one, without the chip's status bytes, or a timeout if none comes until the deadline; with a
/// deadline that is not later than now() it takes only bytes that are there. lines() is the status that came
/// last. now() is a steady clock: a sample at which it has not gone forward is refused. None of the functions
/// throws, and after open() none allocates.
template <class T>
concept transport = requires(T t, const T c, request r, std::uint16_t value,
                             std::span<const byte> out, std::span<byte> in, nanoseconds deadline) {
  { t.control(r, value) } -> std::same_as<result>;
  { t.write(out, deadline) } -> std::same_as<result>;
  { t.read(in, deadline) } -> std::same_as<transfer>;
  { t.close() } -> std::same_as<void>;
  { c.is_open() } -> std::same_as<bool>;
  { c.lines() } -> std::same_as<ftdi::line_status>;
  { c.now() } -> std::same_as<nanoseconds>;
  requires noexcept(t.control(r, value));
  requires noexcept(t.write(out, deadline));
  requires noexcept(t.read(in, deadline));
  requires noexcept(t.close());
  requires noexcept(c.now());
};

}  // namespace falcon
}  // namespace v0
}  // namespace passive_haptics
