// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Transport: bytes to and from the Falcon's serial bridge. One protocol, several ways to carry it:
//
//   libusb_transport       the real device                        libusb_transport.hpp
//   in_memory_transport    a simulated far side, virtual time     here
//   replay_transport       a recorded log, its own time           recording.hpp
//   recording_transport    any of them, and keeps what passes     recording.hpp
//
// Time belongs to the transport, so that a simulated hour takes a second and a test repeats itself.

#include <passive_haptics/falcon/ftdi.hpp>
#include <passive_haptics/falcon/result.hpp>

#include <concepts>
#include <utility>

namespace passive_haptics {
inline namespace v0 {
namespace falcon {

/// How a read() ended.
struct [[nodiscard]] transfer {
  result how{};           ///< ok, timeout, unplugged, not_open, transfer_failed
  std::size_t bytes = 0;  ///< > 0 when ok
  nanoseconds stamp{};    ///< when they arrived
};

/// control() sends a request to the chip. write() sends all bytes or fails. read() returns the bytes
/// that came, at least one, the chip's status bytes taken out; with nothing until the deadline it is
/// a timeout, and a deadline that is not later than now() takes only what is there. lines() is the
/// status that came last. now() is steady: a sample before which it has not gone forward is refused.
/// None of them throws; after open() none allocates.
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

/// What is beyond the cable: the chip and all behind it. control() and receive() take what the host
/// sends. transmit() fills in the IN transfer that is due, status bytes included, and returns its
/// length, 0 when none is (ftdi::sender does that). elapse() lets time pass. attached() is false
/// once the cable is out.
template <class F>
concept far_side = requires(F f, const F c, request r, std::uint16_t value,
                            std::span<const byte> out, std::span<byte> in, nanoseconds passed) {
  { f.control(r, value) } -> std::same_as<void>;
  { f.receive(out) } -> std::same_as<void>;
  { f.transmit(in) } -> std::same_as<std::size_t>;
  { f.elapse(passed) } -> std::same_as<void>;
  { c.attached() } -> std::same_as<bool>;
};

/// The cable to a simulated far side. Its clock advances only while somebody waits in read(), in
/// steps of one USB microframe.
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

  /// Lets time pass with nobody reading.
  void pass(nanoseconds passed) noexcept {
    now_ += passed;
    far_.elapse(passed);
  }

  /// The far side itself.
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
  std::size_t first_ = 0, end_ = 0;  ///< the payload in it
  ftdi::line_status lines_{};
  nanoseconds now_{0};
  bool open_ = false;
};

}  // namespace falcon
}  // namespace v0
}  // namespace passive_haptics
