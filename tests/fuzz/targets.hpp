// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What must hold for ANY bytes from the cable. Each function returns null, or what broke.
#include "fuzz/reader.hpp"
#include <passive_haptics/falcon/boot.hpp>
#include <passive_haptics/falcon/device.hpp>
#include <passive_haptics/falcon/in_memory_transport.hpp>

namespace fuzz {

namespace falcon = passive_haptics::falcon;

/// Answers with what the input says: raw transfers, well-formed replies, echoes, silence.
class far_side {
 public:
  explicit far_side(input bytes) noexcept : script_(bytes) {}

  void control(falcon::request r, std::uint16_t value) noexcept {
    if (r == falcon::request::baud) loading_ = value != falcon::ftdi::program_baud;
  }

  void receive(input bytes) noexcept {
    ++writes;
    if (loading_) {
      const std::size_t n = std::min(bytes.size(), echo_.size());
      std::copy_n(bytes.begin(), n, echo_.begin());
      echoes_ = n;
    }
    for (const falcon::byte b : bytes) {
      const auto packet = loading_ ? std::nullopt : sent_.push(b);
      if (!packet) continue;
      last = packet->motor;
      for (const int word : packet->motor) in_range = in_range && word >= -4095 && word <= 4095;
    }
  }

  std::size_t transmit(std::span<falcon::byte> into) noexcept {
    if (script_.empty()) return 0;
    const falcon::byte what = script_.one();
    std::size_t n = 0;
    const auto put = [&](falcon::byte b) {
      if (n % 64 == 0) {
        into[n++] = script_.one();
        into[n++] = 0x60;
      }
      into[n++] = b;
    };
    switch (what & 7) {
      case 0:
        return 0;
      case 1:  // whatever the bus may carry
        for (std::size_t length = 4 * script_.one(); n < length && n < into.size();) {
          into[n++] = script_.one();
        }
        return n;
      case 2:
        unplugged_ = (what & 0xF0) == 0xF0;
        return 0;
      case 3:
      case 4:
      case 5: {
        falcon::from_device reply{.buttons = 0, .homed = 7};
        for (auto& count : reply.encoder) {
          count = (what & 8) != 0 ? script_.any<std::int16_t>()
                                  : static_cast<std::int16_t>(script_.one() - 128);
        }
        if ((what & 0x30) == 0x30) reply.homed = script_.one() & 7;
        for (const falcon::byte b : falcon::encode(reply)) put(b);
        return n;
      }
      case 6:
        for (const char c : {'\n', 'D', ',', '\r'}) put(static_cast<falcon::byte>(c));
        return n;
      default:
        for (std::size_t i = 0; i < echoes_; ++i) put(echo_[i]);
        if (what == 0xFF && n > 2) into[n - 1] ^= 1;
        echoes_ = 0;
        return n;
    }
  }

  void elapse(falcon::nanoseconds /*passed*/) noexcept {}
  [[nodiscard]] bool attached() const noexcept { return !unplugged_; }

  falcon::leg_words last{};  ///< what the motors hold
  bool in_range = true;
  long writes = 0;

 private:
  reader script_;
  falcon::packet_parser<falcon::to_device> sent_;
  std::array<falcon::byte, 64> echo_{};
  std::size_t echoes_ = 0;
  bool loading_ = false, unplugged_ = false;
};

/// Every packet found stands in the input; the first good one after it is found, and the second.
inline const char* parser(input bytes) noexcept {
  using falcon::packet_size;
  falcon::packet_parser<falcon::from_device> parser;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const auto found = parser.push(bytes[i]);
    if (!found) continue;
    if (i + 1 < packet_size) return "a packet from less than 16 bytes";
    auto again = falcon::encode(*found);
    const auto there = bytes.subspan(i + 1 - packet_size, packet_size);
    again[14] = there[14];  // unknown, not kept
    if (!std::equal(again.begin(), again.end(), there.begin())) return "a packet that is not there";
  }
  const auto good = falcon::encode(falcon::from_device{.encoder = {-1, 2, -300}, .homed = 7});
  int found = 0;
  for (int n = 0; n < 2; ++n) {
    for (const falcon::byte b : good) found += parser.push(b) ? 1 : 0;
  }
  return found == 2 ? nullptr : "not in step at once";
}

/// A boot ends, with a report that makes sense.
inline const char* boot(input bytes) noexcept {
  reader head(bytes);
  falcon::boot_options options;
  options.policy = static_cast<falcon::firmware_policy>(head.one() % 4);
  options.attempts = 1 + head.one() % 3;
  options.hellos = options.probe.questions = 2;
  options.answer = options.probe.reply = options.clear_to_send = std::chrono::milliseconds(2);
  // key, reserved, entry, one block of 60 words, end
  std::array<falcon::byte, 2 * (11 + 3 + 60 + 1)> image{0xAA, 0x08};
  image[22] = 60;
  const std::size_t used = std::min<std::size_t>(bytes.size(), 2);
  falcon::in_memory_transport<far_side> line{bytes.subspan(used)};
  if (!line.open()) return "does not open";
  const auto report = falcon::bootloader{line, input(image), options}.run();
  if (line.now() > std::chrono::seconds(5)) return "a boot without end";
  if (report.attempts > options.attempts) return "more attempts than allowed";
  if (report.echoed > image.size()) return "more echo than image";
  if (report.how && report.attempts > 0 && report.echoed != image.size()) {
    return "loaded without all of the echo";
  }
  if (!line.peer().in_range) return "a word out of range";
  return line.peer().last == falcon::leg_words{} ? nullptr : "a force while booting";
}

/// No force but in `homed`, no word out of range, no sample that is not finite, whatever is
/// commanded and whatever is answered.
inline const char* device(input bytes) noexcept {
  using line_type = falcon::in_memory_transport<far_side>;
  const std::size_t half = bytes.size() / 2;
  reader forces(bytes.first(half));
  const falcon::settings<double> setup{.ramp = 0.002, .settle = 2, .most_misses = 4};
  falcon::device<line_type> grip{falcon::cautious_gain<double>, setup, bytes.subspan(half)};
  const auto& box = grip.line().peer();
  const auto runs = [](auto&) { return falcon::result{}; };
  if (!grip.open() || !grip.start(runs)) return "does not start";
  for (int n = 0; n < 200 && !forces.empty(); ++n) {
    const int what = forces.one();
    const bool raw = (what & 1) != 0;
    const auto next = [&] { return raw ? forces.any<double>() : forces.one() / 16.0 - 8.0; };
    const passive_haptics::space<double, 3>::vector wanted(next(), next(), next());
    const auto sample = grip.exchange(wanted);
    if (!wanted.allFinite() && grip.where() != falcon::state::fault) return "took what is no force";
    if ((what & 0xE0) == 0xE0) (void)grip.recover();
    for (std::size_t i = 0; i < 3; ++i) {
      if (!std::isfinite(sample.position[i]) || !std::isfinite(sample.held[i])) {
        return "a sample that is not finite";
      }
    }
    if (!std::isfinite(sample.dt) || sample.dt < 0.0) return "time that runs backwards";
    if (!box.in_range) return "a word out of range";
    const bool force = box.last != falcon::leg_words{};
    if (force && box.attached() && grip.where() != falcon::state::homed) {
      return "a force outside of homed";
    }
    if (force && box.attached() && !sample.valid) return "a force without a position";
  }
  (void)grip.close();
  if (box.attached() && box.last != falcon::leg_words{}) return "a force after closing";
  return nullptr;
}

}  // namespace fuzz
