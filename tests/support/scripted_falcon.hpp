// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The far side of a Falcon's cable (monitor, C28x loader, program) with every fault that a test needs. It is
// independent of the library's own mock. It holds the last motor words that it was sent for ever, which is the
// worst behaviour of a device without a watchdog.
#include <passive_haptics/falcon/boot.hpp>
#include <passive_haptics/falcon/in_memory_transport.hpp>

#include <deque>
#include <functional>
#include <string>
#include <vector>

namespace falcon = passive_haptics::falcon;

/// A well-formed boot stream without any third party's bytes.
inline std::vector<falcon::byte> synthetic_image(unsigned words = 600) {
  std::vector<falcon::byte> image;
  const auto put = [&image](unsigned word) {
    image.push_back(static_cast<falcon::byte>(word & 255));
    image.push_back(static_cast<falcon::byte>(word >> 8 & 255));
  };
  const auto put_address = [&put](unsigned address) {
    put(address >> 16);
    put(address & 0xFFFF);
  };
  constexpr unsigned memory = 0x3F8002;
  put(0x08AA);
  for (int reserved = 0; reserved < 8; ++reserved) put(0);
  put_address(memory);
  const unsigned half = words / 2;
  for (const auto& [from, to] : {std::pair(0U, half), std::pair(half, words)}) {
    put(to - from);
    put_address(memory + from);
    for (unsigned i = from; i < to; ++i) put((i * 2654435761U >> 16) & 0xFFFF);
  }
  put(0);
  return image;
}

struct scripted_falcon {
  enum class mode { off, monitor, autobaud, loading, running };

  // what it is
  mode now = mode::off;
  falcon::leg_words encoder{};
  falcon::byte homed = 0, buttons = 0;

  // what goes wrong
  bool plugged = true;
  int deaf_hellos = 0;               ///< that get no answer
  bool leading_zero = false;         ///< before the answer
  bool mute_loader = false;          ///< never locks on
  bool insists_on_cts = false;       ///< ignores all that comes before CTS
  falcon::nanoseconds cts_after{0};  ///< DTR fell
  long wrong_echo_at = -1;           ///< of this byte of the image
  long silent_from = -1;             ///< this byte of the image on
  int broken_loads = 0;              ///< how many loads the last two apply to; 0: all
  bool dead_program = false;         ///< loads, and does not run
  std::function<void(scripted_falcon&, std::vector<falcon::byte>&)> on_reply;  ///< may spoil it
  long unplug_after = -1;  ///< calls of control and receive
  std::string late;        ///< comes by itself, at
  falcon::nanoseconds late_at{0};

  // what came
  std::vector<falcon::byte> image;
  falcon::to_device last{};
  std::vector<falcon::leg_words> motors;  ///< of every packet
  long packets = 0, calls = 0, loads = 0;
  falcon::nanoseconds clock{0};

  void control(falcon::request r, std::uint16_t value) {
    count();
    out.control(r, value);
    if (r == falcon::request::baud) divisor = value;
    if (r == falcon::request::modem && (value & 0x0100) != 0) {
      const bool rises = (value & 1) != 0;
      if (rises && !dtr) {
        now = mode::monitor;
        text.clear();
        out.lines.modem = 0x01;
      }
      if (!rises && dtr) dtr_fell = clock;
      dtr = rises;
    }
  }

  void receive(std::span<const falcon::byte> bytes) {
    count();
    for (const falcon::byte b : bytes) take(b);
  }

  std::size_t transmit(std::span<falcon::byte> into) { return out.transmit(into); }

  void elapse(falcon::nanoseconds passed) {
    clock += passed;
    out.elapse(passed);
    if (!late.empty() && clock >= late_at) {
      emit(late);
      late.clear();
    }
    if (!dtr && (now == mode::autobaud || now == mode::loading) && clock - dtr_fell >= cts_after) {
      out.lines.modem = 0x11;
    }
  }

  [[nodiscard]] bool attached() const noexcept { return plugged; }

  /// Sends the bytes as they are, whatever they are.
  void emit(const std::string& bytes) {
    for (const char c : bytes) out.push(static_cast<falcon::byte>(c));
  }

  falcon::ftdi::sender out;

 private:
  void count() {
    ++calls;
    if (unplug_after >= 0 && calls > unplug_after) plugged = false;
  }

  void take(falcon::byte b) {
    if (divisor == 0x4138 && now != mode::off) {
      text.push_back(static_cast<char>(b));
      if (text.size() >= 3 && text.substr(text.size() - 3) == "\nC\r") {
        text.clear();
        if (deaf_hellos > 0) {
          --deaf_hellos;
          return;
        }
        emit(leading_zero ? std::string("\0\nD,\r", 5) : std::string("\nD,\r"));
        now = mode::autobaud;
      }
    } else if (divisor == 0x0015) {
      if (insists_on_cts && (out.lines.modem & 0x10) == 0) return;
      if (now == mode::autobaud && b == 'A' && !mute_loader) {
        out.push(b);
        now = mode::loading;
        image.clear();
        ++loads;
      } else if (now == mode::loading) {
        load(b);
      }
    } else if (divisor == 0x0002 && now == mode::running) {
      if (const auto packet = parser.push(b)) answer(*packet);
    }
  }

  void load(falcon::byte b) {
    const long at = static_cast<long>(image.size());
    const bool bad = broken_loads == 0 || loads <= broken_loads;
    if (!(bad && silent_from >= 0 && at >= silent_from)) {
      out.push(bad && at == wrong_echo_at ? static_cast<falcon::byte>(b ^ 1) : b);
    }
    image.push_back(b);
    if (!falcon::check_image(image).how) return;
    now = dead_program ? mode::off : mode::running;
  }

  void answer(const falcon::to_device& packet) {
    last = packet;
    motors.push_back(packet.motor);
    ++packets;
    const auto bytes = falcon::encode(falcon::from_device{
        .encoder = encoder, .buttons = buttons, .homed = packet.homing ? homed : falcon::byte(0)});
    std::vector<falcon::byte> reply(bytes.begin(), bytes.end());
    if (on_reply) on_reply(*this, reply);
    out.push(reply);
  }

  std::uint16_t divisor = 0;
  bool dtr = false;
  falcon::nanoseconds dtr_fell{0};
  std::string text;
  falcon::packet_parser<falcon::to_device> parser;
};

static_assert(falcon::far_side<scripted_falcon>);
