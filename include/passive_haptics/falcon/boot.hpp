// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Loads the program that makes a Falcon answer packets: the Falcon forgets its program at every power-off.
//
//   probe    1.5 MBd    packet ─▶                ◀─ packet          is a program running?
//   hello    9600 Bd    DTR up, "\nC\r" ─▶       ◀─ "\nD,\r"        the monitor, perhaps after a 0
//   loader   143 kBd    DTR down, CTS?, 'A' ─▶   ◀─ 'A'             the ROM finds the baud rate
//   image    143 kBd    62 bytes ─▶              ◀─ the same 62     every byte is echoed
//   program  1.5 MBd    packet ─▶                ◀─ packet          it runs
//
// The sequence is that of the open drivers. Only one user has reported that CTS rises when the loader is ready, so
// the driver waits for CTS up to boot_options::clear_to_send and then goes on without it. Loading often fails, and
// is then repeated from the beginning. Every wait has a deadline.
//
// The program is a boot stream for the ROM of the Falcon's TI C28x. The images are the maker's, and none is
// shipped here: the user names a file, which is checked before a byte of it is sent:
//
//   word 0      0x08AA, the key          words 1-8   reserved        words 9, 10   entry, high first
//   then blocks {length, address high, address low, length × data}, and a length 0 at the very end
//
// Words are 16 bits, the low byte first.

#include <passive_haptics/base/no_unique_address.hpp>
#include <passive_haptics/falcon/packet_link.hpp>

#include <cstdio>

namespace passive_haptics {
inline namespace v0 {
namespace falcon {

struct image_summary {
  result how{};             ///< ok, or the fault and its place in the stream
  std::uint32_t entry = 0;  ///< address at which the program starts
  std::uint32_t blocks = 0;
  std::uint32_t words = 0;  ///< words of data in all blocks
};

/// Checks the frame of the whole boot stream, and not the content of its blocks.
[[nodiscard]] constexpr image_summary check_image(std::span<const byte> image) noexcept {
  constexpr unsigned key = 0x08AA;
  constexpr std::size_t header = 2 * 11;  // key, reserved, entry
  if (image.empty()) return {{code::image_missing}};
  const auto word = [&image](std::size_t at) {
    return static_cast<std::uint32_t>(image[at] | image[at + 1] << 8);
  };
  const auto at_byte = [](code c, std::size_t at) {
    return result{c, static_cast<std::int64_t>(at)};
  };
  if (image.size() >= 2 && word(0) != key) return {{code::image_wrong_key, word(0)}};
  if (image.size() < header + 2) return {at_byte(code::image_truncated, 0)};
  image_summary seen{{}, word(18) << 16 | word(20)};
  std::size_t at = header;
  while (at + 2 <= image.size()) {
    const std::uint32_t length = word(at);
    if (length == 0) {
      if (at + 2 != image.size()) seen.how = at_byte(code::image_trailing, at + 2);
      return seen;
    }
    const std::size_t next = at + 2 + 4 + 2 * static_cast<std::size_t>(length);
    if (next + 2 > image.size()) break;
    ++seen.blocks;
    seen.words += length;
    at = next;
  }
  seen.how = at_byte(code::image_truncated, at);
  return seen;
}

/// An image read from a file. It takes 40 kB: keep it off a small stack.
class firmware {
 public:
  static constexpr std::size_t capacity = 40 * 1024;  ///< the chip has 36 kB of memory

  /// Reads and checks the file.
  result load(const char* path) noexcept {
    size_ = 0;
    std::FILE* file = path != nullptr ? std::fopen(path, "rb") : nullptr;
    if (file == nullptr) return {code::image_unreadable};
    const std::size_t read = std::fread(bytes_.data(), 1, bytes_.size(), file);
    const bool failed = std::ferror(file) != 0;
    const bool more = read == bytes_.size() && std::fgetc(file) != EOF;
    std::fclose(file);
    if (failed) return {code::image_unreadable};
    if (more) return {code::image_too_long, static_cast<std::int64_t>(capacity)};
    const result sound = check_image(std::span(bytes_).first(read)).how;
    if (sound) size_ = read;
    return sound;
  }

  /// The bytes of the image; empty until a load() has succeeded.
  [[nodiscard]] std::span<const byte> bytes() const noexcept {
    return std::span(bytes_).first(size_);
  }

 private:
  std::array<byte, capacity> bytes_{};
  std::size_t size_ = 0;
};

enum class firmware_policy : byte {
  probe_then_load,  ///< load only if nothing answers
  always_load,      ///< do not probe, because a probe is reported to spoil the next load
  never_load,       ///< probe only
  assume_running,   ///< neither probe nor load: for replays
};

enum class boot_step : byte { probe, hello, loader, image, program };

[[nodiscard]] constexpr const char* to_string(boot_step s) noexcept {
  constexpr std::array names{"probe", "hello", "loader", "image", "program"};
  const auto i = static_cast<std::size_t>(s);
  return i < names.size() ? names[i] : "unknown step";
}

struct boot_options {
  firmware_policy policy = firmware_policy::probe_then_load;
  int attempts = 10;                                    ///< to load the image; users report 1 to 10
  int hellos = 10;                                      ///< greetings in each attempt
  nanoseconds answer = std::chrono::milliseconds(100);  ///< longest wait for monitor and loader
  nanoseconds clear_to_send = std::chrono::milliseconds(200);  ///< longest wait for CTS
  probing probe{};                                             ///< questions of the probe
};

struct boot_report {
  result how{};
  boot_step step = boot_step::probe;  ///< the last step taken
  int attempts = 0;                   ///< number of attempts to load
  std::size_t echoed = 0;             ///< bytes of the image echoed in the last attempt
  bool clear_to_send = false;         ///< CTS had risen before the loader was called
};

/// The default of Progress, which may be any callable bool(boot_step, done, all); false cancels the boot.
struct no_progress {
  constexpr bool operator()(boot_step /*step*/, std::size_t /*done*/,
                            std::size_t /*all*/) const noexcept {
    return true;
  }
};

/// Boots once over an open transport.
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
  /// True for a result after which another attempt cannot help.
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

  [[nodiscard]] result send(std::span<const byte> bytes) noexcept {
    return line_.write(bytes, line_.now() + options_.answer);
  }

  [[nodiscard]] result find_program(boot_step step) noexcept {
    const auto all = static_cast<std::size_t>(options_.probe.questions);
    return packet_link(line_).find_program(options_.probe, [&](int n) noexcept {
      return begin(step, static_cast<std::size_t>(n), all);
    });
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
    if (const result done =
            detail::set(line_, {{request::reset, ftdi::purge_receive},
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
    if (const result done = detail::set(
            line_, {{request::modem, ftdi::dtr_low}, {request::baud, ftdi::loader_baud}});
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

/// Boots an open device: open → booting → unhomed, or back to open. It may take seconds.
///     const auto report = boot(grip, image.bytes());
template <class Device, class Progress = no_progress>
boot_report boot(Device& grip, std::span<const byte> image, const boot_options& options = {},
                 const Progress& progress = {}) noexcept {
  boot_report report;
  report.how = grip.start([&](auto& line) noexcept {
    report = bootloader{line, image, options, progress}.run();
    return report.how;
  });
  return report;
}

}  // namespace falcon
}  // namespace v0
}  // namespace passive_haptics
