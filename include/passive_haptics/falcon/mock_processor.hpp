// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The processor of a simulated Falcon, byte for byte as on the wire:
//
//   DTR rises ─▶ monitor ──"\nC\r"──▶ autobaud ──'A'──▶ loading ──zero length──▶ running ⟲ packets
//                9600 Bd              142 857 Bd        echoes every byte        1.5 MBd
//
// Bytes at another speed than that of the stage are lost, as on a real line. Only the frame of the image is
// checked (boot.hpp), not its content: any well-formed stream "runs".

#include <passive_haptics/falcon/in_memory_transport.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace falcon {

/// The ROM loader's reading of a boot stream: header, blocks, a zero length.
class mock_loader {
 public:
  enum class state : byte { loading, loaded, refused };

  constexpr state push(byte b) noexcept {
    if (now_ != state::loading) return now_;
    if (!high_) {
      low_ = b;
      high_ = true;
    } else {
      high_ = false;
      take(static_cast<std::uint32_t>(low_ | b << 8));
    }
    return now_;
  }

 private:
  static constexpr std::uint32_t header = 11, address = 2;  ///< words

  constexpr void take(std::uint32_t word) noexcept {
    if (words_++ == 0) {
      if (word != 0x08AA) now_ = state::refused;
    } else if (words_ > header && left_ == 0) {
      left_ = word == 0 ? 0 : address + word;
      if (word == 0) now_ = state::loaded;
    } else if (left_ > 0) {
      --left_;
    }
  }

  state now_ = state::loading;
  byte low_ = 0;
  bool high_ = false;        ///< the next byte is the high one
  std::uint32_t words_ = 0;  ///< number of words read
  std::uint32_t left_ = 0;   ///< words left of the block
};

/// `Mechanism` has hold(words), encoder() and homed(); see mock_mechanism.hpp.
template <class Mechanism>
class mock_processor {
 public:
  enum class stage : byte { idle, monitor, autobaud, loading, running };

  explicit mock_processor(bool runs) noexcept : now_(runs ? stage::running : stage::idle) {}

  void control(request r, std::uint16_t value, Mechanism& arms) noexcept {
    out_.control(r, value);
    if (r == request::baud) divisor_ = value;
    if (r == request::modem && (value & 0x0100) != 0) {
      const bool up = (value & 1) != 0;
      if (up && !dtr_) reset(arms);
      dtr_ = up;
      out_.lines.modem = static_cast<byte>(!up && now_ == stage::autobaud ? 0x11 : 0x01);
    }
  }

  void receive(std::span<const byte> bytes, Mechanism& arms) noexcept {
    for (const byte b : bytes) {
      if (divisor_ == ftdi::monitor_baud) {
        greet(b);
      } else if (divisor_ == ftdi::loader_baud) {
        load(b);
      } else if (divisor_ == ftdi::program_baud && now_ == stage::running) {
        if (const auto packet = parser_.push(b)) answer(*packet, arms);
      }
    }
  }

  [[nodiscard]] std::size_t transmit(std::span<byte> into) noexcept { return out_.transmit(into); }
  void elapse(nanoseconds passed) noexcept { out_.elapse(passed); }

  void press(byte buttons) noexcept { buttons_ = buttons; }  ///< values of `button`, or-ed

  [[nodiscard]] stage where() const noexcept { return now_; }
  [[nodiscard]] std::uint32_t packets() const noexcept { return packets_; }  ///< number answered
  [[nodiscard]] lamps light() const noexcept { return light_; }

 private:
  void reset(Mechanism& arms) noexcept {
    now_ = stage::monitor;
    greeting_ = {};
    parser_.reset();
    arms.hold({});
  }

  void greet(byte b) noexcept {
    constexpr std::array<byte, 3> wanted{'\n', 'C', '\r'};
    constexpr std::array<byte, 4> reply{'\n', 'D', ',', '\r'};
    if (now_ != stage::monitor && now_ != stage::autobaud) return;
    greeting_ = {greeting_[1], greeting_[2], b};
    if (greeting_ != wanted) return;
    out_.push(reply);
    now_ = stage::autobaud;
  }

  void load(byte b) noexcept {
    if (now_ == stage::autobaud && b == 'A') {
      loader_ = {};
      now_ = stage::loading;
      out_.push(b);
    } else if (now_ == stage::loading) {
      out_.push(b);
      if (loader_.push(b) == mock_loader::state::loaded) now_ = stage::running;
    }
  }

  void answer(const to_device& packet, Mechanism& arms) noexcept {
    ++packets_;
    light_ = packet.light;
    out_.push(encode(from_device{.encoder = arms.encoder(),
                                 .buttons = buttons_,
                                 .homed = packet.homing ? arms.homed() : byte(0)}));
    arms.hold(packet.motor);
  }

  ftdi::sender out_;
  stage now_;
  std::uint16_t divisor_ = 0;
  bool dtr_ = false;
  std::array<byte, 3> greeting_{};
  mock_loader loader_;
  packet_parser<to_device> parser_;
  byte buttons_ = 0;
  lamps light_ = lamps::none;
  std::uint32_t packets_ = 0;
};

}  // namespace falcon
}  // namespace v0
}  // namespace passive_haptics
