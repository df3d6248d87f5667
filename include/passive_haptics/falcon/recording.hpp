// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Records the cable of a session, call by call, and plays it again.
// In a replay the same driver makes the same calls, and for a changed driver first_divergence() is the first other one.
//
//     device<recording_transport<libusb_transport>> grip{gain, {}, 200'000};       // rows
//     grip.line().record(true);  …  save("session.csv", grip.line().rows());
//
//     const auto log = load("session.csv");
//     device<replay_transport> again{gain, {}, std::span(log.rows)};
//     again.open();  boot(again, {}, {.policy = firmware_policy::assume_running});
//
// Of the bytes written only packets are kept, so no firmware gets into a log. There is a row per call, and there
// are about three per exchange; the constructor allocates the memory for them.

#include <passive_haptics/falcon/transport.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace falcon {

/// One call of a transport, and how it ended.
struct wire_row {
  enum class call : byte { control, write, read };

  nanoseconds stamp{};  ///< when the call ended; for a read, when the bytes were there
  call what = call::control;
  result how{};
  ftdi::line_status lines{};
  byte count = 0;
  std::array<byte, ftdi::usb_packet> bytes{};

  [[nodiscard]] std::span<const byte> content() const noexcept {
    return std::span(bytes).first(count);
  }
};

/// Any transport, with a record of its calls.
template <transport Transport>
class recording_transport {
 public:
  /// Keeps up to `rows` rows; the other arguments go to the transport.
  template <class... Arguments>
  explicit recording_transport(std::size_t rows, Arguments&&... arguments)
      : line_(std::forward<Arguments>(arguments)...), rows_(rows) {}

  /// Starts or stops the record; rows() stay.
  void record(bool on) noexcept { on_ = on; }
  [[nodiscard]] std::span<const wire_row> rows() const noexcept {
    return std::span(rows_).first(used_);
  }
  /// ok, or log_full if rows are missing at the end.
  [[nodiscard]] result complete() const noexcept {
    return full_ ? result{code::log_full} : result{};
  }

  template <class... Which>
  result open(const Which&... which) noexcept {
    return line_.open(which...);
  }
  void close() noexcept { line_.close(); }
  [[nodiscard]] bool is_open() const noexcept { return line_.is_open(); }
  [[nodiscard]] ftdi::line_status lines() const noexcept { return line_.lines(); }
  [[nodiscard]] nanoseconds now() const noexcept { return line_.now(); }

  result control(request r, std::uint16_t value) noexcept {
    const result done = line_.control(r, value);
    keep(wire_row::call::control, done, line_.now(), {});
    return done;
  }

  result write(std::span<const byte> bytes, nanoseconds deadline) noexcept {
    const result done = line_.write(bytes, deadline);
    keep(wire_row::call::write, done, line_.now(), is_packet(bytes) ? bytes : bytes.first(0));
    return done;
  }

  transfer read(std::span<byte> into, nanoseconds deadline) noexcept {
    const auto part = into.first((std::min)(into.size(), ftdi::usb_packet));
    const transfer got = line_.read(part, deadline);
    keep(wire_row::call::read, got.how, got.stamp, part.first(got.bytes));
    return got;
  }

  [[nodiscard]] Transport& line() noexcept { return line_; }

 private:
  [[nodiscard]] static bool is_packet(std::span<const byte> bytes) noexcept {
    if (bytes.size() != packet_size) return false;
    packet_bytes copy{};
    std::copy(bytes.begin(), bytes.end(), copy.begin());
    return decode<to_device>(copy).has_value();
  }

  void keep(wire_row::call what, const result& how, nanoseconds stamp,
            std::span<const byte> bytes) noexcept {
    if (!on_) return;
    full_ = full_ || used_ == rows_.size();
    if (full_) return;
    wire_row& row = rows_[used_++];
    row = {stamp, what, how, line_.lines(), static_cast<byte>(bytes.size())};
    std::copy(bytes.begin(), bytes.end(), row.bytes.begin());
  }

  Transport line_;
  std::vector<wire_row> rows_;
  std::size_t used_ = 0;
  bool on_ = false, full_ = false;
};

/// Answers as the recorded device did, at the recorded times. A call in another order, or a write of other
/// bytes, counts as a divergence. At the end of the log it behaves like a cable pulled out.
class replay_transport {
 public:
  explicit replay_transport(std::span<const wire_row> rows) noexcept : rows_(rows) {}

  result open() noexcept {
    *this = replay_transport(rows_);
    if (!rows_.empty()) now_ = rows_.front().stamp;
    open_ = true;
    return {};
  }
  void close() noexcept { open_ = false; }
  [[nodiscard]] bool is_open() const noexcept { return open_; }
  [[nodiscard]] ftdi::line_status lines() const noexcept { return lines_; }
  [[nodiscard]] nanoseconds now() const noexcept { return now_; }

  result control(request /*r*/, std::uint16_t /*value*/) noexcept {
    const wire_row* row = next(wire_row::call::control);
    return row != nullptr ? row->how : result{code::unplugged};
  }

  result write(std::span<const byte> bytes, nanoseconds /*deadline*/) noexcept {
    const wire_row* row = next(wire_row::call::write);
    if (row == nullptr) return {code::unplugged};
    const auto then = row->content();
    if (!std::equal(bytes.begin(), bytes.end(), then.begin(), then.end())) diverge();
    return row->how;
  }

  transfer read(std::span<byte> into, nanoseconds deadline) noexcept {
    if (at_ < rows_.size() && rows_[at_].what != wire_row::call::read) {
      diverge();
      now_ = (std::max)(now_, deadline);
      return {{code::timeout}, 0, now_};
    }
    const wire_row* row = next(wire_row::call::read);
    if (row == nullptr) return {{code::unplugged}, 0, now_};
    const std::size_t n = (std::min<std::size_t>)(into.size(), row->count);
    std::copy_n(row->bytes.begin(), n, into.begin());
    return {row->how, n, row->stamp};
  }

  [[nodiscard]] bool finished() const noexcept { return at_ == rows_.size(); }
  [[nodiscard]] std::size_t position() const noexcept { return at_; }             ///< rows played
  [[nodiscard]] std::size_t divergences() const noexcept { return differ_; }      ///< number
  [[nodiscard]] std::size_t first_divergence() const noexcept { return first_; }  ///< its row

 private:
  void diverge() noexcept {
    if (differ_++ == 0) first_ = at_;
  }

  /// The next row of that kind; rows of another kind before it are skipped. Null at the end of the log.
  [[nodiscard]] const wire_row* next(wire_row::call what) noexcept {
    if (!open_) return nullptr;
    for (bool skipped = false; at_ < rows_.size(); skipped = true) {
      const wire_row& row = rows_[at_++];
      if (skipped) diverge();
      if (row.what != what) continue;
      now_ = (std::max)(now_, row.stamp);
      lines_ = row.lines;
      return &row;
    }
    return nullptr;
  }

  std::span<const wire_row> rows_;
  std::size_t at_ = 0, differ_ = 0, first_ = 0;
  nanoseconds now_{};
  ftdi::line_status lines_{};
  bool open_ = false;
};

static_assert(transport<replay_transport>);

}  // namespace falcon
}  // namespace v0
}  // namespace passive_haptics
