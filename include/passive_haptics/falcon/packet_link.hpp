// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Exchanges one packet for one answer, or reports a miss.
//
// Packets carry no number, so a late answer would be taken for the answer to the next packet, and all later answers
// would be a tick old. Therefore bytes that came before the question are discarded, and after a miss the next question
// waits until the line has been quiet for `silence`.

#include <passive_haptics/falcon/transport.hpp>

#include <initializer_list>

namespace passive_haptics {
inline namespace v0 {
namespace falcon {

/// Counts since open().
struct link_counts {
  std::uint64_t replies = 0;        ///< questions with an answer
  std::uint64_t misses = 0;         ///< questions without an answer
  std::uint32_t misses_in_row = 0;  ///< the last questions without an answer
  std::uint32_t stale = 0;          ///< answers that came too late, or twice
  std::uint32_t broken = 0;         ///< packets begun and not finished
};

struct [[nodiscard]] link_answer {
  result how{};
  from_device packet{};  ///< when ok
  nanoseconds asked{};   ///< when the question was sent: encoders are read and words held from then
  nanoseconds stamp{};   ///< when the answer had arrived, or the wait for it ended
};

/// The questions that find out whether a program runs.
struct probing {
  int questions = 10;                                 ///< most questions to send
  nanoseconds reply = std::chrono::milliseconds(30);  ///< longest wait for each answer
  bool flush_on_closing = false;  ///< '>' is the event character: may exceed 1 kHz, not tested
};

namespace detail {

struct chip_setting {
  request what;
  std::uint16_t value;
};

/// Makes one setting after the other, until one fails.
template <transport Transport>
[[nodiscard]] result set(Transport& line, std::initializer_list<chip_setting> all) noexcept {
  for (const auto& [what, value] : all) {
    if (const result done = line.control(what, value); !done) return done;
  }
  return {};
}

}  // namespace detail

template <transport Transport>
class packet_link {
 public:
  static constexpr nanoseconds silence = std::chrono::milliseconds(2);    ///< two latency periods
  static constexpr nanoseconds patience = std::chrono::milliseconds(20);  ///< longest wait for it

  explicit packet_link(Transport& line) noexcept : line_(line) {}

  /// Asks for a program that answers packets at 1.5 MBd. Returns ok, no_program, a fault of the line, or the
  /// result of `go(n)`, which is called before question n, if that is not ok. The homing bit is set, so that a
  /// homed device stays so.
  template <class Go>
  result find_program(const probing& how, const Go& go) noexcept {
    const std::uint16_t event = ftdi::event_character_on | detail::closing;
    const result ready = detail::set(
        line_, {{request::latency_timer, 1},
                {request::data, ftdi::eight_bits},
                {request::flow_control, 0},
                {request::event_character, how.flush_on_closing ? event : std::uint16_t(0)},
                {request::baud, ftdi::program_baud},
                {request::reset, ftdi::purge_receive},
                {request::reset, ftdi::purge_transmit}});
    if (!ready) return ready;
    for (int n = 0; n < how.questions; ++n) {
      if (const result on = go(n); !on) return on;
      const result answered = exchange(to_device{}, how.reply).how;
      // After a miss, an answer on its way would be taken for the answer to the next question.
      if (answered) return n == 0 ? result{} : clear(silence);
      if (answered.what != code::timeout) return answered;
    }
    return {code::no_program};
  }

  /// Sends the packet and waits, no longer than `most`, for its answer.
  link_answer exchange(const to_device& packet, nanoseconds most) noexcept {
    if (const result cleared = clear(unsettled_ ? silence : nanoseconds(0)); !cleared) {
      return miss(cleared, line_.now());
    }
    if (const result sent = send(packet, most); !sent) return miss(sent, line_.now());
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

  /// Passes the bytes of one read() to the parser.
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

  /// Throws away all bytes until none has come for `quiet`. It gives up after 64 reads or `patience`, so a line
  /// that never falls silent does not block it.
  [[nodiscard]] result clear(nanoseconds quiet) noexcept {
    const nanoseconds end = line_.now() + patience;
    for (int most = 64; most > 0 && line_.now() < end; --most) {
      const arrival came = take((std::min)(end, line_.now() + quiet));
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

  Transport& line_;
  packet_parser<from_device> parser_;
  link_counts counts_{};
  bool unsettled_ = false;  ///< an answer may still be on its way
};

}  // namespace falcon
}  // namespace v0
}  // namespace passive_haptics
