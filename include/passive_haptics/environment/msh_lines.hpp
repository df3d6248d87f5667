// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The lines and words of an ASCII mesh file, each failure with its file, line and remedy.
//
// Reads through the stream buffer: no locale, no exception mask, no line longer than longest_line,
// so that neither garbage nor an endless stream can do more than raise a mesh_error.

#include <passive_haptics/environment/mesh.hpp>
#include <passive_haptics/kernels.hpp>

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <streambuf>
#include <string>
#include <string_view>
#include <system_error>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

class msh_lines {
 public:
  static constexpr std::size_t longest_line = std::size_t{1} << 20;  ///< [bytes]

  msh_lines(std::istream& in, std::string_view name) : buffer_(in.rdbuf()), name_(name) {}

  /// Goes to the next line that is not blank; false at the end of the file.
  [[nodiscard]] bool next() {
    while (read_line()) {
      line_ = trimmed(text_);
      if (number_ == 1 && line_.substr(0, 3) == "\xEF\xBB\xBF") line_.remove_prefix(3);
      rest_ = line_;
      if (!line_.empty()) return true;
    }
    return false;
  }

  /// The present line without the blanks, and the carriage return, around it.
  [[nodiscard]] std::string_view line() const noexcept { return line_; }
  [[nodiscard]] int number() const noexcept { return number_; }

  /// The next word of the line as a whole number.
  [[nodiscard]] std::int64_t integer(std::string_view what) {
    const std::string_view text = word(what);
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) {
      fail(sentence(what, " ", quoted(text), " is not a whole number"), damaged);
    }
    return value;
  }

  /// The next word of the line as a count. What it counts is never allocated ahead of the lines
  /// that hold it: a false count costs nothing.
  [[nodiscard]] std::int64_t count(std::string_view what) {
    const std::int64_t value = integer(what);
    constexpr int most = kernels::largest<int>();
    if (value < 0 || value > most) {
      fail(sentence(what, " ", value, " is not between 0 and ", most), damaged);
    }
    return value;
  }

  /// The next word of the line as a finite number.
  [[nodiscard]] double real(std::string_view what) {
    const std::string_view text = word(what);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) {
      fail(sentence(what, " ", quoted(text), " is not a number"), damaged);
    }
    if (!std::isfinite(value)) {
      fail(sentence(what, " ", quoted(text), " is not finite"), "mend it or mesh again");
    }
    return value;
  }

  void end_of_line() const {
    if (const auto left = trimmed(rest_); !left.empty()) {
      fail(sentence("has more on the line than expected: ", quoted(left)), damaged);
    }
  }

  [[noreturn]] void fail(std::string_view problem, std::string_view remedy) const {
    fail_at(number_, problem, remedy);
  }
  [[noreturn]] void fail_at(int line, std::string_view problem, std::string_view remedy) const {
    refuse(mesh_error(line > 0 ? sentence(name_, ":", line) : name_, problem, remedy));
  }

  /// At most forty characters of a file, printable.
  [[nodiscard]] static std::string quoted(std::string_view text) {
    std::string result = "'";
    for (const char c : text.substr(0, 40)) result += c >= ' ' && c <= '~' ? c : '?';
    return result + (text.size() > 40 ? "...'" : "'");
  }

  static constexpr std::string_view damaged = "the file is damaged: save it again as ASCII MSH";

 private:
  [[nodiscard]] static std::string_view trimmed(std::string_view text) noexcept {
    constexpr std::string_view blanks = " \t\r\v\f";
    const auto first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
  }

  [[nodiscard]] bool read_line() {
    using traits = std::streambuf::traits_type;
    text_.clear();
    if (buffer_ == nullptr || traits::eq_int_type(buffer_->sgetc(), traits::eof())) return false;
    ++number_;
    for (auto c = buffer_->sbumpc(); !traits::eq_int_type(c, traits::eof());
         c = buffer_->sbumpc()) {
      if (traits::to_char_type(c) == '\n') break;
      if (text_.size() == longest_line) {
        fail(sentence("is longer than ", longest_line, " characters"),
             "save the mesh as ASCII MSH");
      }
      text_ += traits::to_char_type(c);
    }
    return true;
  }

  [[nodiscard]] std::string_view word(std::string_view what) {
    rest_ = trimmed(rest_);
    if (rest_.empty()) fail(sentence("ends before the ", what), damaged);
    const std::string_view text = rest_.substr(0, rest_.find_first_of(" \t\r\v\f"));
    rest_.remove_prefix(text.size());
    return text.size() > 1 && text.front() == '+' ? text.substr(1) : text;
  }

  std::streambuf* buffer_;
  std::string name_;
  std::string text_;
  std::string_view line_;
  std::string_view rest_;
  int number_ = 0;
};

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
