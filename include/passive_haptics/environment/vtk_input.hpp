// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The bytes of a VTK or VTU file, the numbers in them, and the first thing wrong with them.
//
// The file is held in memory. The first fault is kept and ends it: whoever reads asks good() before it
// believes what it has read. What is said to be a count is never allocated ahead of what it counts.

#include <passive_haptics/base/decimal.hpp>
#include <passive_haptics/environment/msh_input.hpp>
#include <passive_haptics/environment/refuse.hpp>

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

/// What the numbers of an array are, and how they are written.
struct vtk_numbers {
  enum class kind : std::uint8_t { whole, natural, real };
  enum class encoding : std::uint8_t { text, little_endian, big_endian };

  kind is = kind::whole;
  std::size_t bytes = 0;  ///< of one, where they are not text; 0: of no type that is known
  encoding written = encoding::text;

  /// By the name that legacy files or XML files give a type.
  [[nodiscard]] static vtk_numbers of(std::string_view type, encoding written) {
    struct named {
      std::string_view legacy, xml;
      kind is;
      std::size_t bytes;
    };
    constexpr std::array<named, 13> all{{{"char", "Int8", kind::whole, 1},
                                         {"signed_char", "Int8", kind::whole, 1},
                                         {"unsigned_char", "UInt8", kind::natural, 1},
                                         {"short", "Int16", kind::whole, 2},
                                         {"unsigned_short", "UInt16", kind::natural, 2},
                                         {"int", "Int32", kind::whole, 4},
                                         {"vtkIdType", "Int32", kind::whole, 4},
                                         {"unsigned_int", "UInt32", kind::natural, 4},
                                         {"long", "Int64", kind::whole, 8},
                                         {"vtktypeint64", "Int64", kind::whole, 8},
                                         {"unsigned_long", "UInt64", kind::natural, 8},
                                         {"float", "Float32", kind::real, 4},
                                         {"double", "Float64", kind::real, 8}}};
    for (const named& n : all) {
      if (type == n.legacy || type == n.xml) return {n.is, n.bytes, written};
    }
    return {kind::whole, 0, written};
  }
};

class vtk_input {
 public:
  vtk_input(std::istream& in, std::string_view name) : name_(name) {
    std::ostringstream all;
    if (in.peek() != std::istream::traits_type::eof()) all << in.rdbuf();
    text_ = std::move(all).str();
    rest_ = text_;
  }
  vtk_input(const vtk_input&) = delete;
  vtk_input& operator=(const vtk_input&) = delete;

  // ------------------------------------------------------------------------------------ faults
  [[nodiscard]] bool good() const noexcept { return !fault_; }
  [[nodiscard]] const std::optional<mesh_error>& fault() const noexcept { return fault_; }
  void fail(std::string_view problem, std::string_view remedy = damaged) {
    if (!fault_) fault_.emplace(name_, problem, remedy);
  }
  static constexpr std::string_view damaged = "the file is damaged or cut off: save the mesh again";

  // ------------------------------------------------------------------------------------- words
  [[nodiscard]] std::string_view rest() const noexcept { return rest_; }
  /// The next word; empty at the end.
  [[nodiscard]] std::string_view word() { return word_of(rest_); }
  /// What is left of the present line.
  std::string_view line() {
    const std::string_view all = rest_.substr(0, rest_.find('\n'));
    rest_.remove_prefix((std::min)(rest_.size(), all.size() + 1));
    return all.substr(0, all.size() - (all.ends_with('\r') ? 1 : 0));
  }
  [[nodiscard]] std::int64_t count(std::string_view what) {
    return number<std::int64_t>(rest_, {}, what);
  }

  // ----------------------------------------------------------------------------------- numbers
  /// Gives `take` this many numbers from the front of `from`.
  template <class Number, class Take>
  void numbers(std::string_view& from, std::int64_t total, const vtk_numbers& are,
               std::string_view what, const Take& take) {
    for (std::int64_t i = 0; i < total && good(); ++i) {
      const Number value = number<Number>(from, are, what);
      if (good()) take(value);
    }
  }
  /// The same from the file itself, where a binary array begins with the next line.
  template <class Number, class Take>
  void numbers(std::int64_t total, const vtk_numbers& are, std::string_view what,
               const Take& take) {
    numbers<Number>(rest_, total, are, what, take);
  }
  void skip(std::size_t bytes) { rest_.remove_prefix((std::min)(bytes, rest_.size())); }

 private:
  static constexpr std::string_view blanks = " \t\r\n\v\f";

  [[nodiscard]] static std::string_view word_of(std::string_view& from) {
    from.remove_prefix((std::min)(from.size(), from.find_first_not_of(blanks)));
    const std::string_view word = from.substr(0, from.find_first_of(blanks));
    from.remove_prefix(word.size());
    return word;
  }

  /// A finite real number, or a whole one from 0 to 2^40.
  template <class Number>
  [[nodiscard]] Number number(std::string_view& from, const vtk_numbers& are,
                              std::string_view what) {
    constexpr auto most = Number(std::int64_t{1} << 40);
    const bool is_text = are.written == vtk_numbers::encoding::text;
    const std::string_view word = is_text ? word_of(from) : from.substr(0, are.bytes);
    if (word.empty() || (!is_text && word.size() < are.bytes)) {
      fail(sentence("ends at a ", what));
      return {};
    }
    if (!is_text) from.remove_prefix(are.bytes);
    const std::optional<Number> value =
        is_text ? from_text<Number>(word) : from_bytes<Number>(word, are);
    bool usable = value.has_value();
    if constexpr (std::integral<Number>) {
      usable = usable && *value >= 0 && *value <= most;
    } else {
      usable = usable && std::isfinite(*value);
    }
    if (usable) return *value;
    fail(sentence("has ",
                  is_text ? msh_input::quoted(word)
                  : value ? sentence(*value)
                          : "another type",
                  " for a ", what));
    return {};
  }

  template <class Number>
  [[nodiscard]] static std::optional<Number> from_text(std::string_view word) {
    if constexpr (std::floating_point<Number>) {
      return to_decimal<Number>(word);
    } else {
      Number value = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
      return value;
    }
  }

  template <class Number>
  [[nodiscard]] static std::optional<Number> from_bytes(std::string_view bytes,
                                                        const vtk_numbers& are) {
    const bool big = are.written == vtk_numbers::encoding::big_endian;
    std::uint64_t word = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      const char c = bytes[big ? i : bytes.size() - 1 - i];
      word = word << 8U | std::uint64_t{static_cast<unsigned char>(c)};
    }
    if (are.is == vtk_numbers::kind::real) {
      if (std::integral<Number>) return std::nullopt;
      return static_cast<Number>(are.bytes == 4 ? static_cast<double>(std::bit_cast<float>(
                                                      static_cast<std::uint32_t>(word)))
                                                : std::bit_cast<double>(word));
    }
    const std::uint64_t sign = std::uint64_t{1} << (8 * are.bytes - 1);
    if (are.is == vtk_numbers::kind::whole) word = (word ^ sign) - sign;
    return static_cast<Number>(static_cast<std::int64_t>(word));
  }

  std::string name_;
  std::string text_;
  std::string_view rest_;
  std::optional<mesh_error> fault_;
};

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
