// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The cable to a simulated far side, in virtual time, for tests of the Falcon's driver.
// The far side may be the mock of mock.hpp or one of your own.

#include <passive_haptics/falcon/transport.hpp>

#include <algorithm>
#include <utility>

namespace passive_haptics {
inline namespace v0 {
namespace falcon {

namespace ftdi {

/// The simulated chip's direction towards the host: it takes bytes and gives IN transfers.
class sender {
 public:
  static constexpr std::size_t capacity = 4096;

  line_status lines{.modem = 0x01, .line = 0x60};  ///< status of the packets to come

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

  /// Takes the requests that concern this direction and ignores the others.
  constexpr void control(request r, std::uint16_t value) noexcept {
    if (r == request::reset && value != purge_transmit) count_ = 0;
    if (r == request::latency_timer) latency_ = std::chrono::milliseconds(value);
    if (r == request::event_character) {
      event_ = (value & event_character_on) != 0 ? static_cast<int>(value & 0xFF) : -1;
    }
  }

  constexpr void elapse(nanoseconds passed) noexcept { since_ += passed; }

  /// Writes the IN transfer that is due into `transfer`, which has room for usb_packet bytes or more; returns its
  /// length, or 0 if none is due.
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
  nanoseconds since_{0};  ///< time since the last packet went out
  int event_ = -1;        ///< the character that sends a packet at once, −1: none
  bool due_ = false;      ///< true if that character was sent
};

}  // namespace ftdi

/// The far side of the cable: the chip and all behind it. control() and receive() take requests and bytes of
/// the host. transmit() writes the IN transfer that is due, status bytes included, and returns its length, 0
/// if none is due (ftdi::sender does that). elapse() lets time pass. attached() is false once the cable is out.
template <class F>
concept far_side = requires(F f, const F c, request r, std::uint16_t value,
                            std::span<const byte> out, std::span<byte> in, nanoseconds passed) {
  { f.control(r, value) } -> std::same_as<void>;
  { f.receive(out) } -> std::same_as<void>;
  { f.transmit(in) } -> std::same_as<std::size_t>;
  { f.elapse(passed) } -> std::same_as<void>;
  { c.attached() } -> std::same_as<bool>;
};

/// The cable to a simulated far side. Its clock advances in pass(), and while read() waits, in steps of one
/// USB microframe.
template <far_side FarSide>
class in_memory_transport {
 public:
  static constexpr nanoseconds step = std::chrono::microseconds(125);

  template <class... Arguments>
  explicit in_memory_transport(Arguments&&... arguments)
      : far_(std::forward<Arguments>(arguments)...) {}

  result open() noexcept {
    if (!far_.attached()) return {code::no_device};
    open_ = true;
    return {};
  }
  void close() noexcept { open_ = false; }
  [[nodiscard]] bool is_open() const noexcept { return open_; }

  result control(request r, std::uint16_t value) noexcept {
    if (const result fault = reachable(); !fault) return fault;
    if (r == request::reset && value != ftdi::purge_transmit) first_ = end_;
    far_.control(r, value);
    return {};
  }

  result write(std::span<const byte> bytes, nanoseconds /*deadline*/) noexcept {
    if (const result fault = reachable(); !fault) return fault;
    far_.receive(bytes);
    return {};
  }

  transfer read(std::span<byte> into, nanoseconds deadline) noexcept {
    for (;;) {
      if (const result fault = reachable(); !fault) return {fault, 0, now_};
      if (first_ == end_) {
        const std::size_t received = far_.transmit(received_);
        first_ = 0;
        end_ = ftdi::strip_status(std::span(received_).first(received), lines_);
      }
      if (first_ != end_) break;
      if (now_ >= deadline) return {{code::timeout}, 0, now_};
      pass((std::min)(step, deadline - now_));
    }
    const std::size_t n = (std::min)(into.size(), end_ - first_);
    std::copy_n(received_.begin() + static_cast<std::ptrdiff_t>(first_), n, into.begin());
    first_ += n;
    return {{}, n, now_};
  }

  [[nodiscard]] ftdi::line_status lines() const noexcept { return lines_; }
  [[nodiscard]] nanoseconds now() const noexcept { return now_; }

  /// Lets time pass without a read.
  void pass(nanoseconds passed) noexcept {
    now_ += passed;
    far_.elapse(passed);
  }

  [[nodiscard]] FarSide& peer() noexcept { return far_; }
  [[nodiscard]] const FarSide& peer() const noexcept { return far_; }

 private:
  [[nodiscard]] result reachable() const noexcept {
    if (!open_) return {code::not_open};
    if (!far_.attached()) return {code::unplugged};
    return {};
  }

  FarSide far_;
  std::array<byte, 8 * ftdi::usb_packet> received_{};
  std::size_t first_ = 0, end_ = 0;  ///< begin and end of the payload in received_
  ftdi::line_status lines_{};
  nanoseconds now_{0};
  bool open_ = false;
};

}  // namespace falcon
}  // namespace v0
}  // namespace passive_haptics
