// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One question, one answer: a packet out, the packet that answers it back, or a miss.
//
// Packets carry no number, so an answer that comes too late would pass for the next one's, and all
// after it would be a tick old for ever. Therefore: what has come before the question is thrown
// away, and after a miss the line must first be quiet for `silence`.

#include <passive_haptics/falcon/transport.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace falcon {

/// What the line has been through since open().
struct link_counts {
  std::uint64_t replies = 0;
  std::uint64_t misses = 0;         ///< questions without an answer
  std::uint32_t misses_in_row = 0;  ///< up to now
  std::uint32_t stale = 0;          ///< answers that came too late, or twice
  std::uint32_t broken = 0;         ///< packets begun and not finished
};

struct [[nodiscard]] link_answer {
  result how{};
  from_device packet{};  ///< when ok
  nanoseconds asked{};   ///< when the question was out: the encoders are read, the words held
  nanoseconds stamp{};   ///< when it was there, or was given up
};

template <transport Transport>
class packet_link {
 public:
  static constexpr nanoseconds silence = std::chrono::milliseconds(2);    ///< two latency periods
  static constexpr nanoseconds patience = std::chrono::milliseconds(20);  ///< with the silence

  explicit packet_link(Transport& line) noexcept : line_(line) {}

  /// Sends the packet and waits, no longer than `most`, for its answer.
  link_answer exchange(const to_device& packet, nanoseconds most) noexcept {
    if (const result clear = unsettled_ ? await_silence() : drain(); !clear) return miss(clear);
    if (const result sent = send(packet, most); !sent) return miss(sent);
    const nanoseconds asked = line_.now();
    for (;;) {
      const arrival came = take(asked + most);
      if (!came.how) return miss(came.how, asked);
      if (came.packets == 0) continue;
      unsettled_ = false;
      counts_.stale += came.packets - 1;
      counts_.misses_in_row = 0;
      ++counts_.replies;
      return {{}, came.last, asked, came.stamp};
    }
  }

  /// Sends the packet; its answer will be thrown away.
  result send(const to_device& packet, nanoseconds most) noexcept {
    const packet_bytes bytes = encode(packet);
    parser_.reset();
    unsettled_ = true;
    return line_.write(bytes, line_.now() + most);
  }

  [[nodiscard]] link_counts counts() const noexcept {
    link_counts all = counts_;
    all.broken = parser_.broken();
    return all;
  }
  void forgive() noexcept { counts_.misses_in_row = 0; }

  void reset() noexcept {
    parser_ = {};
    counts_ = {};
    unsettled_ = false;
  }

 private:
  struct arrival {
    result how{};
    std::uint32_t packets = 0;
    from_device last{};
    nanoseconds stamp{};
  };

  /// One read() through the parser.
  [[nodiscard]] arrival take(nanoseconds deadline) noexcept {
    std::array<byte, ftdi::usb_packet> bytes{};
    const transfer got = line_.read(bytes, deadline);
    arrival came{got.how, 0, {}, got.stamp};
    if (!got.how) return came;
    for (const byte b : std::span(bytes).first(got.bytes)) {
      if (const auto packet = parser_.push(b)) {
        ++came.packets;
        came.last = *packet;
      }
    }
    return came;
  }

  /// Throws away all that is there.
  [[nodiscard]] result drain() noexcept {
    for (int most = 64; most > 0; --most) {  // a line that babbles for ever is read no further
      const arrival came = take(line_.now());
      if (came.how.what == code::timeout) return {};
      if (!came.how) return came.how;
      counts_.stale += came.packets;
    }
    return {};
  }

  [[nodiscard]] result await_silence() noexcept {
    const nanoseconds end = line_.now() + patience;
    while (line_.now() < end) {
      const arrival came = take((std::min)(end, line_.now() + silence));
      if (came.how.what == code::timeout) return {};
      if (!came.how) return came.how;
      counts_.stale += came.packets;
    }
    return {};
  }

  [[nodiscard]] link_answer miss(const result& how, nanoseconds asked) noexcept {
    ++counts_.misses;
    ++counts_.misses_in_row;
    return {how, {}, asked, line_.now()};
  }
  [[nodiscard]] link_answer miss(const result& how) noexcept { return miss(how, line_.now()); }

  Transport& line_;
  packet_parser<from_device> parser_;
  link_counts counts_{};
  bool unsettled_ = false;  ///< an answer may still be on its way
};

}  // namespace falcon
}  // namespace v0
}  // namespace passive_haptics
