// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// From a device that may hold no program to one that answers packets.
//
//   probe    1.5 MBd    packet ─▶                ◀─ packet          is a program running?
//   hello    9600 Bd    DTR up, "\nC\r" ─▶       ◀─ "\nD,\r"        the monitor, perhaps a 0 first
//   loader   143 kBd    DTR down, CTS?, 'A' ─▶   ◀─ 'A'             the ROM finds the baud rate
//   image    143 kBd    62 bytes ─▶              ◀─ the same 62     every byte is echoed
//   program  1.5 MBd    packet ─▶                ◀─ packet          it runs
//
// The sequence is the one of the open drivers; that CTS rises when the loader is ready is one user's
// report, so it is waited for, not insisted on. Loading is flaky in practice: it is tried again from
// the top. No call waits without end.

#include <passive_haptics/base/no_unique_address.hpp>
#include <passive_haptics/falcon/boot_options.hpp>
#include <passive_haptics/falcon/firmware.hpp>
#include <passive_haptics/falcon/transport.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace falcon {

/// One boot over an open transport.
///     const auto report = bootloader{usb, image.bytes(), options}.run();
template <transport Transport, class Progress = no_progress>
class bootloader {
 public:
  static constexpr std::size_t chunk = ftdi::payload_size;  ///< its echo fits one USB packet

  bootloader(Transport& line, std::span<const byte> image, const boot_options& options = {},
             Progress progress = {}) noexcept
      : line_(line), image_(image), options_(options), progress_(progress) {}

  boot_report run() noexcept {
    if (options_.policy == firmware_policy::assume_running) return end({});
    if (options_.policy != firmware_policy::always_load) {
      const result running = find_program(boot_step::probe);
      if (running || final(running)) return end(running);
      if (options_.policy == firmware_policy::never_load) return end(running);
    }
    result how = check_image(image_).how;
    if (!how) return end(how);
    how = {code::no_hello};
    while (report_.attempts < options_.attempts) {
      ++report_.attempts;
      how = load();
      if (how) how = find_program(boot_step::program);
      if (how || final(how)) break;
    }
    return end(how);
  }

 private:
  /// Another attempt cannot help.
  [[nodiscard]] static constexpr bool final(const result& r) noexcept {
    return r.what == code::unplugged || r.what == code::not_open || r.what == code::cancelled;
  }

  boot_report end(const result& how) noexcept {
    report_.how = how;
    return report_;
  }

  [[nodiscard]] result begin(boot_step step, std::size_t done, std::size_t all) noexcept {
    report_.step = step;
    return progress_(step, done, all) ? result{} : result{code::cancelled};
  }

  struct setting {
    request what;
    std::uint16_t value;
  };
  template <std::size_t N>
  [[nodiscard]] result set(const setting (&settings)[N]) noexcept {
    for (const auto& [what, value] : settings) {
      if (const result done = line_.control(what, value); !done) return done;
    }
    return {};
  }

  [[nodiscard]] result send(std::span<const byte> bytes) noexcept {
    return line_.write(bytes, line_.now() + options_.answer);
  }

  /// A program answers packets at 1.5 MBd. The homing bit is set, lest a homed device forget.
  [[nodiscard]] result find_program(boot_step step) noexcept {
    const std::uint16_t event = ftdi::event_character_on | detail::closing;
    if (const result done =
            set({{request::latency_timer, 1},
                 {request::data, ftdi::eight_bits},
                 {request::flow_control, 0},
                 {request::event_character, options_.flush_on_closing ? event : std::uint16_t(0)},
                 {request::baud, ftdi::program_baud},
                 {request::reset, ftdi::purge_receive},
                 {request::reset, ftdi::purge_transmit}});
        !done) {
      return done;
    }
    packet_parser<from_device> parser;
    const packet_bytes question = encode(to_device{});
    for (int i = 0; i < options_.probes; ++i) {
      const auto all = static_cast<std::size_t>(options_.probes);
      if (const result go = begin(step, static_cast<std::size_t>(i), all); !go) return go;
      if (const result sent = send(question); !sent) return sent;
      const nanoseconds deadline = line_.now() + options_.reply;
      std::array<byte, ftdi::usb_packet> bytes{};
      for (;;) {
        const transfer got = line_.read(bytes, deadline);
        if (got.how.what == code::timeout) break;
        if (!got.how) return got.how;
        for (const byte b : std::span(bytes).first(got.bytes)) {
          if (parser.push(b)) return i == 0 ? result{} : await_silence();
        }
      }
    }
    return {code::no_program};
  }

  /// More than one probe was sent: an answer that is still on its way would pass for the first question's.
  [[nodiscard]] result await_silence() noexcept {
    constexpr nanoseconds silence = std::chrono::milliseconds(2);  // two latency periods
    const nanoseconds end = line_.now() + options_.reply;
    std::array<byte, ftdi::usb_packet> bytes{};
    while (line_.now() < end) {
      const transfer got = line_.read(bytes, (std::min)(end, line_.now() + silence));
      if (got.how.what == code::timeout) break;
      if (!got.how) return got.how;
    }
    return {};
  }

  [[nodiscard]] result load() noexcept {
    report_.echoed = 0;
    report_.clear_to_send = false;
    if (const result met = hello(); !met) return met;
    if (const result locked = call_loader(); !locked) return locked;
    return send_image();
  }

  [[nodiscard]] result hello() noexcept {
    constexpr std::array<byte, 3> greeting{'\n', 'C', '\r'};
    constexpr std::array<byte, 4> reply{'\n', 'D', ',', '\r'};
    if (const result done = set({{request::reset, ftdi::purge_receive},
                                 {request::reset, ftdi::purge_transmit},
                                 {request::latency_timer, 16},  // the monitor fails with less
                                 {request::baud, ftdi::monitor_baud},
                                 {request::data, ftdi::eight_bits},
                                 {request::flow_control, 0},
                                 {request::event_character, 0},
                                 {request::modem, ftdi::rts_low},
                                 {request::modem, ftdi::dtr_low},
                                 {request::modem, ftdi::dtr_high}});
        !done) {
      return done;
    }
    for (int i = 0; i < options_.hellos; ++i) {
      const auto all = static_cast<std::size_t>(options_.hellos);
      if (const result go = begin(boot_step::hello, static_cast<std::size_t>(i), all); !go) {
        return go;
      }
      if (const result sent = send(greeting); !sent) return sent;
      const result answered = await(reply, code::no_hello);
      if (answered || answered.what != code::no_hello) return answered;
    }
    return {code::no_hello};
  }

  [[nodiscard]] result call_loader() noexcept {
    constexpr std::array<byte, 1> lock{'A'};
    if (const result go = begin(boot_step::loader, 0, 1); !go) return go;
    if (const result done =
            set({{request::modem, ftdi::dtr_low}, {request::baud, ftdi::loader_baud}});
        !done) {
      return done;
    }
    if (const result waited = await_clear_to_send(); !waited) return waited;
    if (const result sent = send(lock); !sent) return sent;
    return await(lock, code::no_loader);
  }

  [[nodiscard]] result await_clear_to_send() noexcept {
    constexpr nanoseconds fresh = std::chrono::milliseconds(20);  // a latency period: new status
    const nanoseconds deadline = line_.now() + options_.clear_to_send;
    do {
      std::array<byte, ftdi::usb_packet> ignored{};
      const transfer got = line_.read(ignored, line_.now() + fresh);
      if (!got.how && got.how.what != code::timeout) return got.how;
    } while (!line_.lines().clear_to_send() && line_.now() < deadline);
    report_.clear_to_send = line_.lines().clear_to_send();
    return {};
  }

  [[nodiscard]] result send_image() noexcept {
    while (report_.echoed < image_.size()) {
      if (const result go = begin(boot_step::image, report_.echoed, image_.size()); !go) return go;
      const auto part = image_.subspan(report_.echoed);
      const auto sent = part.first((std::min)(chunk, part.size()));
      if (const result done = send(sent); !done) return done;
      if (const result same = compare_echo(sent); !same) return same;
    }
    return {};
  }

  [[nodiscard]] result compare_echo(std::span<const byte> sent) noexcept {
    const nanoseconds deadline = line_.now() + options_.answer;
    std::array<byte, chunk> echo{};
    for (std::size_t at = 0; at < sent.size();) {
      const transfer got = line_.read(std::span(echo).first(sent.size() - at), deadline);
      if (got.how.what == code::timeout) return {code::echo_missing, at_byte()};
      if (!got.how) return got.how;
      for (std::size_t i = 0; i < got.bytes; ++i, ++at) {
        if (echo[i] != sent[at]) return {code::echo_mismatch, at_byte()};
        ++report_.echoed;
      }
    }
    return {};
  }
  [[nodiscard]] std::int64_t at_byte() const noexcept {
    return static_cast<std::int64_t>(report_.echoed);
  }

  /// Reads until the bytes `wanted` have come, in that order, whatever comes before them.
  [[nodiscard]] result await(std::span<const byte> wanted, code otherwise) noexcept {
    const nanoseconds deadline = line_.now() + options_.answer;
    std::size_t matched = 0;
    while (matched < wanted.size()) {
      std::array<byte, 1> next{};
      const transfer got = line_.read(next, deadline);
      if (got.how.what == code::timeout) return {otherwise};
      if (!got.how) return got.how;
      if (next[0] != wanted[matched]) matched = 0;  // no wanted text repeats its first byte
      if (next[0] == wanted[matched]) ++matched;
    }
    return {};
  }

  Transport& line_;
  std::span<const byte> image_;
  boot_options options_;
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS Progress progress_;
  boot_report report_{};
};

}  // namespace falcon
}  // namespace v0
}  // namespace passive_haptics
