// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The lines, words and binary numbers of an MSH file, and the first fault in them.
//
// The first fault is kept, with its place, and ends the file: from then on there is no next line and
// every number is zero. A reader must ask good() before it uses what it has read.
//
// It reads through the stream buffer, without locale and exception mask, and no line longer than
// longest_line, so garbage or an endless stream raises a fault and does no other harm.

#include <passive_haptics/base/decimal.hpp>
#include <passive_haptics/base/kernels.hpp>
#include <passive_haptics/environment/refuse.hpp>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <streambuf>
#include <string>
#include <string_view>
#include <system_error>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

enum class msh_encoding : std::uint8_t { text, little_endian, big_endian };

class msh_input {
 public:
  static constexpr std::size_t longest_line = std::size_t{1} << 20;  ///< [bytes]

  msh_input(std::istream& in, std::string_view name) : buffer_(in.rdbuf()), name_(name) {}

  // ------------------------------------------------------------------------------------ faults
  [[nodiscard]] bool good() const noexcept { return !fault_; }
  [[nodiscard]] const std::optional<mesh_error>& fault() const noexcept { return fault_; }

  /// The place of the present line or of the binary number read last: in a text file the number of the line,
  /// counted from 1, in a binary file that of the byte, counted from 0.
  [[nodiscard]] std::int64_t place() const noexcept { return binary() ? byte_ : line_number_; }

  void fail(std::string_view problem, std::string_view remedy) {
    fail_at(place(), problem, remedy);
  }
  void fail_at(std::int64_t place, std::string_view problem, std::string_view remedy) {
    if (fault_) return;
    fault_.emplace(binary() ? sentence(name_, ", byte ", place) : sentence(name_, ":", place),
                   problem, remedy);
  }
  /// A fault of the whole file.
  void fail_file(std::string_view problem, std::string_view remedy) {
    if (!fault_) fault_.emplace(name_, problem, remedy);
  }

  // ------------------------------------------------------------------------------------- lines
  /// Goes to the next line that is not blank; false at the end of the file.
  [[nodiscard]] bool next() {
    while (read_line()) {
      line_ = trimmed(text_);
      if (line_number_ == 1 && line_.starts_with("\xEF\xBB\xBF")) line_.remove_prefix(3);
      rest_ = line_;
      if (!line_.empty()) return true;
    }
    return false;
  }

  /// Goes to the line that is `end`, over anything before it; false if there is none. In a binary file a line
  /// that ends with `end` is enough, because binary numbers may precede it.
  [[nodiscard]] bool skip_to(std::string_view end) {
    while (read_line(true)) {
      line_ = trimmed(text_);
      if (line_ == end || (binary() && line_.ends_with(end))) return true;
    }
    return false;
  }

  /// The present line without the blanks, and the carriage return, around it.
  [[nodiscard]] std::string_view line() const noexcept { return line_; }

  /// The next word of the line as a whole number.
  [[nodiscard]] std::int64_t word_integer(std::string_view what) {
    const std::string_view text = word(what);
    const std::string_view digits = text.substr(text.size() > 1 && text.front() == '+' ? 1 : 0);
    std::int64_t value = 0;
    const char* last = digits.data() + digits.size();
    const auto [end, error] = std::from_chars(digits.data(), last, value);
    if (good() && (error != std::errc{} || end != last)) {
      fail(sentence(what, " ", quoted(text), " is not a whole number"), damaged);
    }
    return good() ? value : 0;
  }

  /// The next word of the line as a finite number.
  [[nodiscard]] double word_real(std::string_view what) {
    const std::string_view text = word(what);
    const auto value = to_decimal(text);
    if (!value || !std::isfinite(*value)) {
      fail(sentence(what, " ", quoted(text), " is not a finite number"), damaged);
    }
    return good() ? *value : 0.0;
  }

  // --------------------------------------------------------------- numbers, as the file writes them
  void encode(msh_encoding encoding) noexcept { encoding_ = encoding; }
  [[nodiscard]] bool binary() const noexcept { return encoding_ != msh_encoding::text; }

  /// The next whole number: a word of a text file, or `size` bytes of a binary file.
  [[nodiscard]] std::int64_t integer(std::string_view what, int size) {
    return binary() ? static_cast<std::int64_t>(bytes(what, size)) : word_integer(what);
  }

  /// The next finite number: a word of a text file, or 8 bytes of a binary file.
  [[nodiscard]] double real(std::string_view what) {
    if (!binary()) return word_real(what);
    const auto value = std::bit_cast<double>(bytes(what, 8));
    if (!std::isfinite(value)) fail(sentence(what, " ", value, " is not a finite number"), damaged);
    return value;
  }

  /// `value` if it can be a count, else 0 and a fault. No memory is allocated by a count alone, so a false
  /// count costs nothing.
  [[nodiscard]] std::int64_t as_count(std::string_view what, std::int64_t value) {
    constexpr int most = kernels::largest<int>();
    if (value >= 0 && value <= most) return value;
    fail(sentence(what, " ", value, " is not between 0 and ", most), damaged);
    return 0;
  }

  /// Reports a fault if a text file has words left on the line. A binary file has no lines, so it passes.
  void end_of_record() {
    if (const auto left = trimmed(rest_); !binary() && !left.empty()) {
      fail(sentence("has more on the line than expected: ", quoted(left)), damaged);
    }
  }

  /// Up to 40 characters of a file in quotes, '?' for each that is not printable.
  [[nodiscard]] static std::string quoted(std::string_view text) {
    std::string result = "'";
    for (const char c : text.substr(0, 40)) result += c >= ' ' && c <= '~' ? c : '?';
    return result + (text.size() > 40 ? "...'" : "'");
  }

  static constexpr std::string_view damaged = "the file is damaged: save the mesh again";

 private:
  static constexpr std::string_view blanks = " \t\r\v\f";

  [[nodiscard]] static std::string_view trimmed(std::string_view text) noexcept {
    const auto first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
  }

  /// Reads a line into text_; of a long line that is only skipped, text_ keeps the end.
  [[nodiscard]] bool read_line(bool skipped = false) {
    using traits = std::streambuf::traits_type;
    text_.clear();
    if (!good() || buffer_ == nullptr || traits::eq_int_type(buffer_->sgetc(), traits::eof())) {
      return false;
    }
    ++line_number_;
    byte_ = next_byte_;
    for (auto c = buffer_->sbumpc(); !traits::eq_int_type(c, traits::eof());
         c = buffer_->sbumpc()) {
      ++next_byte_;
      if (traits::to_char_type(c) == '\n') break;
      if (text_.size() == longest_line) {
        if (!skipped) {
          fail(sentence("is longer than ", longest_line, " characters"), damaged);
          return false;
        }
        text_.erase(0, longest_line / 2);
      }
      text_ += traits::to_char_type(c);
    }
    return true;
  }

  /// The next `size` bytes as a whole number; a number of four bytes is signed.
  [[nodiscard]] std::uint64_t bytes(std::string_view what, int size) {
    using traits = std::streambuf::traits_type;
    std::uint64_t value = 0;
    byte_ = next_byte_;
    for (int i = 0; i < size && good(); ++i) {
      const auto c = buffer_->sbumpc();
      if (traits::eq_int_type(c, traits::eof())) {
        fail(sentence("ends before the ", what), "the file is cut off: save the mesh again");
        return 0;
      }
      ++next_byte_;
      const auto digit = std::uint64_t{static_cast<unsigned char>(traits::to_char_type(c))};
      value = encoding_ == msh_encoding::big_endian ? value << 8U | digit
                                                    : value | digit << (8U * unsigned(i));
    }
    if (!good()) return 0;
    return size == 4 ? static_cast<std::uint64_t>(std::int64_t{static_cast<std::int32_t>(value)})
                     : value;
  }

  [[nodiscard]] std::string_view word(std::string_view what) {
    if (!good()) return {};
    rest_ = trimmed(rest_);
    if (rest_.empty()) fail(sentence("ends before the ", what), damaged);
    const std::string_view text = rest_.substr(0, rest_.find_first_of(blanks));
    rest_.remove_prefix(text.size());
    return text;
  }

  std::streambuf* buffer_;
  std::string name_;
  msh_encoding encoding_ = msh_encoding::text;
  std::string text_;
  std::string_view line_, rest_;
  std::int64_t line_number_ = 0;
  std::int64_t next_byte_ = 0;  ///< number of the next byte, counted from 0
  std::int64_t byte_ = 0;       ///< number of the byte at which the present line or number begins
  std::optional<mesh_error> fault_;
};

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
